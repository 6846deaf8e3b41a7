"""The characteristic polynomial of a system or its loop, its array, and what must hold for stability."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from string import digits

from derive.algebra.numbers.balls import number_sign
from derive.algebra.scalar import Scalar
from derive.control.controllers import Controller
from derive.control.elimination import hidden
from derive.control.hurwitz import conditions, written
from derive.control.rational import Polynomial, Rational, names_in, shared, times
from derive.control.rational import written as collected
from derive.control.roots import roots
from derive.control.routh import routh, sign_changes
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Expr, Relation, Sum, add, free_symbols, multiply
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.system._plant import Plant, asked, plant
from derive.kinds.system._routh_steps import Array, trees_of
from derive.kinds.system.closed_loop import closed
from derive.names import free

MOST_SYMBOLIC, MOST = 8, 24  # degrees that are looked at, with symbols and without


@dataclass(frozen=True, slots=True)
class Answer:
    """`whole` is the characteristic polynomial as it is found, `final` with `where` replaced; the array is
    that of `final` without `factor`, which has no s in it."""

    plant: Plant
    base: Derivation
    found: tuple[Expr, ...]  # how the characteristic polynomial comes about
    hidden: Polynomial  # its factor that the transfer function does not show
    whole: Polynomial
    final: Polynomial
    factor: Scalar
    array: Array
    conditions: tuple[Scalar, ...]
    written: tuple[Relation, ...]  # the same as inequalities
    positive: frozenset[str]

    @property
    def symbols(self) -> list[str]:
        return sorted(names_in(self.array.polynomial))

    @property
    def changes(self) -> int:
        """Sign changes of a first column in numbers."""
        return sign_changes([number_sign(entry) for entry in self.array.column])


def answered(problem: Problem, controller: Controller | None, point: Place | None) -> Answer:
    """Raises NotDerivable where there are no poles, or too many."""
    base, solved, found, shown, beside = _characteristic(problem, controller, point)
    whole = times(beside, shown)
    if len(beside) > 1:
        found = (collected(beside, solved.style) * collected(shown, solved.style),)
    final = Rational((), whole).at(problem.names).den
    if len(final) < 2:
        raise NotDerivable("there are no poles, for the denominator has no s in it: nothing can be unstable")
    factor = shared(final) if any(k.constant is None for k in final if k) else Scalar.of(1)
    polynomial = tuple(k / factor for k in final)
    names = names_in(polynomial)
    most = MOST_SYMBOLIC if names else MOST
    if len(polynomial) - 1 > most:
        raise NotDerivable(f"the array is filled in up to degree {most}; this one has {len(polynomial) - 1}")
    positive = frozenset(name for name, what in problem.assumptions.items() if what == "positive")
    array = _array(polynomial, solved, controller)
    column = [*array.column, *([Scalar.of(0)] if array.mended else [])]
    needed = conditions(column, positive)
    said = tuple(written(each, solved.style) for each in needed)
    answer = Answer(solved, base, found, beside, whole, final, factor, array, needed, said, positive)
    if not names and "epsilon" in array.mended and answer.changes != right_of_axis(roots(polynomial)):
        raise NotDerivable(
            "a zero in the first column hides roots that lie symmetric to the origin; divide them out first, "
            "for the method of the small number does not count these"
        )
    return answer


def _characteristic(
    problem: Problem, controller: Controller | None, point: Place | None
) -> tuple[Derivation, Plant, tuple[Expr, ...], Polynomial, Polynomial]:
    """The derivation this rests on, the plant, how the polynomial comes about, the denominator of the
    transfer function with everything in it, and what the equations have besides."""
    if controller is None:
        solved = plant(problem, None, point)
        beside = hidden(solved.system, solved.rational.den, solved.style)
        return asked(problem, "transfer-function", source=None), solved, (), solved.rational.den, beside
    loop = closed(problem, controller, point)
    solved = loop.plant
    C, G = loop.loop.controller, loop.loop.plant
    parts = [(C.den, G.den), (C.num, G.num)]
    products = [_times(collected(side, solved.style) for side in pair) for pair in parts]
    terms = (term for each in products for term in (each.terms if isinstance(each, Sum) else (each,)))
    base = asked(problem, "closed-loop", controller=controller)
    beside = hidden(solved.system, G.den, solved.style)
    return base, solved, (add(*terms),), loop.transfer.den, beside


def _times(sides: Iterable[Expr]) -> Expr:
    """A product, sums last."""
    return multiply(*sorted(sides, key=lambda side: isinstance(side, Sum)))


def _array(polynomial: Polynomial, solved: Plant, controller: Controller | None) -> Array:
    sides = [side for equation in solved.system.equations for side in (equation.left, equation.right)]
    sides += [*solved.problem.where.values(), *(controller.gains if controller else ())]
    taken = frozenset[str]().union(*map(free_symbols, sides)) | set(solved.problem.where)
    indexed = {name.rstrip(digits).rstrip("_") for name in taken if name[-1:].isdigit()}
    epsilon = free(taken, "epsilon", "delta", "eta")
    letter = free(indexed, "rho", "q", "w")  # r_ij is an entry of R on other pages
    auxiliary = free(indexed, "A", "P", "Q")
    rows = routh(polynomial, epsilon)
    return Array(polynomial, rows, trees_of(rows, solved.style), solved.style, letter, epsilon, auxiliary)


def right_of_axis(found: tuple[complex, ...]) -> int:
    """How many roots have a positive real part."""
    return sum(each.real > 0 for each in found)
