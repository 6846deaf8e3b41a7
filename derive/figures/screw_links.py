"""Links of a chain of screws, of whose shape nothing is said: from point to point along the axes of
the frame in which the screws are given."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Any, TypeAlias

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.algebra.readable.form import readable
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Number, Symbol, add
from derive.figures.arm import SMALL, Joint, Part, direction, length_between, place_of
from derive.figures.view import Vector, between
from derive.mechanics.dh import moves
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Motion
from derive.mechanics.oracle import Oracle, compose
from derive.mechanics.robot import Robot, ScrewRow

Coordinates: TypeAlias = tuple[Expr, ...]  # three, in the base frame


def chained(T: Any, robot: Robot, point: Mapping[str, float], parts: list[Part], joints: list[Joint]) -> Any:
    """The pose (4 by 4) after the screws of an arm whose base is at T; the pieces of its links and its joints
    are added. What stands between two axes at home is carried by all joints before it."""
    home = Oracle(robot, {}).home(point)
    legs = iter(_links(robot, point, place_of(home)))
    parts += (_carried(leg, T) for leg in next(legs))
    for link, behind in zip(robot.links, legs, strict=True):
        row = link.row
        assert isinstance(row, ScrewRow)
        through = _numbers(row.through, point)
        at, axis = _place(T, through), direction(T, row.axis, point)
        joints.append(Joint(at, axis, link.variable or "", row.slide, direction(T, "x", point)))
        T = T @ compose(moves(link, robot), point)
        if length_between(at, there := _place(T, through)) > SMALL:
            parts.append(Part(at, there, row.by if row.slide else Symbol(""), moving=True))
        parts += (_carried(leg, T) for leg in behind)
    return T @ home


def _links(robot: Robot, point: Mapping[str, float], end: Vector) -> Iterator[list[Part]]:
    """The pieces of each link at home, that of the base first; each named by its length where both of its
    ends are given in the base frame."""
    rows = [link.row for link in robot.links if isinstance(link.row, ScrewRow)]
    origin, E = (0.0, 0.0, 0.0), compose((), point)
    known = [(ZERO, ZERO, ZERO), *(row.through for row in rows), _home(robot.home)]
    places = [origin, *(_numbers(row.through, point) for row in rows), end]
    axes = [(0.0, 0.0, 1.0), *(direction(E, row.axis, point) for row in rows)]
    last = origin  # the way of the leg before, upon which none goes back
    for k, (a, b) in enumerate(pairwise(places)):
        legs = [*_legs(a, b, known[k], known[k + 1], axes[k], last)] if length_between(a, b) > SMALL else []
        last = between(legs[-1].start, legs[-1].end) if legs else last
        yield legs


def _carried(leg: Part, T: Any) -> Part:
    return replace(leg, start=_place(T, leg.start), end=_place(T, leg.end))


def _place(T: Any, at: Vector) -> Vector:
    x, y, z = ((T[i, :3] @ at + T[i, 3]) for i in range(3))
    return float(x), float(y), float(z)


def _numbers(at: Coordinates, point: Mapping[str, float]) -> Vector:
    x, y, z = (number(part, point) for part in at)
    return x, y, z


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
