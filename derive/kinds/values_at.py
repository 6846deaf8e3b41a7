"""The results of a derivation in floats at a point, in the shapes they have in the JSON."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.numeric import Point, number, number_rows, numbers
from derive.derivation import Branch, Derivation, Result
from derive.expression import Expr, Matrix, free_symbols

NOT_REAL = (ValueError, ZeroDivisionError, OverflowError)


def point_of(at: Mapping[str, Expr], where: Mapping[str, Expr]) -> Point:
    """A value for each name of `evaluate`, and for those of `where` that follow from them.

    Raises KeyError where a value of `evaluate` has a symbol in it.
    """
    return completed({name: number(value, {}) for name, value in at.items()}, where)


def completed(point: Point, where: Mapping[str, Expr]) -> Point:
    """The point with the values of `where` added, those that rest on others after them. Names whose
    value is not decided by the point are left out."""
    found = dict(point)
    pending = dict(where)
    while ready := [name for name, value in pending.items() if free_symbols(value) <= {*found, "pi"}]:
        found.update({name: number(pending.pop(name), found) for name in ready})
    return found


def values_at(derivation: Derivation, point: Point) -> dict[str, Any]:
    """Every result in floats; those a fact `numbers` does not name only where the point decides them.

    Raises KeyError for a symbol without a value; ValueError, ZeroDivisionError or OverflowError where a
    result other than a branch has no real value there.
    """
    wanted = derivation.facts.get("numbers", tuple(derivation.results))
    found = {}
    for name, result in derivation.results.items():
        try:
            found[name] = _result(derivation, name, result, point)
        except (KeyError, *NOT_REAL):
            if name in wanted:
                raise
    return found


def _result(derivation: Derivation, name: str, result: Result, point: Point) -> Any:
    if name in derivation.matrices and isinstance(result, Matrix):
        return number_rows(result, point)
    return _value(result, point)


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
