"""Systems of polynomial equations, solved over the reals as one does by hand: case by case.

An equation that is a product splits the problem; a linear one, or one in which a square stands alone,
gives an unknown by the others; where neither is left, a Groebner basis over the rationals (FLINT)
eliminates. Every move is kept, so that the solution can be told. Bounded: what would take too long, or
leads to equations without exact or isolated roots, is refused with the equations that are left.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from flint import arb, ctx

from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.algebra.solving.elimination_rules import (
    Equation,
    Move,
    Moved,
    by_given,
    by_squares,
    defining,
    last,
    linear,
    one_unknown,
    proportional,
    same,
    solvable,
    solvable_last,
    splitting,
    square,
    whole,
)
from derive.algebra.solving.groebner import groebner
from derive.algebra.solving.polynomials import ball, coefficients, factors, holds, monomials, numerator
from derive.algebra.solving.real_roots import BITS, real_roots
from derive.errors import NotDerivable

MOST_CASES = 60
LARGEST = 400  # terms of an equation
BESIDE = "a root that is only enclosed stands beside parameters: give them values"

Value: TypeAlias = Scalar | arb


@dataclass(frozen=True, slots=True)
class Solution:
    """A value for each unknown but those in `free`; real where each of `real_if` is positive."""

    values: Mapping[str, Value]
    free: tuple[str, ...] = ()
    real_if: tuple[Scalar, ...] = ()


@dataclass(frozen=True, slots=True)
class Case:
    """Where `given` vanishes: the moves, then either more cases (the factors of `split`), or solutions,
    or an equation `against` that cannot hold."""

    given: Scalar | None
    moves: tuple[Move, ...] = ()
    split: tuple[Scalar, ...] = ()
    cases: tuple[Case, ...] = ()
    solutions: tuple[Solution, ...] = ()
    against: Scalar | None = None

    def all_solutions(self) -> tuple[Solution, ...]:
        """Those of this case and of the cases within it."""
        return (*self.solutions, *(found for case in self.cases for found in case.all_solutions()))


def solve(equations: Iterable[Scalar], unknowns: Sequence[str], positive: Collection[str] = ()) -> Case:
    """Every real solution of equations that are to vanish, case by case; `positive` are names known to be
    positive. Raises NotDerivable where they are out of reach."""
    return _Solver(tuple(positive)).case(None, _State(tuple(equations), tuple(unknowns)))


class _Impossible(Exception):
    def __init__(self, equation: Scalar) -> None:
        self.equation = equation


Pending = tuple[tuple[str, Scalar], ...]


@dataclass(frozen=True, slots=True)
class _State:
    """What is left of a problem: its equations, the unknowns in them, those known by others, and
    polynomials that are not zero here, for another case has them."""

    equations: tuple[Scalar, ...]
    unknowns: tuple[str, ...]
    pending: Pending = ()
    nonzero: tuple[Scalar, ...] = ()
    eliminated: bool = False

    def moved(self, move: Move, equations: Iterable[Scalar]) -> _State:
        """After a move that leaves these equations."""
        if move.rule == "eliminate":
            return replace(self, equations=tuple(equations), eliminated=True)
        if move.rule == "squares":
            return replace(self, equations=tuple(equations))
        nonzero = self.nonzero
        if move.rule == "linear" and move.value is not None:
            nonzero = tuple(numerator(p.substitute({move.variable: move.value})) for p in nonzero)
        return _State(
            tuple(equations),
            tuple(name for name in self.unknowns if name != move.variable),
            (*self.pending, (move.variable, defining(move))),
            nonzero,
            self.eliminated,
        )

    def where(self, given: Scalar, not_: Iterable[Scalar], others: Iterable[Scalar]) -> _State:
        """The case in which `given` vanishes."""
        return replace(self, equations=(given, *others), nonzero=(*self.nonzero, *not_))


@dataclass(slots=True)
class _Solver:
    """Counts the cases of one solution."""

    positive: tuple[str, ...]
    count: int = 0

    def case(self, given: Scalar | None, state: _State) -> Case:
        """One case with everything inside it."""
        self.count += 1
        if self.count > MOST_CASES:
            raise NotDerivable(f"there are more than {MOST_CASES} cases to distinguish")
        moves: list[Move] = []
        first = given
        while True:
            try:
                left = self.cleaned(state)
            except _Impossible as found:
                return Case(given, tuple(moves), against=found.equation)
            if not left:
                return Case(given, tuple(moves), solutions=self.resolved(state.pending, state.unknowns))
            step = by_given(first, left, state.unknowns) or last(list(map(whole, left)), state.unknowns)
            first = None
            if step is None and (several := splitting(left, state.unknowns)) is not None:
                others = [whole(each) for each in left if each is not several]
                cases = tuple(
                    self.case(part, state.where(part, several[:k], others)) for k, part in enumerate(several)
                )
                return Case(given, tuple(moves), several, cases)
            single = tuple(map(whole, left))
            step = step or self._move(single, state)
            if step is None:
                return self._by_roots(given, moves, single, state)
            moves.append(step[0])
            state = state.moved(*step)

    def cleaned(self, state: _State) -> list[Equation]:
        """The equations without those that always hold, each in its factors. Raises _Impossible."""
        found: list[Equation] = []
        for equation in filter(None, state.equations):
            top = numerator(equation)
            if len(top.numerator) > LARGEST:
                raise NotDerivable("eliminating leads to equations too long to work with")
            kept = tuple(p for p in factors(top, state.unknowns) if not self._never_zero(p, state))
            if not kept:
                raise _Impossible(top)
            if not any(same(kept, known) for known in found):
                found.append(kept)
        return found

    def _never_zero(self, polynomial: Scalar, state: _State) -> bool:
        """Excluded here, or of terms of one sign, one of them without an unknown that may vanish."""
        if any(proportional(polynomial, each) for each in state.nonzero):
            return True
        if sign_of(polynomial, self.positive) is None:
            return False
        may_vanish = [name for name in state.unknowns if name not in self.positive]
        return any(not holds(term, may_vanish) for term in monomials(polynomial))

    @staticmethod
    def _move(single: tuple[Scalar, ...], state: _State) -> Moved | None:
        """What to do with equations none of which is a product."""
        equations = list(single)
        step = by_squares(equations) or linear(equations, state.unknowns)
        step = step or square(equations, state.unknowns) or solvable_last(equations, state.unknowns)
        if step is not None or one_unknown(equations, state.unknowns) or state.eliminated:
            return step
        basis = groebner(equations, state.unknowns)
        if basis is None or all(any(proportional(p, known) for known in equations) for p in basis):
            return None
        return Move("eliminate", left=tuple(basis)), basis

    def _by_roots(
        self, given: Scalar | None, moves: list[Move], single: tuple[Scalar, ...], state: _State
    ) -> Case:
        """Cases by the exact roots of an equation in one unknown that others need too, or by an equation
        that leaves unknowns free."""
        for equation, name in one_unknown(single, state.unknowns):
            roots = real_roots(coefficients(equation, name), self.positive)
            if all(isinstance(each.value, Scalar) and each.real_if is None for each in roots):
                symbol = Scalar.symbol(name)
                parts = [symbol - each.value for each in roots if isinstance(each.value, Scalar)]
                cases = tuple(self.case(p, state.where(p, (), single)) for p in parts)
                return Case(given, tuple(moves), tuple(parts), cases)
        free = solvable(single[0], state.unknowns) if len(single) == 1 else ""
        if not free:
            raise NotDerivable(_stuck(single))
        move = Move("last", single[0], free)
        state = state.moved(move, ())
        return Case(given, (*moves, move), solutions=self.resolved(state.pending, state.unknowns))

    def resolved(self, pending: Pending, free: tuple[str, ...]) -> tuple[Solution, ...]:
        """The unknowns one after the other, the last one first."""
        found = [Solution({}, free)]
        for name, equation in reversed(pending):
            found = [more for partial in found for more in self._extended(partial, name, equation)]
        return tuple(found)

    def _extended(self, partial: Solution, name: str, equation: Scalar) -> list[Solution]:
        parts = [put_in(k, partial.values) for k in coefficients(equation, name)]
        return [
            Solution(
                {**partial.values, name: found.value},
                partial.free,
                partial.real_if if found.real_if is None else (*partial.real_if, found.real_if),
            )
            for found in real_roots(parts, self.positive)
        ]


def put_in(value: Scalar, values: Mapping[str, Value]) -> Value:
    """With values for unknowns; a ball where one of those it holds is only enclosed. Raises NotDerivable
    where parameters are left beside it."""
    used = {name: values[name] for name in value.generators() if name in values}
    exact = {name: each for name, each in used.items() if isinstance(each, Scalar)}
    if len(exact) == len(used):
        return value.substitute(exact)
    with ctx.workprec(BITS):
        try:
            balls = {n: each if isinstance(each, arb) else ball(each, {}) for n, each in used.items()}
            return ball(value, balls)
        except KeyError as error:
            raise NotDerivable(BESIDE) from error


def _stuck(equations: Sequence[Scalar]) -> str:
    from derive.algebra.infix import text
    from derive.algebra.readable.form import readable

    left = "; ".join(f"{text(readable(each))} = 0" for each in equations[:4])
    return f"no unknown can be eliminated from what is left: {left}"
