"""The bodies of links by their shape: rods, balls, cylinders, boxes and points, where a sheet gives one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

from derive.algebra.numbers.floats import number
from derive.derivation import Stroke
from derive.expression import ZERO, Expr, Symbol
from derive.figures import solids
from derive.figures.arm import SMALL, Joint, Part, Posed, direction, length_between, place_of
from derive.figures.view import Vector, View, across, along, dot, hull
from derive.mechanics.bodies import Body, Box, Cylinder, Moments, PointMass, Rod, Sphere
from derive.mechanics.oracle.bodies import com_of
from derive.mechanics.robot import Robot

BEHIND = 20.0  # sizes of a joint: links in space are drawn upon their bodies
DOT = 0.3  # sizes of a joint: a body that counts as a point


def hanging(robot: Robot, posed: Posed) -> tuple[Part, ...]:
    """The rod of a last link that no length of the arm shows: from its joint to its center of mass."""
    if robot.by_screws or not robot.links:
        return ()
    body, T = robot.links[-1].body, posed.poses[-1]
    start = place_of(T)
    if sum(length_between(joint.at, start) < SMALL for joint in posed.joints) > 1:
        return ()  # a wrist
    if body is None or body.com == "center" or length_between(start, place_of(posed.poses[-2])) > SMALL:
        return ()
    there = [part for part in body.com if part != ZERO]
    if not there:
        return ()
    return (
        Part(start, com_place(body, posed, len(robot.links)), there[0] if len(there) == 1 else Symbol("")),
    )


def shown_by_body(robot: Robot) -> bool:
    """Whether the end of an arm is a body of a shape that is drawn."""
    body = robot.links[-1].body if robot.links and not robot.by_screws and not robot.ends_in_tool else None
    return body is not None and not isinstance(body.inertia, Moments)


def longest(robot: Robot, posed: Posed) -> float:
    """The length of the longest rod."""
    rods = (body.inertia.length for _, body in bodies_of(robot) if isinstance(body.inertia, Rod))
    return max((number(long, posed.values) for long in rods), default=0.0)


def solid_bodies(robot: Robot, view: View, posed: Posed, size: float) -> Iterator[solids.Solid]:
    """Each body of a shape: upon the links in a plane, in space behind the skeleton of its arm."""
    for k, body in bodies_of(robot):
        at, T, point = com_place(body, posed, k), posed.poses[k], posed.values
        slide = _slide(robot, posed, k) if view.flat else None
        strokes: list[Stroke]
        match body.inertia:
            case Rod(long, axis):
                half = number(long, point) / 2
                ends = (along(at, (side * half, direction(T, axis, point))) for side in (-1, 1))
                strokes = [Stroke(tuple(map(view.place, ends)), "link")]
            case Sphere(radius):
                rim = solids.circle(view, at, view.right, view.up, number(radius, point))
                strokes = [Stroke(rim, "face")]
            case Cylinder(radius, long, axis):
                strokes = _cylinder(view, at, direction(T, axis, point), *sizes_of(posed, radius, long))
            case Box(sides):
                strokes = _box(view, at, T, sizes_of(posed, *sides))
            case PointMass() if slide:
                strokes = list(solids.box(view, at, slide.axis, size).strokes)
            case PointMass():
                strokes = [Stroke(solids.circle(view, at, view.right, view.up, DOT * size), "pin")]
            case _:
                continue
        before = (
            0.5 if slide or isinstance(body.inertia, Box | Cylinder | Rod) else 2.0
        ) * size  # joints are drawn upon them
        yield solids.Solid(view.depth(at) + (before if view.flat else -BEHIND * size), tuple(strokes))


def _slide(robot: Robot, posed: Posed, k: int) -> Joint | None:
    """The prismatic joint of link k, along which its body slides."""
    variable = robot.links[k - 1].variable
    return next((joint for joint in posed.joints if joint.slides and joint.name == variable), None)


def bodies_of(robot: Robot) -> Iterator[tuple[int, Body]]:
    """Those of a shape, with the numbers of their links."""
    if robot.by_screws:
        return
    for k, link in enumerate(robot.links, 1):
        if link.body and not isinstance(link.body.inertia, Moments) and link.body.mass != ZERO:
            yield k, link.body


def com_place(body: Body, posed: Posed, k: int) -> Vector:
    """The center of mass of link k, in the base frame."""
    x, y, z = com_of(body, posed.poses[k - 1], posed.poses[k], posed.values)
    return float(x), float(y), float(z)


def sizes_of(posed: Posed, *sizes: Expr) -> tuple[float, ...]:
    """Lengths as they are drawn."""
    return tuple(number(size, posed.values) for size in sizes)


def _cylinder(view: View, at: Vector, axis: Vector, radius: float, long: float) -> list[Stroke]:
    a, b = across(axis)
    rims = [solids.circle(view, along(at, (side * long / 2, axis)), a, b, radius) for side in (-1, 1)]
    front = 1 if dot(view.front, axis) >= 0 else 0
    cap = [] if abs(dot(view.front, axis)) < SMALL else [Stroke(rims[front], "face")]
    return [Stroke(hull((*rims[0], *rims[1])), "face"), *cap]


def _box(view: View, at: Vector, T: Any, sides: Sequence[float]) -> list[Stroke]:
    """Its faces that are seen."""
    axes = [column(T, k) for k in range(3)]
    strokes = []
    for k, side in product(range(3), (-1, 1)):
        if side * dot(view.front, axes[k]) > SMALL:
            i, j = (n for n in range(3) if n != k)
            centre = along(at, (side * sides[k] / 2, axes[k]))
            corners = [
                along(centre, (p * sides[i] / 2, axes[i]), (q * sides[j] / 2, axes[j]))
                for p, q in ((-1, -1), (-1, 1), (1, 1), (1, -1))
            ]
            strokes.append(Stroke(tuple(map(view.place, corners)), "face"))
    return strokes


def column(T: Any, k: int) -> Vector:
    """An axis of a pose (4 by 4)."""
    return float(T[0, k]), float(T[1, k]), float(T[2, k])
