"""Trees as functions of a point, made once and called often: many poses, many branches."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import TypeAlias

from derive.algebra.numeric import FUNCTIONS, Point
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

Compiled: TypeAlias = Callable[[Point], float]
ROUNDING = 1e-9  # a square this little below zero is one of zero


@lru_cache(maxsize=8192)
def compiled(expr: Expr) -> Compiled:
    """The value of a scalar tree at a point. A square root of nearly zero is zero, where rounding made it
    negative; calling it raises KeyError for a name without a value, ValueError or ZeroDivisionError where
    the value is not real."""
    match expr:
        case Number() | Approximate() | Degrees():
            value = math.radians(float(expr.value)) if isinstance(expr, Degrees) else float(expr.value)
            return lambda _: value
        case Symbol("pi"):
            return lambda _: math.pi
        case Symbol(name):
            return lambda point: point[name]
        case Sum(terms):
            parts = tuple(map(compiled, terms))
            return lambda point: math.fsum(part(point) for part in parts)
        case Product(factors):
            parts = tuple(map(compiled, factors))
            return lambda point: math.prod(part(point) for part in parts)
        case _:
            return _rarer(expr)


def _rarer(expr: Expr) -> Compiled:
    match expr:
        case Quotient(top, bottom):
            above, below = compiled(top), compiled(bottom)
            return lambda point: above(point) / below(point)
        case Power(base, exponent):
            inner, power = compiled(base), compiled(exponent)
            return lambda point: float(inner(point) ** power(point))
        case Call("sqrt", (inside,)):
            square = compiled(inside)
            return lambda point: _root(square(point))
        case Call(function, arguments) if function in FUNCTIONS:
            plain, parts = FUNCTIONS[function], tuple(map(compiled, arguments))
            return lambda point: float(plain(*(part(point) for part in parts)))
        case _:
            raise NotDerivable(f"no number for {type(expr).__name__}")


def _root(square: float) -> float:
    return 0.0 if -ROUNDING < square < 0 else math.sqrt(square)
