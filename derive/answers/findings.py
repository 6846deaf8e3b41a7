"""What was found about each entry of an answer, told on a terminal or as JSON."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

from derive.algebra.infix import text
from derive.answers.terms import Verdict
from derive.errors import Place
from derive.expression import MINUS_ONE, Expr, Number, Symbol, replace, walk

WIDEST = 100  # columns of an expression that is quoted whole
ORDER: tuple[Verdict, ...] = ("equal", "differs", "undecided")


@dataclass(frozen=True, slots=True)
class Check:
    """One entry compared. `entry` counts from 1 and is empty for a scalar; `witness` is a point where the
    two differ and `values` what they are there (None: no real value)."""

    problem: int
    question: int
    name: str
    entry: tuple[int, ...]
    verdict: Verdict
    published: str
    derived: str
    place: Place
    witness: Mapping[str, float] = field(default_factory=dict)
    values: tuple[float | None, float | None] | None = None
    diagnosis: str = ""
    note: str = ""

    def plain(self) -> dict[str, Any]:
        """The same as JSON, in the shape the sheet language promises."""
        found: dict[str, Any] = {"problem": self.problem, "question": self.question, "name": self.name}
        if self.entry:
            found["entry"] = list(self.entry)
        found |= {"verdict": self.verdict, "published": self.published, "derived": self.derived}
        if self.verdict == "differs":
            if self.values is not None:
                found["witness"] = dict(self.witness)
            if self.diagnosis:
                found["diagnosis"] = self.diagnosis
        return {**found, "note": self.note} if self.note else found


def as_typed(tree: Expr) -> str:
    """A published formula in SymPy's syntax, its decimals as decimals."""
    decimals = [node for node in walk(tree) if isinstance(node, Number) and node.decimal]
    return text(replace(tree, {node: _decimal(node) for node in decimals}))


def _decimal(number: Number) -> Expr:
    digits = Symbol(f"{float(abs(number.value)):.15g}")
    return MINUS_ONE * digits if number.value < 0 else digits


# -- told ---------------------------------------------------------------------------------------------


def as_json(checks: Sequence[Check]) -> str:
    """One object with the records of all entries."""
    return json.dumps({"checks": [check.plain() for check in checks]}, indent=2, ensure_ascii=False)


def as_text(checks: Sequence[Check]) -> str:
    """A line for each answer, more for each entry that is not equal, and how many there were of each."""
    lines = []
    for (place, name), entries in groupby(checks, lambda check: (check.place, check.name)):
        told = list(entries)
        where = f"{place.file}:{place.line}: {name}"
        lines.append(f"{where}: {_verdict(told)}")
        lines += [line for check in told for line in _entry(check)]
    return "\n".join([*lines, _summary(checks)])


def _verdict(told: Sequence[Check]) -> str:
    """The verdict of a whole answer: it differs where one of its entries does."""
    verdicts = {check.verdict for check in told}
    verdict = next(each for each in ("differs", "undecided", "equal") if each in verdicts)
    notes = sorted({check.note for check in told if check.note and check.verdict == verdict == "equal"})
    return ", ".join([verdict, *notes]).replace("equal, to the digits", "equal to the digits")


def _entry(check: Check) -> Iterator[str]:
    """Where it is not equal: the entry, both sides, a point, and what probably went wrong."""
    if check.verdict == "equal":
        return
    if check.entry:
        yield f"    entry ({', '.join(map(str, check.entry))}) {check.verdict}"
    yield f"        published  {_short(check.published) or 'nothing'}"
    yield f"        derived    {_short(check.derived) or 'nothing'}"
    if check.verdict == "differs" and check.values is not None:
        yield f"        {_at(check)}"
    if check.diagnosis:
        yield f"        probably   {check.diagnosis}"
    if check.note:
        yield f"        note       {check.note}"


def _at(check: Check) -> str:
    """at theta1 = 0.4: 1 against -1."""
    values = [f"{value:.6g}" if value is not None else "no real value" for value in check.values or ()]
    point = ", ".join(f"{name} = {value:g}" for name, value in check.witness.items())
    return f"{f'at {point}: ' if point else 'that is    '}{' against '.join(values)}"


def _short(expression: str) -> str:
    return expression if len(expression) <= WIDEST else expression[: WIDEST - 3] + "..."


def _summary(checks: Sequence[Check]) -> str:
    """12 entries: 11 equal, 1 differs."""
    counts = Counter(check.verdict for check in checks)
    told = ", ".join(f"{counts[each]} {each}" for each in ORDER if counts[each])
    return f"{len(checks)} {'entry' if len(checks) == 1 else 'entries'}: {told}"
