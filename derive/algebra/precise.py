"""Trees as numbers of many digits, for differences that lose none that matter."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from flint import arb, fmpq

from derive.errors import NotDerivable
from derive.expression import (
    Approximate,
    Call,
    Degrees,
    Expr,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

BITS = 600
FUNCTIONS: Mapping[str, Callable[..., arb]] = {
    "cos": arb.cos, "sin": arb.sin, "tan": arb.tan, "sqrt": arb.sqrt, "exp": arb.exp, "log": arb.log,
    "acos": arb.acos, "asin": arb.asin, "atan": arb.atan, "atan2": arb.atan2, "abs": abs, "sign": arb.sgn,
    "pow": arb.__pow__,
}  # fmt: skip


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
