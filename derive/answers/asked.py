"""A question that has an answer: what there is to compare with, and the names an answer may use."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from derive.answers.latex.letters import Letters
from derive.answers.points import RATES, Names, Point, Sampling
from derive.answers.reading import Locate, Route
from derive.answers.terms import Terms
from derive.derivation import Branch, Derivation, LinearSystem, Step
from derive.errors import Place
from derive.expression import Approximate, Expr, Matrix, Symbol, column, free_symbols
from derive.kinds.problem import TREES, Problem


@dataclass(frozen=True)
class Asked:
    """A question, what was derived for it, and where its answer stands in the sheet.

    `reached` are points at which known coordinates belong together, for inverse problems; `evaluate` is the
    point at which the question wants numbers, empty where nothing is left to give, None where it wants none.
    """

    problem: int
    question: int
    derivation: Derivation
    given: Problem
    answer: Mapping[str, Any]
    locate: Locate
    key: Callable[[Route], Place]
    xy: bool = False
    reached: tuple[Point, ...] = ()
    evaluate: Mapping[str, Expr] | None = None

    # -- what there is to compare with ------------------------------------------------------------

    @cached_property
    def derived(self) -> Mapping[str, Any]:
        """Results by name; then steps of the page, matrices and entries named there; then what is known in
        numbers."""
        found: dict[str, Any] = {}
        for name, value in self.derivation.evaluated.items():
            if (tree := _numeric(value)) is not None:
                found[name] = tree
        for each in reversed(list(_rests_on(self.derivation))):
            named = [(name, tree) for step in each.all_steps() for name, tree in _entries(step)]
            found.update({name.name: each.definitions.get(name, tree) for name, tree in named})
            known = [(name, tree) for name, tree in each.definitions.items() if isinstance(tree, Matrix)]
            found.update({name.name: tree for name, tree in known if isinstance(name, Symbol)})
            steps = [step for step in each.all_steps() if step.chain]
            equal = ((name, step) for step in steps for name in step.chain if isinstance(name, Symbol))
            found.update({name.name: step.result for name, step in equal})
            found.update({step.name: step.result for step in steps})
        return {**found, **self.derivation.results, **self._solved}

    @property
    def _solved(self) -> Mapping[str, Expr]:
        """The solution in numbers of results that are told by equations."""
        results, evaluated = self.derivation.results, self.derivation.evaluated
        told = (name for name, result in results.items() if isinstance(result, LinearSystem))
        numbers = {name: _numeric(evaluated.get(name)) for name in told}
        return {name: tree for name, tree in numbers.items() if tree is not None}

    @cached_property
    def definitions(self) -> Names:
        """What names of the working stand for, those of `where` included."""
        found: dict[Expr, Expr] = {}
        for each in reversed(list(_rests_on(self.derivation))):
            found.update(each.definitions)
        return {**found, **self.given.names}

    @cached_property
    def own(self) -> frozenset[str]:
        """The symbols of the problem and of its results, which stand for themselves."""
        trees = [tree for value in self.derivation.results.values() for tree in _trees(value)]
        return self.given.symbols.union(*map(free_symbols, trees)) - set(self.given.where)

    @cached_property
    def variables(self) -> tuple[str, ...]:
        """The coordinates of the subject, such as joint variables; none where it has none."""
        return tuple(getattr(self.given.subject, "variables", ()))

    @cached_property
    def letters(self) -> Letters:
        """The names that its answer may use."""
        rates = {name + rate for name in self.variables for rate in RATES}
        working = {name.name for name in self.definitions if isinstance(name, Symbol)}
        declared = set(self.given.where) | self.given.assumptions.keys()
        return Letters(self.own | working | rates | declared | set(self.variables), self.xy, self.own)

    @cached_property
    def point(self) -> Names:
        """What has a value where the question is evaluated."""
        return {Symbol(name): value for name, value in (self.evaluate or {}).items()}

    @cached_property
    def terms(self) -> Terms:
        """On what terms a result is compared: what names stand for, and at which points to look."""
        known = {"positive", "nonnegative"}
        positive = frozenset(name for name, what in self.given.assumptions.items() if what in known)
        signed = frozenset(self.variables) | {name + rate for name in self.variables for rate in RATES}
        published = {key: tree for key, tree in self.definitions.items() if not self._is_own(key)}
        return Terms(published, self.given.names, Sampling(signed - positive, positive))

    def terms_of(self, name: str) -> Terms:
        """Those for a result; a step of the working may be in terms of names defined there."""
        if name in self.derivation.results:
            return self.terms
        return replace(self.terms, derived=self.terms.published)

    def _is_own(self, key: Expr) -> bool:
        return isinstance(key, Symbol) and key.name in self.own


def _rests_on(derivation: Derivation) -> Iterator[Derivation]:
    yield derivation
    for used in derivation.uses:
        yield from _rests_on(used)


def _entries(step: Step) -> Iterator[tuple[Symbol, Expr]]:
    """The entries of a matrix that have names on the page."""
    end = step.chain[-1] if step.chain else None
    if isinstance(end, Matrix):
        yield from ((name, end.rows[i][j]) for (i, j), name in step.entries.items())


def _trees(result: Any) -> Iterator[Expr]:
    match result:
        case Branch(values):
            yield from values.values()
        case tuple():
            for part in result:
                yield from _trees(part)
        case _ if isinstance(result, TREES):
            yield result


def _numeric(value: Any) -> Expr | None:
    """Numbers at a point as a tree; None where they are no plain numbers."""
    if _is_number(value):
        return Approximate(float(value))
    if not isinstance(value, list) or not value:
        return None
    if all(map(_is_number, value)):
        return column([Approximate(float(each)) for each in value])
    if all(isinstance(row, list) and all(map(_is_number, row)) for row in value):
        return Matrix(tuple(tuple(Approximate(float(each)) for each in row) for row in value))
    return None


def _is_number(value: Any) -> bool:
    return isinstance(value, float | int) and not isinstance(value, bool)
