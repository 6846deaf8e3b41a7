"""Two lines in space: whether they are skew, parallel or meet, and their common normal."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.unit_vectors import unit

Relation: TypeAlias = Literal["skew", "intersecting", "parallel", "coincident"]


@dataclass(frozen=True, slots=True)
class Line:
    """A unit direction and a point (3 by 1 each)."""

    direction: ScalarMatrix
    point: ScalarMatrix


@dataclass(frozen=True, slots=True)
class Normal:
    """What joins line a to line b: how they lie, the unit direction of the common normal (of intersecting
    lines a x b, of coincident ones none), and its feet on both; of parallel lines the normal through the
    point of a."""

    relation: Relation
    direction: ScalarMatrix | None
    foot_a: ScalarMatrix
    foot_b: ScalarMatrix


def dot(u: ScalarMatrix, v: ScalarMatrix) -> Scalar:
    """The scalar product of two columns."""
    return (u.T @ v)[0, 0]


def common_normal(a: Line, b: Line) -> Normal:
    """From line a to line b."""
    across = a.direction.cross(b.direction)
    way = b.point - a.point
    if not across:
        return _between_parallels(a, way - a.direction.scaled(dot(way, a.direction)))
    square = dot(across, across)
    foot_a = a.point + a.direction.scaled(dot(way.cross(b.direction), across) / square)
    if not dot(way, across):
        return Normal("intersecting", unit(across), foot_a, foot_a)
    foot_b = b.point + b.direction.scaled(dot(way.cross(a.direction), across) / square)
    return Normal("skew", unit(foot_b - foot_a), foot_a, foot_b)


def _between_parallels(a: Line, apart: ScalarMatrix) -> Normal:
    if not apart:
        return Normal("coincident", None, a.point, a.point)
    return Normal("parallel", unit(apart), a.point, a.point + apart)


def on(point: ScalarMatrix, line: Line) -> bool:
    """Whether a point lies on a line."""
    return not (point - line.point).cross(line.direction)


def foot(point: ScalarMatrix, line: Line) -> ScalarMatrix:
    """The point (3 by 1) of a line nearest to a point."""
    return line.point + line.direction.scaled(dot(point - line.point, line.direction))
