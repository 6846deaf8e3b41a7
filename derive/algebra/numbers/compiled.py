"""Trees as functions of a point, made once and called often: many poses, many branches."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeAlias

from derive.algebra.numbers.floats import FUNCTIONS, Point, number, quotient
from derive.errors import NotDerivable
from derive.expression import (
    PI,
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
    children,
)

Compiled: TypeAlias = Callable[[Point], float]
Operation: TypeAlias = Callable[[Point, Sequence[float]], float]
ROUNDING = 1e-9  # a square this little below zero is one of zero


def compiled(expr: Expr) -> Compiled:
    """The value of a scalar tree at a point; parts that are the same object are computed once.

    A square root of nearly zero is zero, where rounding made it negative. Calling the function raises
    KeyError for a name without a value, ValueError or ZeroDivisionError where the value is not real.
    """
    places: dict[int, int] = {}
    program: list[tuple[Operation, tuple[int, ...]]] = []
    _add(expr, places, program)

    def value(point: Point) -> float:
        values: list[float] = []
        for operation, parts in program:
            values.append(operation(point, [values[k] for k in parts]))
        return values[-1]

    return value


def _add(expr: Expr, places: dict[int, int], program: list[tuple[Operation, tuple[int, ...]]]) -> int:
    """Where the value of a tree stands among those computed, in an order in which parts come first."""
    if id(expr) not in places:
        parts = tuple(_add(part, places, program) for part in children(expr))
        program.append((_operation(expr), parts))
        places[id(expr)] = len(program) - 1
    return places[id(expr)]


def _operation(expr: Expr) -> Operation:
    """What makes the value of a node from those of its parts."""
    match expr:
        case Symbol(name) if expr != PI:
            return lambda point, _: point[name]
        case Number() | Approximate() | Degrees() | Symbol():
            value = number(expr, {})
            return lambda point, parts: value
        case Sum():
            return lambda _, parts: math.fsum(parts)
        case Product():
            return lambda _, parts: math.prod(parts)
        case Quotient():
            return lambda _, parts: quotient(*parts)
        case Power():
            return lambda _, parts: FUNCTIONS["pow"](*parts)
        case Call("sqrt"):
            return lambda _, parts: 0.0 if -ROUNDING < parts[0] < 0 else math.sqrt(parts[0])
        case Call(function) if function in FUNCTIONS:
            plain = FUNCTIONS[function]
            return lambda _, parts: float(plain(*parts))
        case _:
            raise NotDerivable(f"no number for {type(expr).__name__}")
