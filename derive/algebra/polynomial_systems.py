"""Systems of polynomial equations, solved over the reals as one does by hand: case by case.

An equation that is a product splits the problem; a linear one, or one in which a square stands alone,
gives an unknown by the others; where neither is left, a Groebner basis over the rationals (FLINT)
eliminates. Every move is kept, so that the solution can be told. Bounded: what would take too long, or
leads to equations without exact or isolated roots, is refused with the equations that are left.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import TypeAlias

from flint import Ordering, arb, ctx, fmpz, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from derive.algebra.polynomials import (
    ball,
    coefficients,
    degree,
    factors,
    holds,
    monomials,
    numerator,
)
from derive.algebra.real_roots import BITS, real_roots
from derive.algebra.scalar import Scalar, as_fraction
from derive.algebra.signs import sign_of
from derive.errors import NotDerivable

MOST_CASES = 60
BASIS_LIMITS = (40, 120, 600)  # polynomials, terms, bits
LARGEST = 400  # terms of an equation
BESIDE = "a root that is only enclosed stands beside parameters: give them values"

Equation: TypeAlias = tuple[Scalar, ...]  # irreducible factors, one of which vanishes
Value: TypeAlias = Scalar | arb


@dataclass(frozen=True, slots=True)
class Move:
    """`rule` "linear": variable = value; "square": variable^2 = value; "last": `equation` gives the
    variable once the others are known; "squares": a sum of squares vanishes with each of them;
    "eliminate": what follows from all equations together is `left`."""

    rule: str
    equation: Scalar | None = None
    variable: str = ""
    value: Scalar | None = None
    left: tuple[Scalar, ...] = ()


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
    """Every real solution. Raises NotDerivable where it is out of reach."""
    return _Solver(tuple(positive)).case(None, _State(tuple(equations), tuple(unknowns)))


class _Impossible(Exception):
    def __init__(self, equation: Scalar) -> None:
        self.equation = equation


Pending = tuple[tuple[str, Scalar], ...]
Moved = tuple[Move, list[Scalar]]


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
            (*self.pending, (move.variable, _defining(move))),
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
            step = _given(first, left, state.unknowns) or _last(list(map(_whole, left)), state.unknowns)
            first = None
            if step is None and (several := _splitting(left, state.unknowns)) is not None:
                others = [_whole(each) for each in left if each is not several]
                cases = tuple(
                    self.case(part, state.where(part, several[:k], others)) for k, part in enumerate(several)
                )
                return Case(given, tuple(moves), several, cases)
            single = tuple(map(_whole, left))
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
            if not any(_same(kept, known) for known in found):
                found.append(kept)
        return found

    def _never_zero(self, polynomial: Scalar, state: _State) -> bool:
        """Excluded here, or of terms of one sign, one of them without an unknown that may vanish."""
        if any(_proportional(polynomial, each) for each in state.nonzero):
            return True
        if sign_of(polynomial, self.positive) is None:
            return False
        may_vanish = [name for name in state.unknowns if name not in self.positive]
        return any(not holds(term, may_vanish) for term in monomials(polynomial))

    @staticmethod
    def _move(single: tuple[Scalar, ...], state: _State) -> Moved | None:
        """What to do with equations none of which is a product."""
        equations = list(single)
        step = _by_squares(equations) or _linear(equations, state.unknowns)
        step = step or _square(equations, state.unknowns) or _solvable_last(equations, state.unknowns)
        if step is not None or _one_unknown(equations, state.unknowns) or state.eliminated:
            return step
        basis = groebner(equations, state.unknowns)
        if basis is None or all(any(_proportional(p, known) for known in equations) for p in basis):
            return None
        return Move("eliminate", left=tuple(basis)), basis

    def _by_roots(
        self, given: Scalar | None, moves: list[Move], single: tuple[Scalar, ...], state: _State
    ) -> Case:
        """Cases by the exact roots of an equation in one unknown that others need too, or by an equation
        that leaves unknowns free."""
        for equation, name in _one_unknown(single, state.unknowns):
            roots = real_roots(coefficients(equation, name), self.positive)
            if all(isinstance(each.value, Scalar) and each.real_if is None for each in roots):
                symbol = Scalar.symbol(name)
                parts = [symbol - each.value for each in roots if isinstance(each.value, Scalar)]
                cases = tuple(self.case(p, state.where(p, (), single)) for p in parts)
                return Case(given, tuple(moves), tuple(parts), cases)
        free = _solvable(single[0], state.unknowns) if len(single) == 1 else ""
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


def groebner(equations: Sequence[Scalar], unknowns: tuple[str, ...]) -> list[Scalar] | None:
    """The reduced basis for the lexicographic order of the unknowns, parameters last; None where it is
    out of reach or says nothing new."""
    homes = [each.ring for each in equations]
    if any(home.roots or home.angles for home in homes):
        return None
    used = sorted({name for each in equations for name in each.generators()} - set(unknowns))
    names = (*unknowns, *used)
    context = fmpz_mpoly_ctx.get(names, Ordering.lex)
    vector = fmpz_mpoly_vec([_integral(each, names, context) for each in equations], context)
    basis, done = vector.buchberger_naive(limits=BASIS_LIMITS)
    if not done:
        return None
    return [_scalar(each, names) for each in basis.autoreduction()]


def _integral(value: Scalar, names: tuple[str, ...], context: fmpz_mpoly_ctx) -> object:
    """The polynomial with whole coefficients."""
    terms = value.numerator.to_dict()
    bottom = 1
    for k in terms.values():
        bottom = bottom * int(k.q) // int(fmpz(bottom).gcd(fmpz(int(k.q))))
    places = [value.ring.index.get(name) for name in names]
    return context.from_dict(
        {
            tuple(0 if p is None else int(exponents[p]) for p in places): int(as_fraction(k) * bottom)
            for exponents, k in terms.items()
        }
    )


def _scalar(polynomial: fmpz_mpoly, names: tuple[str, ...]) -> Scalar:
    total = Scalar.of(0)
    for exponents, k in polynomial.to_dict().items():
        term = Scalar.of(int(k))
        for name, power in zip(names, exponents, strict=True):
            term = term * Scalar.symbol(name) ** int(power) if power else term
        total = total + term
    return total


# -- the moves -------------------------------------------------------------------------------------------


def _splitting(equations: list[Equation], unknowns: tuple[str, ...]) -> Equation | None:
    """The simplest equation that is a product."""
    products = [each for each in equations if len(each) > 1]
    return min(products, key=lambda each: sum(degree(p, unknowns) for p in each), default=None)


def _whole(equation: Equation) -> Scalar:
    total = equation[0]
    for part in equation[1:]:
        total = total * part
    return total


def _same(left: Equation, right: Equation) -> bool:
    return len(left) == len(right) and all(map(_proportional, left, right))


def _proportional(left: Scalar, right: Scalar) -> bool:
    """Whether one is a number times the other."""
    if not left or not right or len(left.numerator) != len(right.numerator):
        return False
    a, b = (as_fraction(each.numerator.leading_coefficient()) for each in (left, right))
    return left / a == right / b


def _given(first: Scalar | None, equations: list[Equation], unknowns: tuple[str, ...]) -> Moved | None:
    """The equation of the case itself, where it gives an unknown; before anything else is split."""
    if first is None:
        return None
    for place, equation in enumerate(equations):
        if len(equation) == 1 and _proportional(equation[0], first):
            others = [_whole(each) for k, each in enumerate(equations) if k != place]
            found = _linear([equation[0]], unknowns)
            if found is None or found[0].value is None:
                return None
            values = {found[0].variable: found[0].value}
            return found[0], [each.substitute(values) for each in others]
    return None


def _by_squares(equations: list[Scalar]) -> Moved | None:
    """x^2 + y^2 = 0."""
    for equation in equations:
        if len(equation.numerator) > 1 and sign_of(equation) is not None:
            rest = [each for each in equations if each is not equation]
            return Move("squares", equation), [*monomials(equation), *rest]
    return None


def _linear(equations: list[Scalar], unknowns: tuple[str, ...]) -> Moved | None:
    """The shortest equation that is linear in an unknown; the later unknown by the earlier ones."""
    candidates = [
        (len(equation.numerator), place, -at, equation, name, k)
        for place, equation in enumerate(equations)
        for at, name in enumerate(unknowns)
        if len(k := coefficients(equation, name)) == 2 and not holds(k[1], unknowns)
    ]
    if not candidates:
        return None
    _, _, _, equation, name, k = min(candidates, key=lambda each: each[:3])
    value = -k[0] / k[1]
    rest = [each.substitute({name: value}) for each in equations if each is not equation]
    return Move("linear", equation, name, value), rest


def _square(equations: list[Scalar], unknowns: tuple[str, ...]) -> Moved | None:
    """An unknown that occurs squared everywhere, its square given by one equation."""
    for equation, name in product(equations, reversed(unknowns)):
        k = coefficients(equation, name)
        if len(k) != 3 or k[1] or holds(k[2], unknowns):
            continue
        others = [each for each in equations if each is not equation]
        if not any(holds(each, (name,)) for each in others):
            continue
        value = -k[0] / k[2]
        parts = [coefficients(each, name) for each in others]
        if not any(odd for each in parts for odd in each[1::2]):
            return Move("square", equation, name, value), [_in_square(each, value) for each in parts]
    return None


def _in_square(parts: list[Scalar], value: Scalar) -> Scalar:
    total = Scalar.of(0)
    for power, k in enumerate(parts[::2]):
        total = total + k * value**power
    return total


def _last(equations: list[Scalar], unknowns: tuple[str, ...]) -> Moved | None:
    """An equation in one unknown that no other equation holds: it is solved in the end."""
    for equation, name in _one_unknown(equations, unknowns):
        others = [each for each in equations if each is not equation]
        if not any(holds(each, (name,)) for each in others):
            return Move("last", equation, name), others
    return None


def _solvable_last(equations: list[Scalar], unknowns: tuple[str, ...]) -> Moved | None:
    """An equation quadratic in an unknown that no other equation holds."""
    for equation, name in product(equations, reversed(unknowns)):
        others = [each for each in equations if each is not equation]
        k = coefficients(equation, name)
        solvable = bool(others) and len(k) == 3 and not holds(k[2], unknowns)
        if solvable and not any(holds(each, (name,)) for each in others):
            return Move("last", equation, name), others
    return None


def _one_unknown(equations: Sequence[Scalar], unknowns: tuple[str, ...]) -> list[tuple[Scalar, str]]:
    """The equations in a single unknown, with it."""
    found = ((each, [name for name in unknowns if holds(each, (name,))]) for each in equations)
    return [(each, names[0]) for each, names in found if len(names) == 1]


def _solvable(equation: Scalar, unknowns: tuple[str, ...]) -> str:
    """An unknown of which the only equation left can be solved, the others being free."""
    for name in reversed(unknowns):
        k = coefficients(equation, name)
        if len(k) == 3 and not holds(k[2], unknowns):
            return name
    return ""


def _defining(move: Move) -> Scalar:
    """The polynomial whose roots the unknown is."""
    symbol = Scalar.symbol(move.variable)
    if move.value is None:
        assert move.equation is not None
        return move.equation
    return numerator((symbol if move.rule == "linear" else symbol * symbol) - move.value)


def _stuck(equations: Sequence[Scalar]) -> str:
    from derive.algebra.readable import readable
    from derive.algebra.text import text

    left = "; ".join(f"{text(readable(each))} = 0" for each in equations[:4])
    return f"no unknown can be eliminated from what is left: {left}"
