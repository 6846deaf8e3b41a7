"""A robot in one pose, from its own forward kinematics: the pieces of its links, its joints and frames."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import dist, radians
from typing import Any

from derive.algebra.numbers.floats import number
from derive.expression import Expr, Symbol, free_symbols
from derive.figures.typical import completed
from derive.figures.view import Vector, View, dot, in_space, length, onto_plane, unit
from derive.mechanics.dh import moves
from derive.mechanics.motion import Move
from derive.mechanics.oracle import compose
from derive.mechanics.robot import Robot, ScrewRow

POSES = 60  # tried, to find one in which an arm in space can be read
PLANAR = (38, 42, -55, 40, -45, 35)  # degrees, joint after joint of an arm in a plane
SMALL = 1e-9


@dataclass(frozen=True, slots=True)
class Part:
    """A straight piece of a link from one place to another, and the length it is named by."""

    start: Vector
    end: Vector
    by: Expr
    moving: bool  # a prismatic joint stretches it


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint by its axis, and the variable it is named by."""

    at: Vector
    axis: Vector
    name: str
    slides: bool
    before: Vector  # the direction from which its angle counts


@dataclass(frozen=True, slots=True)
class Posed:
    """An arm in one pose."""

    parts: tuple[Part, ...]
    joints: tuple[Joint, ...]
    poses: tuple[Any, ...]  # of the frames 0, 1, ..., 4 by 4
    end: Any  # of the end-effector

    @property
    def places(self) -> list[Vector]:
        """The ends of all pieces of links, in order; where there is none, that of the end-effector."""
        return [p for part in self.parts for p in (part.start, part.end)] or [place_of(self.end)]


# -- the pose -----------------------------------------------------------------------------------------


def in_pose(
    robot: Robot, point: Mapping[str, float], usual: float, where: Mapping[str, Expr]
) -> tuple[View, Posed]:
    """How an arm is looked at, and the arm in a pose that shows it: in a plane with its joints bent, in space
    the clearest of some random poses, of screws with all joints at zero. `point` gives the symbols values,
    `usual` is the size of a length (m)."""

    def at(angles: Sequence[float], slides: Sequence[float]) -> Posed:
        values = dict(point)
        for k, link in enumerate(each for each in robot.links if each.variable):
            values[link.variable or ""] = slides[k] * usual if link.joint == "prismatic" else angles[k]
        return _pose(robot, completed(values, where))

    count = len(robot.variables)
    if robot.by_screws:
        found = at([0.0] * count, [0.0] * count)
        return _view(found), found
    first = at(
        [radians(PLANAR[k % len(PLANAR)]) for k in range(count)], [0.8 + 0.1 * k for k in range(count)]
    )
    view = _view(first)
    if view.flat:
        return view, first
    draw = random.Random(count)
    tried = [
        at(
            [draw.choice((-1, 1)) * radians(draw.uniform(15, 75)) for _ in range(count)],
            [draw.uniform(0.6, 1.1) for _ in range(count)],
        )
        for _ in range(POSES)
    ]
    return view, max(tried, key=lambda posed: _clarity(posed, view))


def _pose(robot: Robot, point: Mapping[str, float]) -> Posed:
    import numpy

    T = numpy.eye(4)
    parts: list[Part] = []
    joints: list[Joint] = []
    T = _run(T, robot.base, None, point, parts, joints)
    poses = [T]
    for link in robot.links:
        if isinstance(link.row, ScrewRow):
            joints.append(_screw(link.row, link.variable or "", T, point))
            continue
        T = _run(T, moves(link, robot), link.variable, point, parts, joints)
        poses.append(T)
    if robot.by_screws:
        T = T @ _home(robot, point)
        parts += _between(joints, T)
    T = _run(T, robot.tool, None, point, parts, joints)
    return Posed(tuple(parts), tuple(joints), tuple(poses), T)


def _run(
    T: Any,
    row: Sequence[Move],
    variable: str | None,
    point: Mapping[str, float],
    parts: list[Part],
    joints: list[Joint],
) -> Any:
    """The pose after the moves of a row; the pieces of its link and its joint are added."""
    for move in row:
        after = T @ compose((move,), point)
        moving = variable is not None and Symbol(variable) in _symbols(move.by)
        start, end = place_of(T), place_of(after)
        if moving:
            axis = _direction(T, move, point)
            before = (float(T[0, 0]), float(T[1, 0]), float(T[2, 0]))
            joints.append(Joint(start, axis, variable or "", move.kind == "translate", before))
        if move.kind == "translate" and length_between(start, end) > SMALL:
            parts.append(Part(start, end, move.by, moving))
        T = after
    return T


def _symbols(expr: Expr) -> set[Expr]:
    return {Symbol(name) for name in free_symbols(expr)}


def _direction(T: Any, move: Move, point: Mapping[str, float]) -> Vector:
    if isinstance(move.axis, str):
        k = "xyz".index(move.axis)
        return float(T[0, k]), float(T[1, k]), float(T[2, k])
    local = [number(part, point) for part in move.axis]
    return unit([float(sum(T[i, j] * local[j] for j in range(3))) for i in range(3)])


def _screw(row: ScrewRow, name: str, T: Any, point: Mapping[str, float]) -> Joint:
    import numpy

    at = T @ numpy.array([*(number(part, point) for part in row.through), 1.0])
    axis = _direction(T, Move("rotate", row.axis, row.by), point)
    return Joint((float(at[0]), float(at[1]), float(at[2])), axis, name, row.slide, (1.0, 0.0, 0.0))


def _home(robot: Robot, point: Mapping[str, float]) -> Any:
    from derive.mechanics.oracle import Oracle

    return Oracle(robot, {}).home(point)


def _between(joints: Sequence[Joint], T: Any) -> Iterator[Part]:
    """Straight links from joint to joint of a chain of screws, which says nothing of their shape."""
    stops = [joint.at for joint in joints] + [place_of(T)]
    for start, end in pairwise(stops):
        if length_between(start, end) > SMALL:
            yield Part(start, end, Symbol(""), False)


def place_of(T: Any) -> Vector:
    """The origin of a pose (4 by 4)."""
    return float(T[0, 3]), float(T[1, 3]), float(T[2, 3])


def length_between(a: Vector, b: Vector) -> float:
    """How far two places are apart."""
    return dist(a, b)


# -- the view -----------------------------------------------------------------------------------------


def _view(posed: Posed) -> View:
    """The plane an arm moves in, if it does in one; else space."""
    axes = [joint.axis for joint in posed.joints if not joint.slides]
    if not axes:
        return in_space()
    normal = axes[0]
    level = dot(normal, posed.places[0])
    flat = all(abs(abs(dot(axis, normal)) - 1) < 1e-6 for axis in axes)
    flat &= all(abs(dot(joint.axis, normal)) < 1e-6 for joint in posed.joints if joint.slides)
    flat &= all(abs(dot(normal, place) - level) < 1e-6 for place in posed.places)
    return (onto_plane(normal) or in_space()) if flat else in_space()


def _clarity(posed: Posed, view: View) -> float:
    """How well a pose can be read: no link end on, no two joints on one spot, the arm above its base."""
    seen = 1.0
    for part in posed.parts:
        a, b = view.place(part.start), view.place(part.end)
        seen = min(seen, length((b[0] - a[0], b[1] - a[1])) / length_between(part.start, part.end))
    spots = [place_of(T) for T in posed.poses] + [place_of(posed.end)]
    distinct = [p for k, p in enumerate(spots) if all(length_between(p, q) > 1e-6 for q in spots[:k])]
    flat = [view.place(p) for p in distinct]
    spread = max((length((a[0] - b[0], a[1] - b[1])) for a in flat for b in flat), default=0.0) or 1.0
    gaps = [length((a[0] - b[0], a[1] - b[1])) / spread for k, a in enumerate(flat) for b in flat[:k]]
    low = min((p[2] for p in distinct), default=0.0) / spread
    turned = min((1 - abs(dot(view.front, joint.axis)) for joint in posed.joints), default=1.0)
    return (
        1.2 * seen
        + 1.5 * min([0.4, *gaps])
        + min(0.0, low)
        + 0.6 * min(turned, 0.4)
        + 0.15 * flat[-1][1] / spread
    )


def joint_size(posed: Posed) -> float:
    """Of a joint on paper: a share of the whole arm."""
    places = posed.places
    spans = [max(p[k] for p in places) - min(p[k] for p in places) for k in range(3)]
    return max(spans) * 0.1 if max(spans) > SMALL else 0.1
