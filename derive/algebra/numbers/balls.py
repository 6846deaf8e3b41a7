"""Numbers in ball arithmetic: trees with many digits, normal forms with as many bits as their signs take."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache

from flint import arb, ctx, fmpq, fmpq_mpoly

from derive.algebra.fixed_angles.constants import FUNCTIONS
from derive.algebra.infix import text
from derive.algebra.multivariate import ball_at
from derive.algebra.readable.form import readable
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable, NotReal
from derive.expression import Approximate, Call, Degrees, Expr, Number, Power, Product, Quotient, Sum, Symbol

BITS = 600
FEWEST_BITS, MOST_BITS = 128, 1 << 14  # with which a sign is asked for, at first and at most


def precise(expr: Expr, point: Mapping[str, arb]) -> arb:
    """The value of a scalar expression, at the working precision of FLINT. Raises KeyError."""
    match expr:
        case Number(value):
            return arb(fmpq(value.numerator, value.denominator))
        case Symbol(name):
            return arb.pi() if name == "pi" else point[name]
        case Sum(terms):
            return sum((precise(term, point) for term in terms), arb(0))
        case Product(factors):
            total = arb(1)
            for factor in factors:
                total = total * precise(factor, point)
            return total
        case Quotient(top, bottom):
            return precise(top, point) / precise(bottom, point)
        case Power(base, exponent):
            return precise(base, point) ** precise(exponent, point)
        case Degrees(value):
            return arb.pi() * arb(fmpq(value.numerator, 180 * value.denominator))
        case Call(function, arguments) if function in FUNCTIONS:
            return FUNCTIONS[function](*(precise(argument, point) for argument in arguments))
        case Approximate(approximate):
            return arb(approximate)
    raise NotDerivable(f"no number for {type(expr).__name__}")


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
