"""Frames after Denavit and Hartenberg found from the axes of the joints.

Standard (Spong et al., section 3.2.2; Siciliano et al., section 2.8.2): z_{i-1} along the axis of joint i,
x_i along the common normal from z_{i-1} to z_i, its origin on z_i. Modified (Craig, section 3.4): z_i along
the axis of joint i, x_i along the common normal from z_i to z_{i+1}, its origin on z_i. Where the axes are
parallel, meet or coincide, or at the two ends, the convention leaves a choice.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, TypeAlias

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.unit_vectors import unit
from derive.mechanics.lines import Line, Relation, common_normal, dot, foot, on
from derive.mechanics.poses import homogeneous, inverse_pose, position_part, rotation_part
from derive.mechanics.robot import Convention

Kind: TypeAlias = Literal["world", "free", "end-effector", "last"] | Relation
UNITS = tuple(ScalarMatrix.column(e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
Pair = tuple[Scalar, Scalar]


@dataclass(frozen=True, slots=True)
class Placed:
    """A frame of the convention at zero: why it stands so, its x and z axes and origin (3 by 1, base).
    `turned` says that x was taken against z_a x z_b."""

    kind: Kind
    x: ScalarMatrix
    z: ScalarMatrix
    o: ScalarMatrix
    turned: bool = False

    @property
    def pose(self) -> ScalarMatrix:
        """T (4 by 4)."""
        R = ScalarMatrix.beside([self.x, self.z.cross(self.x), self.z])
        return homogeneous(R, self.o.entries)


@dataclass(frozen=True, slots=True)
class Parameters:
    """One row at zero: (cosine, sine) of theta and of alpha, and the lengths."""

    theta: Pair
    d: Scalar
    a: Scalar
    alpha: Pair


@dataclass(frozen=True, slots=True)
class Assignment:
    """The frames 0 to n, the rows between them, the pose of frame 0 in the base and that of the
    end-effector in frame n (4 by 4 each)."""

    frames: tuple[Placed, ...]
    rows: tuple[Parameters, ...]
    base: ScalarMatrix
    tool: ScalarMatrix


def assigned(axes: Sequence[Line], end: ScalarMatrix, convention: Convention) -> Assignment:
    """The frames of an arm with these joint axes; `end` is the pose of its end-effector, all at zero."""
    frames = _standard(axes, end) if convention == "standard" else _modified(axes, end)
    read = _standard_row if convention == "standard" else _modified_row
    rows = tuple(read(a, b) for a, b in pairwise(frames))
    return Assignment(tuple(frames), rows, frames[0].pose, inverse_pose(frames[-1].pose) @ end)


def _standard(axes: Sequence[Line], end: ScalarMatrix) -> list[Placed]:
    frames = [_first(axes[0])]
    for line, after in pairwise(axes):
        frames.append(_joined(line, after, frames[-1], on_second=True))
    return [*frames, _last_standard(frames[-1], end)]


def _modified(axes: Sequence[Line], end: ScalarMatrix) -> list[Placed]:
    """Frame 0 is that of the world where z_1 is its axis too, else frame 1 at zero."""
    found: list[Placed] = []
    world = _first(axes[0])
    before = world
    for line, after in pairwise(axes):
        found.append(_joined(line, after, before, on_second=False))
        before = found[-1]
    found.append(_last_modified(axes[-1], before, end))
    zero = world if world.kind == "world" else Placed("free", found[0].x, found[0].z, found[0].o)
    return [zero, *found]


def _first(line: Line) -> Placed:
    """The world frame where its z is the first axis; else on that axis, near the origin of the world."""
    origin = ScalarMatrix.zeros(3, 1)
    if line.direction == UNITS[2] and on(origin, line):
        return Placed("world", UNITS[0], UNITS[2], origin)
    x = next((e for e in UNITS if not dot(e, line.direction)), None)
    return Placed(
        "free", unit(UNITS[2].cross(line.direction)) if x is None else x, line.direction, foot(origin, line)
    )


def _joined(line: Line, after: Line, before: Placed, on_second: bool) -> Placed:
    """x along the normal of two axes; its origin on the second one (standard) or on the first."""
    z = after.direction if on_second else line.direction
    start = Line(line.direction, foot(before.o, line))
    normal = common_normal(start, after)
    o = normal.foot_b if on_second else normal.foot_a
    if normal.direction is None:
        return Placed("coincident", _across(before.x, z), z, o)
    turned = normal.relation == "intersecting" and -normal.direction == before.x
    return Placed(normal.relation, -normal.direction if turned else normal.direction, z, o, turned)


def _across(x: ScalarMatrix, z: ScalarMatrix) -> ScalarMatrix:
    """The axis x before where it fits, else the first unit vector that does."""
    if not dot(x, z):
        return x
    return next((e for e in UNITS if not dot(e, z)), unit(UNITS[2].cross(z)))


def _last_standard(before: Placed, end: ScalarMatrix) -> Placed:
    """The end-effector's frame where its x meets z_{n-1} at a right angle; else along z_{n-1}."""
    R, o = rotation_part(end), position_part(end)
    x, z = R.columns(0), R.columns(2)
    meets = not dot(x, before.z) and not dot(o - before.o, x.cross(before.z))
    if meets:
        return Placed("end-effector", x, z, o)
    return Placed("last", before.x, before.z, foot(o, Line(before.z, before.o)))


def _last_modified(line: Line, before: Placed, end: ScalarMatrix) -> Placed:
    """The end-effector's frame where z_n is its axis; else x_n as x_{n-1} and d_n = 0."""
    R, o = rotation_part(end), position_part(end)
    if R.columns(2) == line.direction and on(o, line):
        return Placed("end-effector", R.columns(0), R.columns(2), o)
    normal = common_normal(Line(before.z, before.o), line)
    start = normal.foot_b if normal.direction is not None else before.o
    return Placed("last", _across(before.x, line.direction), line.direction, start)


def _standard_row(a: Placed, b: Placed) -> Parameters:
    way = b.o - a.o
    return Parameters(_angle(a.x, b.x, a.z), dot(way, a.z), dot(way, b.x), _angle(a.z, b.z, b.x))


def _modified_row(a: Placed, b: Placed) -> Parameters:
    way = b.o - a.o
    return Parameters(_angle(a.x, b.x, b.z), dot(way, b.z), dot(way, a.x), _angle(a.z, b.z, a.x))


def _angle(u: ScalarMatrix, v: ScalarMatrix, about: ScalarMatrix) -> Pair:
    """(cosine, sine) of the angle from u to v about an axis at right angles to both."""
    return dot(u, v), dot(u.cross(v), about)
