"""What is often put together of nodes: functions by their names, columns, relations, quantities."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from derive.expression.nodes import (
    Approximate,
    Call,
    Degrees,
    Expr,
    Matrix,
    Number,
    Power,
    Product,
    Quotient,
    Symbol,
    add,
    negate,
    number,
)


@dataclass(frozen=True, slots=True)
class Relation:
    """`left sign right`, as theta2 > 0; with a relation on its left a chain, as 0 <= t <= 1."""

    left: Expr | Relation
    sign: str
    right: Expr


def between(low: Expr, middle: Expr, high: Expr) -> Relation:
    """`low <= middle <= high`."""
    return Relation(Relation(low, "<=", middle), "<=", high)


def symbols(names: str) -> tuple[Symbol, ...]:
    """`a, b = symbols("a b")`."""
    return tuple(Symbol(name) for name in names.split())


def is_negative(expr: Expr) -> bool:
    """Whether it prints with a leading minus sign."""
    match expr:
        case Number(value) | Degrees(value):
            return value < 0
        case Approximate(approximate):
            return approximate < 0
        case Product((first, *_)):
            return is_negative(first)
        case Quotient(top, _):
            return is_negative(top)
        case _:
            return False


def subtract(left: Expr, right: Expr) -> Expr:
    """`left - right`."""
    return add(left, negate(right))


def squared(expr: Expr) -> Expr:
    """`expr^2`."""
    return Power(expr, number(2))


def cos(angle: Expr) -> Call:
    return Call("cos", (angle,))


def sin(angle: Expr) -> Call:
    return Call("sin", (angle,))


def sqrt(expr: Expr) -> Call:
    return Call("sqrt", (expr,))


def atan2(y: Expr, x: Expr) -> Call:
    """Always y first here; the notation of a sheet decides how it is printed."""
    return Call("atan2", (y, x))


def transpose(expr: Expr) -> Call:
    return Call("transpose", (expr,))


def cross(left: Expr, right: Expr) -> Call:
    return Call("cross", (left, right))


def column(entries: Iterable[Expr]) -> Matrix:
    """A column vector."""
    return Matrix(tuple((entry,) for entry in entries))
