"""The moves by which a person solves polynomial equations, one at a time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import product
from operator import mul
from typing import TypeAlias

from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.algebra.solving.polynomials import coefficients, degree, holds, monomials, numerator


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


Equation: TypeAlias = tuple[Scalar, ...]  # irreducible factors, one of which vanishes
Moved: TypeAlias = tuple[Move, list[Scalar]]  # what was done, and the equations that are left


def splitting(equations: list[Equation], unknowns: tuple[str, ...]) -> Equation | None:
    """The simplest equation that is a product."""
    products = [each for each in equations if len(each) > 1]
    return min(products, key=lambda each: sum(degree(p, unknowns) for p in each), default=None)


def whole(equation: Equation) -> Scalar:
    """The product of its factors."""
    return reduce(mul, equation)


def same(left: Equation, right: Equation) -> bool:
    """Whether their factors are the same but for numbers, one after the other."""
    return len(left) == len(right) and all(map(proportional, left, right))


def proportional(left: Scalar, right: Scalar) -> bool:
    """Whether one is a number times the other."""
    if not left or not right or len(left.numerator) != len(right.numerator):
        return False
    a, b = (as_fraction(each.numerator.leading_coefficient()) for each in (left, right))
    return left / a == right / b


def by_given(first: Scalar | None, equations: list[Equation], unknowns: tuple[str, ...]) -> Moved | None:
    """The equation of the case itself, where it gives an unknown; it comes before anything else is split."""
    if first is None:
        return None
    for place, equation in enumerate(equations):
        if len(equation) == 1 and proportional(equation[0], first):
            others = [whole(each) for k, each in enumerate(equations) if k != place]
            found = linear([equation[0]], unknowns)
            if found is None or found[0].value is None:
                return None
            values = {found[0].variable: found[0].value}
            return found[0], [each.substitute(values) for each in others]
    return None


def by_squares(equations: list[Scalar]) -> Moved | None:
    """An equation x^2 + y^2 = 0 as x = 0 and y = 0."""
    for equation in equations:
        if len(equation.numerator) > 1 and sign_of(equation) is not None:
            rest = [each for each in equations if each is not equation]
            return Move("squares", equation), [*monomials(equation), *rest]
    return None


def linear(equations: list[Scalar], unknowns: tuple[str, ...]) -> Moved | None:
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


def square(equations: list[Scalar], unknowns: tuple[str, ...]) -> Moved | None:
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


def last(equations: list[Scalar], unknowns: tuple[str, ...]) -> Moved | None:
    """An equation in one unknown that no other equation holds: it is solved in the end."""
    for equation, name in one_unknown(equations, unknowns):
        others = [each for each in equations if each is not equation]
        if not any(holds(each, (name,)) for each in others):
            return Move("last", equation, name), others
    return None


def solvable_last(equations: list[Scalar], unknowns: tuple[str, ...]) -> Moved | None:
    """An equation quadratic in an unknown that no other equation holds."""
    for equation, name in product(equations, reversed(unknowns)):
        others = [each for each in equations if each is not equation]
        k = coefficients(equation, name)
        solvable = bool(others) and len(k) == 3 and not holds(k[2], unknowns)
        if solvable and not any(holds(each, (name,)) for each in others):
            return Move("last", equation, name), others
    return None


def one_unknown(equations: Sequence[Scalar], unknowns: tuple[str, ...]) -> list[tuple[Scalar, str]]:
    """The equations in a single unknown, with it."""
    found = ((each, [name for name in unknowns if holds(each, (name,))]) for each in equations)
    return [(each, names[0]) for each, names in found if len(names) == 1]


def solvable(equation: Scalar, unknowns: tuple[str, ...]) -> str:
    """An unknown of which the only equation left can be solved, the others being free."""
    for name in reversed(unknowns):
        k = coefficients(equation, name)
        if len(k) == 3 and not holds(k[2], unknowns):
            return name
    return ""


def defining(move: Move) -> Scalar:
    """The polynomial whose roots the unknown is."""
    symbol = Scalar.symbol(move.variable)
    if move.value is None:
        assert move.equation is not None
        return move.equation
    return numerator((symbol if move.rule == "linear" else symbol * symbol) - move.value)
