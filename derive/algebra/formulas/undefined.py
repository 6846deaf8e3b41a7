"""Numbers that are none: sqrt(-4), acos(2), log(0), 1/(x - x), exp(1000).

Decided in ball arithmetic, so that rounding is never taken for a fault: sqrt(1 - cos(1)^2 - sin(1)^2) is
the root of zero. An expression with symbols is looked at for one thing only, whether it is always zero.
"""

from __future__ import annotations

from collections.abc import Iterator

from flint import arb, ctx

from derive.algebra.ball_arithmetic import BITS, precise
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Power, children, free_symbols

LARGEST = arb(10) ** 300
NOTHING = arb(10) ** -100
MANY = 400  # parts; of longer ones it is not asked whether they are always zero


def undefined(expr: Expr) -> str:
    """Why the outermost operation of a tree without symbols gives no real number; "" where it gives one."""
    with ctx.workprec(BITS):
        try:
            return _reason(expr)
        except (NotDerivable, KeyError, ValueError, ZeroDivisionError, OverflowError):
            return ""


def negative(expr: Expr) -> bool:
    """Whether a tree without symbols is a negative number."""
    with ctx.workprec(BITS):
        try:
            return bool(precise(expr, {}) < 0)
        except (NotDerivable, KeyError, ValueError, ZeroDivisionError, OverflowError):
            return False


def always_zero(expr: Expr) -> bool:
    """Whether an expression is zero whatever its symbols are."""
    if sum(1 for _ in _parts(expr)) > MANY:
        return False
    with ctx.workprec(BITS):
        return all(_vanishes(expr, shift) for shift in (2, 11))


def _vanishes(expr: Expr, shift: int) -> bool:
    try:
        names = sorted(free_symbols(expr))
        value = precise(expr, {name: arb(k + shift).sqrt() for k, name in enumerate(names)})
    except (NotDerivable, ValueError, ZeroDivisionError, OverflowError):
        return False
    return bool(value.abs_upper() < NOTHING)


def _parts(expr: Expr) -> Iterator[Expr]:
    yield expr
    for part in children(expr):
        yield from _parts(part)


def _reason(expr: Expr) -> str:
    if isinstance(expr, Call):
        values = [precise(argument, {}) for argument in expr.arguments]
        if said := _outside(expr.function, values):
            return said
    if isinstance(expr, Power):
        base, exponent = (precise(part, {}) for part in (expr.base, expr.exponent))
        if base < 0 and not exponent.contains_integer():
            return "this power of a negative number is not real"
    value = precise(expr, {})
    return "this number is too large" if abs(value) > LARGEST else ""


def _outside(function: str, values: list[arb]) -> str:
    """What the function has no value at."""
    (x, *others) = values
    if function == "sqrt" and x < 0:
        return f"the square root of {_said(x)} is not real"
    if function in ("acos", "asin") and abs(x) > 1:
        return f"{function} of {_said(x)} is not real: it is beyond 1"
    if function == "log" and x < NOTHING:
        return f"log of {_said(x)} is not real" if x < 0 and not abs(x) < NOTHING else "log of 0 is infinite"
    if function == "tan" and abs(x.cos()) < NOTHING:
        return "tan is infinite there"
    if function == "atan2" and all(abs(each) < NOTHING for each in (x, *others)):
        return "atan2(0, 0) has no direction"
    if function == "exp" and x > LARGEST.log():
        return f"exp({_said(x)}) is too large a number"
    return ""


def _said(value: arb) -> str:
    return f"{float(value.mid()):.6g}"
