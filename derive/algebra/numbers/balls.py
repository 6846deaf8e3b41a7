"""Numbers in ball arithmetic: trees with many digits, normal forms with as many bits as their signs take."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import lru_cache

from flint import arb, ctx, fmpq_mpoly

from derive.algebra.fixed_angles.constants import FUNCTIONS
from derive.algebra.fold import Domain, fold
from derive.algebra.infix import text
from derive.algebra.multivariate import ball_at
from derive.algebra.rationals import to_flint
from derive.algebra.readable.form import readable
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable, NotReal
from derive.expression import Expr

BITS = 600
FEWEST_BITS, MOST_BITS = 128, 1 << 14  # with which a sign is asked for, at first and at most


class _Balls(Domain[arb]):
    """Numbers in ball arithmetic, at the working precision of FLINT, where each symbol has one."""

    def __init__(self, point: Mapping[str, arb]) -> None:
        self.point = point

    def number(self, value: Fraction) -> arb:
        return arb(to_flint(value))

    def approximate(self, value: float) -> arb:
        return arb(value)

    def degrees(self, value: Fraction) -> arb:
        return arb.pi() * arb(to_flint(value / 180))

    def symbol(self, name: str) -> arb:
        return arb.pi() if name == "pi" else self.point[name]

    def call(self, function: str, arguments: list[arb]) -> arb:
        return FUNCTIONS[function](*arguments) if function in FUNCTIONS else self.refuse(function)


def precise(expr: Expr, point: Mapping[str, arb]) -> arb:
    """The value of a scalar expression, at the working precision of FLINT. Raises KeyError for a symbol
    without one, NotDerivable for what is no scalar."""
    return fold(expr, _Balls(point))


def slope(function: Callable[[arb], arb], at: arb) -> arb:
    """A central difference over a step so small that hundreds of bits are right."""
    step = arb(2) ** (-BITS // 4)
    return (function(at + step).mid() - function(at - step).mid()) / (2 * step)


def number_ball(value: Scalar) -> arb:
    """The value, at the working precision of FLINT. Raises KeyError where a symbol is left."""
    top = _polynomial(value.numerator, value.ring)
    return top if value.denominator is None else top / _polynomial(value.denominator, value.ring)


def number_sign(value: Scalar) -> int:
    """1, 0 or -1. Raises KeyError where a symbol is left, and NotDerivable where no number of bits tells."""
    if not value:
        return 0
    if (exact := value.constant) is not None:
        return 1 if exact > 0 else -1
    bits = FEWEST_BITS
    while bits <= MOST_BITS:
        with ctx.workprec(bits):
            ball = number_ball(value)
            if ball > 0 or ball < 0:
                return 1 if ball > 0 else -1
        bits *= 2
    if ball.is_nan():
        raise NotReal(f"{text(readable(value))} is not real")
    raise NotDerivable(f"{MOST_BITS} bits do not tell whether {text(readable(value))} is zero")


def _polynomial(polynomial: fmpq_mpoly, home: Ring) -> arb:
    return ball_at(polynomial, lambda place: _generator(home, home.names[place], ctx.prec))


@lru_cache(maxsize=1024)
def _generator(home: Ring, name: str, bits: int) -> arb:
    """The value of a generator, at the working precision of so many bits."""
    return precise(readable(Scalar(home, home.gen(name))), {})
