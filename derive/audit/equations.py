"""Linear equations that are told in place of a result: what they come to."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeGuard

import sympy

from derive.audit.linear import solve
from derive.audit.points import Number, Point
from derive.audit.text import Json, Names, sympy_of_text


def is_system(told: Json) -> TypeGuard[Mapping[str, Any]]:
    """Whether a result is equations and their unknowns."""
    return isinstance(told, Mapping) and "equations" in told


def solution(told: Mapping[str, Any], names: Names, point: Point) -> list[Number]:
    """The unknowns that are the result. Raises ZeroDivisionError where they have not one value."""
    with_them = told.get("where", {})
    known = {**names, **{name: sympy_of_text(text, names) for name, text in with_them.items()}}
    texts = ([sympy_of_text(side, known) for side in each.split(" = ")] for each in told["equations"])
    gaps = [left - right for left, right in texts]
    unknowns = [*map(sympy.Symbol, (*told["unknowns"], *told.get("auxiliary", ())))]
    nothing = dict.fromkeys(unknowns, 0)
    left = [[point.at(gap.diff(each)) for each in unknowns] for gap in gaps]
    right = [[-point.at(gap.subs(nothing))] for gap in gaps]
    return [row[0] for row in solve(left, right)][: len(told["unknowns"])]
