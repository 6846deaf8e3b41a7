"""Numbers in ball arithmetic (FLINT's arb): intervals that certainly hold the value.

A ball that does not hold zero proves that a number is not zero; one that holds it proves nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction

from flint import arb

from derive.algebra.fold import Domain, fold
from derive.algebra.rationals import to_flint
from derive.expression import Expr

BITS = 600  # for differences that lose no digits that matter
FUNCTIONS: Mapping[str, Callable[..., arb]] = {
    "cos": arb.cos, "sin": arb.sin, "tan": arb.tan, "sqrt": arb.sqrt, "exp": arb.exp, "log": arb.log,
    "acos": arb.acos, "asin": arb.asin, "atan": arb.atan, "atan2": arb.atan2, "abs": abs, "sign": arb.sgn,
    "pow": arb.__pow__,
}  # fmt: skip


class Balls(Domain[arb]):
    """Numbers in ball arithmetic, at the working precision of FLINT, where each symbol has one."""

    def __init__(self, point: Mapping[str, arb]) -> None:
        self.point = point

    def number(self, value: Fraction) -> arb:
        """An exact rational."""
        return arb(to_flint(value))

    def approximate(self, value: float) -> arb:
        """The float, exactly."""
        return arb(value)

    def degrees(self, value: Fraction) -> arb:
        """In radians."""
        return arb.pi() * arb(to_flint(value / 180))

    def symbol(self, name: str) -> arb:
        """Its value at the point, or pi."""
        return arb.pi() if name == "pi" else self.point[name]

    def root(self, value: arb, degree: int) -> arb:
        """Of what may be zero the root of its part that is not negative."""
        return (value if value < 0 else value.nonnegative_part()).root(degree)

    def call(self, function: str, arguments: list[arb]) -> arb:
        """A function of this table."""
        return FUNCTIONS[function](*arguments) if function in FUNCTIONS else self.refuse(function)


def balls(point: Mapping[str, arb]) -> Domain[arb]:
    """The domain of balls where each symbol has this value."""
    return Balls(point)


def precise(expr: Expr, point: Mapping[str, arb]) -> arb:
    """The value of a scalar expression, at the working precision of FLINT. Raises KeyError for a symbol
    without one, NotDerivable for what is no scalar."""
    return fold(expr, Balls(point))


def slope(function: Callable[[arb], arb], at: arb) -> arb:
    """A central difference over a step so small that hundreds of bits are right."""
    step = arb(2) ** (-BITS // 4)
    return (function(at + step).mid() - function(at - step).mid()) / (2 * step)
