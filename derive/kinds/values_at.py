"""The results of a derivation at a point, in the shapes they have in the JSON: floats, and trees where
symbols are left."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from derive.algebra.numbers.floats import Point, completed, number
from derive.algebra.readable.terms import Style
from derive.derivation import Branch, Condition, Derivation, LinearSystem, Phrase, Result
from derive.expression import Expr, Matrix, Number, Relation, Symbol, free_symbols, walk
from derive.kinds.linear_systems import solution_at
from derive.kinds.partly import put_in

NOT_REAL = (ValueError, ZeroDivisionError, OverflowError)


def point_of(at: Mapping[str, Expr], where: Mapping[str, Expr]) -> Point:
    """A value for each name of `evaluate` and of `where` that has one; those that rest on others after
    them. Names whose value is not decided are left out."""
    return completed({}, {**where, **at})


@dataclass(frozen=True, slots=True)
class Here:
    """A point as its author gave it, values of `where` included: trees by name, and the floats they come to
    where they are decided. `partly` is False where nothing was given: then everything must be decided."""

    values: Mapping[Expr, Expr]
    point: Point
    partly: bool = True
    style: Style = field(default_factory=Style)

    @staticmethod
    def of(at: Mapping[str, Expr], where: Mapping[str, Expr], style: Style) -> Here:
        """The point with the values of `where`; decimals are kept where it has any."""
        given = {**where, **at}
        values: dict[Expr, Expr] = {Symbol(name): value for name, value in given.items()}
        nodes = (node for value in at.values() for node in walk(value))
        decimal = any(isinstance(node, Number) and node.decimal for node in nodes)
        return Here(values, point_of(at, where), bool(at), replace(style, decimals=style.decimals or decimal))

    def scalar(self, expr: Expr) -> Any:
        """A float where everything has a value; else a tree in the symbols left. Raises KeyError where that
        is not wanted."""
        if not self.partly or free_symbols(expr) <= self.point.keys():
            return number(expr, self.point)
        found = put_in(expr, self.values, self.style)
        return found if free_symbols(found) else number(found, {})

    def numbers(self, expr: Expr, rows: bool = False) -> Any:
        """The same of a scalar or a matrix; a column is a flat list unless it is to be `rows`."""
        if not isinstance(expr, Matrix):
            return self.scalar(expr)
        if expr.shape[1] == 1 and not rows:
            return [self.scalar(entry) for (entry,) in expr.rows]
        return [[self.scalar(entry) for entry in row] for row in expr.rows]

    def solution(self, system: LinearSystem) -> Any:
        """The numbers that solve equations; the equations with values put in where some are left open.
        Raises KeyError where that is not wanted, DivisionByZero where they have not one solution."""
        try:
            return solution_at(system, self.point)
        except KeyError:
            if not self.partly:
                raise
        named: dict[Expr, Expr] = {Symbol(name): value for name, value in system.names.items()}
        values = {**named, **self.values}
        left, right = (
            Matrix(tuple(tuple(put_in(entry, values, self.style) for entry in row) for row in each.rows))
            for each in (system.left, system.right)
        )
        return replace(system, left=left, right=right, names={})


def values_at(derivation: Derivation, here: Here) -> dict[str, Any]:
    """Every result at the point; those a fact `numbers` does not name only where the point decides them.

    Raises KeyError for a symbol without a value where nothing was given; ValueError, ZeroDivisionError or
    OverflowError where a result other than a branch has no real value there.
    """
    named = derivation.facts.numbers
    wanted = derivation.results if named is None else named
    found = {}
    for name, result in derivation.results.items():
        try:
            found[name] = _result(derivation, name, result, here)
        except (KeyError, *NOT_REAL):
            if name in wanted:
                raise
    return found


def _result(derivation: Derivation, name: str, result: Result, here: Here) -> Any:
    if name in derivation.matrices and isinstance(result, Matrix):
        return here.numbers(result, rows=True)
    return _value(result, here)


def _value(result: Result | Branch | Condition | tuple[Expr, ...], here: Here) -> Any:
    match result:
        case Branch():
            return _branch(result, here)
        case LinearSystem():
            return here.solution(result)
        case tuple():
            return [_value(part, here) for part in result]
        case float() | int() | str() | dict() | Phrase() | Relation():
            return result
        case _:
            return here.numbers(result)


def _branch(branch: Branch, here: Here) -> dict[str, Any]:
    """A branch that is not real at the point says so."""
    try:
        values = {name: _value(value, here) for name, value in branch.values.items()}
    except NOT_REAL:
        return {"when": branch.when, "real": False}
    return {**values, "when": branch.when}
