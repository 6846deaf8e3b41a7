"""Links of a chain of screws, of whose shape nothing is said: from point to point along the base's axes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any, TypeAlias

from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Number, Symbol, add
from derive.figures.arm import SMALL, Joint, Part, length_between
from derive.figures.view import Vector, between
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Motion
from derive.mechanics.robot import Robot, ScrewRow

Coordinates: TypeAlias = tuple[Expr, ...]  # three, in the base frame


def links(robot: Robot, joints: Sequence[Joint], end: Vector) -> Iterator[Part]:
    """The pieces in order, each named by its length where both of its ends are given in the base frame."""
    rows = [link.row for link in robot.links if isinstance(link.row, ScrewRow)]
    known: list[Coordinates | None] = [None if robot.base else row.through for row in rows]
    places = [joint.at for joint in joints]
    if not robot.base:
        places, known = [(0.0, 0.0, 0.0), *places], [(ZERO, ZERO, ZERO), *known]
    known.append(None if robot.base else _home(robot.home))
    axes = [(0.0, 0.0, 1.0), *(joint.axis for joint in joints)][-len(places) :]
    last = (0.0, 0.0, 0.0)  # the way of the leg before, upon which none goes back
    for k, (a, b) in enumerate(pairwise((*places, end))):
        for leg in _legs(a, b, known[k], known[k + 1], axes[k], last) if length_between(a, b) > SMALL else ():
            last = between(leg.start, leg.end)
            yield leg


def _home(home: Any) -> Coordinates | None:
    """Where the end-effector is while all joints are at zero, as it is typed."""
    match home:
        case ByMatrix(matrix) if matrix.shape == (4, 4):
            return tuple(row[3] for row in matrix.rows[:3])
        case Motion(made) if all(move.kind == "translate" for move in made):
            return tuple(add(*(move.by for move in made if move.axis == letter)) for letter in "xyz")
        case _:
            return None


def _legs(
    a: Vector, b: Vector, at: Coordinates | None, to: Coordinates | None, axis: Vector, last: Vector
) -> Iterator[Part]:
    """From place to place along the axes of the base, that of the joint first; straight where their names are
    not known."""
    if at is None or to is None:
        yield Part(a, b, Symbol(""))
        return
    here = a
    for k in sorted(range(3), key=lambda each: ((b[each] - a[each]) * last[each] < 0, -abs(axis[each]))):
        if abs(b[k] - here[k]) > SMALL:
            there = (*here[:k], b[k], *here[k + 1 :])
            yield Part(here, (there[0], there[1], there[2]), _difference(at[k], to[k]))
            here = there[0], there[1], there[2]


def _difference(a: Expr, b: Expr) -> Expr:
    """How far it is from one coordinate to another, as short as may be."""
    if a == ZERO or b == ZERO:
        return b if a == ZERO else a
    if isinstance(a, Number) and isinstance(b, Number):
        return Number(abs(b.value - a.value), a.decimal or b.decimal, a.unit or b.unit)
    try:
        return readable(normal(b - a))
    except NotDerivable:
        return Symbol("")
