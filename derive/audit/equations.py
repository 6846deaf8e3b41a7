"""Linear equations that are told in place of a result: what they come to."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain
from typing import Any, TypeGuard

import sympy

from derive.audit.budget import spend
from derive.audit.linear import solve
from derive.audit.points import Point, Value
from derive.audit.text import Json, Names, Unreadable, sympy_of_text


def is_system(told: Json) -> TypeGuard[Mapping[str, Any]]:
    """Whether a result is equations and their unknowns."""
    return isinstance(told, Mapping) and "equations" in told


def solution(told: Mapping[str, Any], names: Names, point: Point) -> Value:
    """The unknowns that are the result, or rows of them. Raises ZeroDivisionError where they
    have not one value."""
    with_them = {name: sympy_of_text(text, names) for name, text in told.get("where", {}).items()}
    known = {name: value for name, value in names.items() if name not in with_them}
    texts = ([sympy_of_text(side, known) for side in each.split(" = ")] for each in told["equations"])
    gaps = [left - right for left, right in texts]
    rows = [each if isinstance(each, list) else [each] for each in told["unknowns"]]
    unknowns = [*map(sympy.Symbol, (*chain(*rows), *told.get("auxiliary", ())))]
    if any(value.has(*unknowns) for value in with_them.values()):
        raise Unreadable("a coefficient holds an unknown")
    spend(len(unknowns) * sum(map(len, told["equations"])))  # each is differentiated by each
    point = point.where(**with_them)  # worked out there once, and long
    nothing = dict.fromkeys(unknowns, 0)
    left = [[point.at(gap.diff(each)) for each in unknowns] for gap in gaps]
    right = [[-point.at(gap.subs(nothing))] for gap in gaps]
    found = iter(row[0] for row in solve(left, right))
    values = [[next(found) for _ in row] for row in rows]
    return [*values] if isinstance(told["unknowns"][0], list) else [*chain(*values)]
