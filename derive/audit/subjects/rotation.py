"""A rotation matrix that is given as such; one of nine names stands for any, made of three angles here."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import sympy

from derive.audit import orientation, turning
from derive.audit.asked import Asked, Holds, Test
from derive.audit.conditions import holds
from derive.audit.points import NEAR, ROUNDED, Point
from derive.audit.poses import UNIT, homogeneous, turned
from derive.audit.putting_back import array, flat, put_back, rounded
from derive.audit.registry import Auditor
from derive.audit.turns import DIFFER, rotation
from derive.mechanics.rotations import GivenRotation

ANGLES = sympy.symbols("_a _b _c")
AXES = ((2, -3, 6, 7), (0, 3, -4, 5), (0, 0, 1, 1))  # of half turns, and their lengths


def angles(given: GivenRotation) -> frozenset[str]:
    """Those of any rotation."""
    return frozenset(map(str, ANGLES)) if given.names else frozenset()


def pose(asked: Asked, point: Point) -> sympy.Matrix:
    """T (4 by 4), of any rotation by its three angles where the point has it so."""
    names = asked.subject.names
    known = point.fixed.get(names[0]) if names else None
    if isinstance(known, sympy.Basic) and known.free_symbols & {*ANGLES}:
        return homogeneous(_any())
    rows = [[asked.formula(entry) for entry in row] for row in asked.subject.matrix.rows]
    return homogeneous(sympy.Matrix(rows))


def _any() -> sympy.Matrix:
    a, b, c = ANGLES
    R: sympy.Matrix = turned(UNIT["z"], a) * turned(UNIT["y"], b) * turned(UNIT["x"], c)
    return R


def _named(asked: Asked, point: Point, R: Any) -> Point:
    """The point where the entries by their names are those of a rotation."""
    entries = zip(asked.subject.names, list(sympy.Matrix(R)), strict=True) if asked.subject.names else ()
    return point.where(**dict(entries))


def axis_angle(asked: Asked, point: Point) -> Iterator[Test]:
    """The turn from 0 to pi, its opposite, and those that any rotation has where it is singular."""
    branches = asked.objects("solutions")
    yield from orientation.kinds(pose)["axis-angle"](asked, point)
    for branch in branches[:2]:
        yield _put_back(asked, point, branch)
    if len(branches) == 1:
        yield Holds("solutions", asked.results["axis"] == "any", "there is an opposite turn too")
    met = 0
    for R in (sympy.eye(3), *map(_half_turn, AXES)) if asked.subject.names else ():
        there = _named(asked, point, R)
        for branch in branches[2:]:
            if holds(str(branch["when"]).partition(", where")[0], asked, there):
                met += 1
                yield _put_back(asked, there, branch)
    if asked.evaluated:
        yield from _in_numbers(asked)
    yield Holds("solutions", met == max(len(branches) - 2, 0), f"{met} of the singular cases are met once")


def _in_numbers(asked: Asked) -> Iterator[Test]:
    """Where the author wants numbers, those turns that are some there."""
    for branch in asked.objects("evaluated solutions"):
        if branch.get("real", True):
            yield _put_back(asked, asked.here, branch, "evaluated solutions")


def _half_turn(axis: tuple[int, int, int, int]) -> sympy.Matrix:
    k = sympy.Matrix(axis[:3]) / axis[3]
    return 2 * k * k.T - sympy.eye(3)


def _put_back(asked: Asked, point: Point, branch: Mapping[str, Any], name: str = "solutions") -> Test:
    """The rotation by an angle about an axis; about any axis where it is by none."""
    there = point.in_digits()
    angle, axis = asked.read(branch["angle"]), asked.read(branch.get("axis", ["0", "0", "1"]))
    R = array(pose(asked, there)[:3, :3], there)
    near = ROUNDED if rounded([angle, axis]) else NEAR
    return put_back(name, there, rotation(flat(axis, there), *there.turn(angle)), R, DIFFER, near)


def _at_rotations(audit: Auditor) -> Auditor:
    """Asked where the names of entries are those of a rotation."""

    def placed(asked: Asked, point: Point) -> Iterator[Test]:
        return audit(asked, _named(asked, point, _any()) if asked.subject.names else point)

    return placed


KINDS = {
    "euler-angles": _at_rotations(orientation.kinds(pose)["euler-angles"]),
    "axis-angle": _at_rotations(axis_angle),
    **turning.kinds(pose, lambda asked: asked.subject.variables),
}
