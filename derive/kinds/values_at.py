"""The results of a derivation in floats at a point, in the shapes they have in the JSON."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.numeric import Point, number, number_rows, numbers
from derive.derivation import Branch, Derivation, Result
from derive.expression import Expr, Matrix

NOT_REAL = (ValueError, ZeroDivisionError, OverflowError)


def point_of(at: Mapping[str, Expr], where: Mapping[str, Expr]) -> dict[str, float]:
    """A value for each name of `evaluate` and of `where`. Raises KeyError for a name without one."""
    point = {name: number(value, {}) for name, value in at.items()}
    for name, value in where.items():
        point[name] = number(value, point)
    return point


def values_at(derivation: Derivation, point: Point) -> dict[str, Any]:
    """Every result in floats.

    Raises KeyError for a symbol without a value; ValueError, ZeroDivisionError or OverflowError where a
    result other than a branch has no real value there.
    """
    return {
        name: number_rows(result, point)
        if name in derivation.matrices and isinstance(result, Matrix)
        else _value(result, point)
        for name, result in derivation.results.items()
    }


def _value(result: Result | Branch | tuple[Expr, ...], point: Point) -> Any:
    match result:
        case Branch():
            return _branch(result, point)
        case tuple():
            return [_value(part, point) for part in result]
        case float() | int() | str():
            return result
        case _:
            return numbers(result, point)


def _branch(branch: Branch, point: Point) -> dict[str, Any]:
    """A branch that is not real at the point says so."""
    try:
        values = {name: _value(value, point) for name, value in branch.values.items()}
    except NOT_REAL:
        return {"when": branch.when, "real": False}
    return {**values, "when": branch.when}
