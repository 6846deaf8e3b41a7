"""How space is seen on paper: a fixed parallel projection, or a plane looked at from in front."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import cos, hypot, radians, sin
from typing import TypeAlias

from derive.derivation import Place

Vector: TypeAlias = tuple[float, float, float]
AZIMUTH, ELEVATION = radians(38), radians(22)  # x comes towards the reader, y goes to the right, z up


@dataclass(frozen=True, slots=True)
class View:
    """Unit vectors to the right and up on paper, and towards the reader; `flat` for a plane."""

    right: Vector
    up: Vector
    front: Vector
    flat: bool = False

    def place(self, point: Sequence[float]) -> Place:
        """Where a point of space is seen on paper."""
        return dot(self.right, point), dot(self.up, point)

    def depth(self, point: Sequence[float]) -> float:
        """How near to the reader."""
        return dot(self.front, point)


def in_space(a: float = AZIMUTH, e: float = ELEVATION) -> View:
    """The view of everything that is not plane, from a direction round z and above the plane of x and y."""
    return View(
        (-sin(a), cos(a), 0.0),
        (-cos(a) * sin(e), -sin(a) * sin(e), cos(e)),
        (cos(a) * cos(e), sin(a) * cos(e), sin(e)),
    )


def onto_plane(normal: Vector) -> View | None:
    """The plane of two world axes, seen so that the first goes right and the other up; None for others."""
    planes: dict[int, tuple[Vector, Vector, Vector]] = {
        0: ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
        1: ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
        2: ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    }
    for axis, (right, up, front) in planes.items():
        if abs(abs(normal[axis]) - 1) < 1e-9:
            return View(right, up, front, flat=True)
    return None


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    """The scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a: Sequence[float], b: Sequence[float]) -> Vector:
    """The vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def along(point: Sequence[float], *steps: tuple[float, Sequence[float]]) -> Vector:
    """The point moved by multiples of vectors."""
    x, y, z = (p + sum(size * way[i] for size, way in steps) for i, p in enumerate(point))
    return x, y, z


def between(start: Sequence[float], end: Sequence[float]) -> Vector:
    """The vector from one place to another."""
    return end[0] - start[0], end[1] - start[1], end[2] - start[2]


def unit(vector: Sequence[float]) -> Vector:
    """The vector of length 1 in the same direction. Raises ZeroDivisionError for zero."""
    size = dot(vector, vector) ** 0.5
    return vector[0] / size, vector[1] / size, vector[2] / size


def across(axis: Vector) -> tuple[Vector, Vector]:
    """Two unit vectors perpendicular to an axis and to each other."""
    other = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.8 else (0.0, 1.0, 0.0)
    first = unit(cross(axis, other))
    return first, cross(axis, first)


def around(center: Place, radius: float, angle: float) -> Place:
    """The place on a circle at an angle from the right, counterclockwise."""
    return center[0] + radius * cos(angle), center[1] + radius * sin(angle)


def hull(places: Iterable[Place]) -> tuple[Place, ...]:
    """The convex hull, counterclockwise (Andrew's chain)."""
    ordered = sorted(set(places))

    def half(points: Iterable[Place]) -> list[Place]:
        kept: list[Place] = []
        for p in points:
            while len(kept) > 1 and _turn(kept[-2], kept[-1], p) <= 0:
                kept.pop()
            kept.append(p)
        return kept[:-1]

    return (*half(ordered), *half(reversed(ordered)))


def _turn(a: Place, b: Place, c: Place) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def length(place: Place) -> float:
    """How far a place is from the origin of the paper."""
    return hypot(*place)


def from_line(place: Place, a: Place, b: Place) -> float:
    """How far a place is from a straight line that ends at two others."""
    way, out = (b[0] - a[0], b[1] - a[1]), (place[0] - a[0], place[1] - a[1])
    far = dot(way, way)
    share = min(max(dot(out, way) / far, 0.0), 1.0) if far else 0.0
    return length((out[0] - share * way[0], out[1] - share * way[1]))
