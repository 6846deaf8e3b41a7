"""Joints as a draughtsman shows them: cylinders, boxes, discs, the ground, and triads of axes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, cos, pi, radians, sin

from derive.derivation import Place, Stroke
from derive.figures.view import Vector, View, across, along, around, dot, hull

CORNERS = 36  # of a circle


@dataclass(frozen=True, slots=True)
class Solid:
    """Strokes that belong together, and how near they are to the reader."""

    depth: float
    strokes: tuple[Stroke, ...]


def cylinder(
    view: View, at: Vector, axis: Vector, size: float, low: float = -0.7, high: float = 0.7
) -> Solid:
    """A revolute joint: a cylinder along its axis from `low` to `high` (in sizes); a disc where it is seen
    along that."""
    a, b = across(axis)
    ends = [along(at, (side * size, axis)) for side in (low, high)]
    rims = [circle(view, end, a, b, 0.5 * size) for end in ends]
    front = 1 if dot(view.front, axis) >= 0 else 0
    if view.flat and abs(dot(view.front, axis)) > 0.99:
        rim = circle(view, at, a, b, 0.42 * size)
        pin = circle(view, at, a, b, 0.09 * size)
        return Solid(view.depth(at) + size, (Stroke(rim, "cap"), Stroke(pin, "pin")))
    body = hull((*rims[0], *rims[1]))
    middle = along(at, ((low + high) / 2 * size, axis))
    return Solid(view.depth(middle), (Stroke(body, "body"), Stroke(rims[front], "cap")))


def turn(view: View, at: Vector, axis: Vector, size: float, until: float = 75.0) -> tuple[Place, ...]:
    """Part of a circle round a revolute joint, where it can be seen, the way in which it turns, and so many
    degrees beyond where it is nearest."""
    a, b = across(axis)
    nearest = atan2(dot(view.front, b), dot(view.front, a))
    first = max(until - 150.0, -90.0)
    turns = (nearest + radians(first + (until - first) * k / 28) for k in range(29))
    return tuple(view.place(along(at, (0.78 * size * cos(t), a), (0.78 * size * sin(t), b))) for t in turns)


def box(view: View, at: Vector, axis: Vector, size: float) -> Solid:
    """A prismatic joint: a box along its axis."""
    a, b = (view.front, _crossed(view, axis)) if view.flat else across(axis)
    strokes = []
    for normal, others, reach in ((axis, (a, b), 0.75), (a, (axis, b), 0.42), (b, (axis, a), 0.42)):
        sizes = [0.75 if other is axis else 0.42 for other in others]
        side = 1 if dot(view.front, normal) >= 0 else -1
        centre = along(at, (side * reach * size, normal))
        corners = [
            along(centre, (i * sizes[0] * size, others[0]), (j * sizes[1] * size, others[1]))
            for i, j in ((-1, -1), (-1, 1), (1, 1), (1, -1))
        ]
        face = "cap" if normal is axis else "body"
        strokes.append((abs(dot(view.front, normal)), Stroke(tuple(map(view.place, corners)), face)))
    seen = [stroke for weight, stroke in strokes if weight > 1e-6]
    return Solid(view.depth(at) + (size if view.flat else 0), tuple(seen))


def _crossed(view: View, axis: Vector) -> Vector:
    """In the plane of the paper, perpendicular to an axis in it."""
    x, y = dot(view.right, axis), dot(view.up, axis)
    return along((0.0, 0.0, 0.0), (-y, view.right), (x, view.up))


def circle(view: View, at: Vector, a: Vector, b: Vector, radius: float) -> tuple[Place, ...]:
    """A circle in space in the plane of two unit vectors, as it is seen."""
    turns = (2 * pi * k / CORNERS for k in range(CORNERS))
    return tuple(view.place(along(at, (radius * cos(t), a), (radius * sin(t), b))) for t in turns)


def ground(view: View, at: Vector, size: float) -> Solid:
    """Where the base is fixed: a hatched line below it, or a disc under it."""
    x, y = view.place(at)
    if not view.flat:
        rim = circle(view, at, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), 1.15 * size)
        return Solid(view.depth(at) - 10 * size, (Stroke(rim, "ground"),))
    low, half = y - 0.75 * size, 0.9 * size
    feet = [((x, y), (x - 0.45 * size, low)), ((x, y), (x + 0.45 * size, low))]
    lines = [*feet, ((x - half, low), (x + half, low))]
    for k in range(7):
        start = x - half + (k + 0.5) * 2 * half / 7
        lines.append(((start, low), (start - 0.28 * size, low - 0.28 * size)))
    return Solid(view.depth(at) - 10 * size, tuple(Stroke(line, "thin") for line in lines))


def pointing(view: View, at: Vector, way: Vector, radius: float) -> Iterator[Stroke]:
    """The sign of an axis that points at the reader, a dot in a circle, or away, a cross in one."""
    center = view.place(at)
    rim = tuple(around(center, radius, 2 * pi * k / 24) for k in range(24))
    yield Stroke(rim, "box")
    if dot(view.front, way) > 0:
        yield Stroke(tuple(around(center, 0.3 * radius, 2 * pi * k / 12) for k in range(12)), "pin")
        return
    for turn in (pi / 4, 3 * pi / 4):
        yield Stroke((around(center, radius, turn), around(center, radius, turn + pi)), "thin")
