"""One wrong sign planted into a kind before it claims anything, in what it computes or in what it writes.

A value is turned where the kind hands it over to be written down, so that page and results are made of the
wrong one; a line is turned as its step is made. The sheet must then be refused, or read as it did.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Hashable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, get_args

import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.algebra.scalar import Scalar
from derive.build import derive_all
from derive.derivation import Derivation, Result, Step
from derive.errors import FormulaError, NotDerivable, SheetErrors
from derive.expression import ZERO, Approximate, Call, Expr, Matrix, free_symbols, negate
from derive.kinds.problem import Problem
from derive.render.questions import example_of
from derive.sheet.load import load_sheet
from derive.writing import render

TREES = get_args(Expr)
MOST = 8  # places of one example where a mistake is planted, spread evenly


@dataclass
class Planter:
    """Turns a sign at one place of those it meets; counts them where none is chosen."""

    chosen: int = -1
    met: list[str] = field(default_factory=list)
    again: dict[Hashable, int] = field(default_factory=dict)  # a value is wrong wherever it is written
    within: bool = False

    def here(self, what: str, key: Hashable = None) -> bool:
        """Whether the mistake is to be made now."""
        if key in self.again:
            return self.again[key] == self.chosen
        if key is not None:
            self.again[key] = len(self.met)
        self.met.append(what)
        return len(self.met) - 1 == self.chosen


Planting = Callable[[Planter], AbstractContextManager[None]]


@dataclass(frozen=True)
class Built:
    """What a reader sees of a sheet: its page, and its results by the names they bear."""

    page: str
    results: dict[tuple[str, str], Any]

    @classmethod
    def of(cls, sheet: Path) -> Built:
        """Raises SheetErrors."""
        (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
        problems = json.loads(render(document, "json"))["problems"]
        asked = [(f"{p['number']}.{q['number']}", q) for p in problems for q in p["questions"]]
        results = {(number, name): value for number, q in asked for name, value in q["results"].items()}
        return cls(render(document, "md"), results)

    def wrong(self, right: Built, line: str) -> set[str]:
        """The names of the results that are not as they were, or the name of the line where the page alone is
        not."""
        names = {
            name
            for number, name in right.results
            if not same(self.results[number, name], right.results[number, name])
        }
        rewritten = self.results != right.results  # the page has them too, in their other form
        return names or ({line} if self.page != right.page and not rewritten else set())


def same(ours: Any, right: Any) -> bool:
    """Whether results say the same, if only in another form: (-a)/(-b) for a/b."""
    match ours, right:
        case list(), list():
            return len(ours) == len(right) and all(map(same, ours, right))
        case str(), str() if ours != right:
            with suppress(FormulaError, NotDerivable):
                return normal(parse(ours.replace("**", "^"))) == normal(parse(right.replace("**", "^")))
    return bool(ours == right)


@contextmanager
def values(planter: Planter) -> Iterator[None]:
    """What kinds hand over to be written down passes the planter, matrices whole."""
    scalar, matrix = Problem.readable, Problem.readable_matrix

    def readable(self: Problem, value: Scalar) -> Expr:
        planted = value and not planter.within and planter.here("value", value.key())
        return scalar(self, -value if planted else value)

    def readable_matrix(self: Problem, value: ScalarMatrix) -> Matrix:
        entries = [(i, j) for i, row in enumerate(value.rows) for j, entry in enumerate(row) if entry]
        if entries and planter.here("matrix", tuple(entry.key() for row in value.rows for entry in row)):
            value = _turned(value, entries[len(entries) // 2])
        planter.within = True
        try:
            return matrix(self, value)
        finally:
            planter.within = False

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Problem, "readable", readable)
        patch.setattr(Problem, "readable_matrix", readable_matrix)
        yield


@contextmanager
def lines(planter: Planter) -> Iterator[None]:
    """The last two expressions of the chain of every step pass the planter. Laws, which have nothing to be
    compared with, do not, nor does what comes to zero, of which any sign is right."""
    made = Step.__init__

    def make(
        self: Step, name: str, chain: tuple[Expr, ...] = (), rule: str = "", *others: Any, **more: Any
    ) -> None:
        chain = tuple(chain)
        if rule != "law" and chain and not _is_zero(chain[-1]):
            for i in range(max(1, len(chain) - 2), len(chain)):
                wrong = turned(chain[i], chain[-1])
                if wrong is not None and planter.here(name):
                    chain = (*chain[:i], wrong, *chain[i + 1 :])
        made(self, name, chain, rule, *others, **more)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Step, "__init__", make)
        yield


@contextmanager
def results(planter: Planter) -> Iterator[None]:
    """The results alone pass the planter as an answer is made; its lines are as they were."""
    made = Derivation.__init__

    def make(
        self: Derivation,
        kind: str,
        steps: tuple[Step, ...],
        results: Mapping[str, Result],
        *others: Any,
        **more: Any,
    ) -> None:
        found = dict(results)
        for name, result in results.items():
            wrong = turned(result) if isinstance(result, TREES) else None
            if wrong is not None and planter.here(name, (kind, name, id(steps))):
                found[name] = wrong
        made(self, kind, steps, found, *others, **more)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Derivation, "__init__", make)
        yield


def turned(expr: Expr, end: Expr | None = None) -> Expr | None:
    """With its sign turned, a matrix that of its last entry that is not zero in the `end` that it comes to;
    None of zero and of a rounded number."""
    match expr:
        case Matrix(rows):
            zero = _zeros(end) if end else set()
            places = [
                (i, j, wrong)
                for i, row in enumerate(rows)
                for j, e in enumerate(row)
                if (i, j) not in zero and (wrong := turned(e))
            ]
            if not places:
                return None
            i, j, wrong = places[-1]
            row = (*rows[i][:j], wrong, *rows[i][j + 1 :])
            return Matrix((*rows[:i], row, *rows[i + 1 :]))
        case Approximate():
            return None
        case _:
            return None if _is_zero(expr) else negate(expr)


def _zeros(expr: Expr) -> set[tuple[int, int]]:
    """The places of a matrix that hold a zero."""
    rows = expr.rows if isinstance(expr, Matrix) else ()
    return {(i, j) for i, row in enumerate(rows) for j, e in enumerate(row) if e == ZERO}


def _is_zero(expr: Expr) -> bool:
    """Whether it is zero, as cos 90 deg is, or a matrix of zeros: of that any sign is right."""
    if isinstance(expr, Matrix):
        return all(entry == ZERO for row in expr.rows for entry in row)
    if isinstance(expr, Call) and not free_symbols(expr):
        with suppress(NotDerivable):
            return abs(number(expr, {})) < 1e-12
    return expr == ZERO


def _turned(value: ScalarMatrix, place: tuple[int, int]) -> ScalarMatrix:
    return ScalarMatrix(
        tuple(
            tuple(-entry if (i, j) == place else entry for j, entry in enumerate(row))
            for i, row in enumerate(value.rows)
        )
    )


def printed_wrong(planting: Planting, sheet: Path, most: int = MOST) -> set[str]:
    """What a sheet tells wrong though it is built, with a mistake planted at one place after the other: the
    names of results, and where none is wrong what is wrong on the page."""
    first = Planter()
    with planting(first):
        right = Built.of(sheet)
    count = len(first.met)
    found: set[str] = set()
    for place in sorted({n * count // most for n in range(most)} if count > most else range(count)):
        planter = Planter(place)
        with planting(planter), suppress(SheetErrors, KeyError):  # refused, or a name stands for nothing
            found |= Built.of(sheet).wrong(right, planter.met[place])
    return found


if __name__ == "__main__":  # everywhere, not only at MOST places: python -m tests.kinds.planting [KIND]
    from tempfile import TemporaryDirectory

    from derive.kinds import registry
    from derive.sheet.subjects.registry import subjects

    for module in sorted({name for subject in subjects() for name in registry.kinds_of(subject).values()}):
        with TemporaryDirectory() as folder:
            sheet = Path(folder) / "example.yaml"
            sheet.write_text(example_of(module), encoding="utf-8")
            if all(part in module for part in sys.argv[1:]):
                for planting in (values, lines, results):
                    print(
                        module, planting.__name__, sorted(printed_wrong(planting, sheet, 10**6)), flush=True
                    )
