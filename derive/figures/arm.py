"""A robot in one pose, from its own forward kinematics: the pieces of its links, its joints and frames."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import dist
from typing import Any

from derive.algebra.numbers.floats import number
from derive.expression import Expr, Symbol, free_symbols
from derive.figures.view import Vector, between, dot, unit
from derive.mechanics.dh import moves
from derive.mechanics.motion import Axis, Move
from derive.mechanics.oracle import compose
from derive.mechanics.robot import DHRow, Link, Robot

SMALL = 1e-9
JOINT, ONE_OF_MANY, OF_WRIST = (
    0.1,
    0.07,
    0.22,
)  # of the whole arm: a joint, of more than MANY, of a wrist alone
MANY = 5


@dataclass(frozen=True, slots=True)
class Part:
    """A straight piece of a link from one place to another, and the length it is named by."""

    start: Vector
    end: Vector
    by: Expr
    moving: bool = False  # a prismatic joint stretches it
    along_joint: bool = False  # it is the offset of the joint that it begins at
    called: Symbol | None = None  # its letter in the table of link parameters


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint by its axis, and the variable it is named by."""

    at: Vector
    axis: Vector
    name: str
    slides: bool
    before: Vector  # the direction from which its angle counts
    offset: float = 0.0  # how far its link goes on along the axis, before it turns off


@dataclass(frozen=True, slots=True)
class Posed:
    """An arm in one pose."""

    parts: tuple[Part, ...]
    joints: tuple[Joint, ...]
    poses: tuple[Any, ...]  # of the frames 0, 1, ..., 4 by 4
    end: Any  # of the end-effector
    values: Mapping[str, float]  # of the joint variables and of all symbols

    @property
    def places(self) -> list[Vector]:
        """The ends of all pieces of links, in order; where there is none, that of the end-effector."""
        return [p for part in self.parts for p in (part.start, part.end)] or [place_of(self.end)]


# -- the pose -----------------------------------------------------------------------------------------


def posed(robot: Robot, point: Mapping[str, float]) -> Posed:
    """The arm where its joint variables and all symbols have the values of `point`."""
    import numpy

    T = numpy.eye(4)
    parts: list[Part] = []
    joints: list[Joint] = []
    T = _run(T, robot.base, None, point, parts, joints)
    poses = [T]
    if robot.by_screws:
        from derive.figures.screw_links import chained

        T = chained(T, robot, point, parts, joints)
    else:
        for i, link in enumerate(robot.links, 1):
            before = len(parts)
            T = _run(T, moves(link, robot), link.variable, point, parts, joints)
            own = i - (robot.convention == "modified")
            parts[before:] = [_called(part, link, i, own) for part in parts[before:]]
            poses.append(T)
    T = _run(T, robot.tool, None, point, parts, joints)
    return Posed(tuple(parts), tuple(joints), tuple(poses), T, point)


def _called(part: Part, link: Link, i: int, before: int) -> Part:
    """With the letter of its length in the table: d_3, and a_3 or that of the link before."""
    if not isinstance(link.row, DHRow) or part.by not in (link.row.d, link.row.a):
        return part
    named = f"d_{i}" if part.along_joint or part.by != link.row.a else f"a_{before}"
    return replace(part, called=Symbol(named))


def _run(
    T: Any,
    row: Sequence[Move],
    variable: str | None,
    point: Mapping[str, float],
    parts: list[Part],
    joints: list[Joint],
) -> Any:
    """The pose after the moves of a row; the pieces of its link and its joint are added."""
    turned: Move | None = None  # the move before, where it is that of a joint
    for move in row:
        after = T @ compose((move,), point)
        moving = variable is not None and variable in free_symbols(move.by)
        start, end = place_of(T), place_of(after)
        if moving:
            axis = direction(T, move.axis, point)
            before = direction(T, "x", point)
            joints.append(Joint(start, axis, variable or "", move.kind == "translate", before))
        if move.kind == "translate" and length_between(start, end) > SMALL:
            beside = turned is not None and move.axis == turned.axis and not moving
            parts.append(Part(start, end, move.by, moving, beside))
            if beside:
                joints[-1] = replace(joints[-1], offset=dot(joints[-1].axis, between(start, end)))
        turned = move if moving and move.kind == "rotate" else None
        T = after
    return T


def direction(T: Any, axis: Axis, point: Mapping[str, float]) -> Vector:
    """An axis of a pose (4 by 4) in the base frame, of length 1."""
    if isinstance(axis, str):
        k = "xyz".index(axis)
        return float(T[0, k]), float(T[1, k]), float(T[2, k])
    local = [number(part, point) for part in axis]
    return unit([float(sum(T[i, j] * local[j] for j in range(3))) for i in range(3)])


def place_of(T: Any) -> Vector:
    """The origin of a pose (4 by 4)."""
    return float(T[0, 3]), float(T[1, 3]), float(T[2, 3])


def length_between(a: Vector, b: Vector) -> float:
    """How far two places are apart."""
    return dist(a, b)


def joint_size(posed: Posed) -> float:
    """Of a joint on paper: a share of the whole arm, a smaller one where many names need room, and a
    larger one of a wrist that stands alone."""
    places = posed.places
    spans = [max(p[k] for p in places) - min(p[k] for p in places) for k in range(3)]
    turning = [joint.at for joint in posed.joints if not joint.slides]
    wrist = len(posed.parts) == 1 and len(turning) > 2
    share = OF_WRIST if wrist else ONE_OF_MANY if len(posed.joints) > MANY else JOINT
    return max(spans) * share if max(spans) > SMALL else JOINT
