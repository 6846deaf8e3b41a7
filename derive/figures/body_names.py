"""What is written at the bodies of links: their lengths, and masses where no sign stands."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import Any, TypeAlias

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Place, Stroke
from derive.expression import ZERO, Expr, add
from derive.figures import solids
from derive.figures.arm import Posed, direction, length_between
from derive.figures.arm_bodies import DOT, bodies_of, column, com_place, sizes_of
from derive.figures.view import Vector, View, across, along, around, dot, length
from derive.mechanics.bodies import Box, Cylinder, PointMass, Rod, Sphere, coordinates
from derive.mechanics.robot import Robot

TOWARDS = 0.9  # rad: where on its rim the radius of a ball is drawn
ASIDE = 1.1  # sizes of a joint: how far beside a rod its length is drawn
NEAR = 1e-9  # of places that are one
SEEN = 0.3  # of a direction: a side that is seen shorter has no name
Marked: TypeAlias = tuple[list[Stroke], list[Caption]]


def body_names(robot: Robot, view: View, posed: Posed, size: float) -> Iterator[Marked]:
    """The lengths of bodies that are no length of the arm, and masses where no center of mass is marked."""
    told = {part.by for part in posed.parts}
    sides_of = _of_boxes(robot, view, posed, size, told)
    for k, body in bodies_of(robot):
        at, T, point = com_place(body, posed, k), posed.poses[k], posed.values
        place = view.place(at)
        match body.inertia:
            case Sphere(radius):
                far = number(radius, point)
                end = around(place, far, TOWARDS)
                mass = Caption(place, body.mass, (0.3, -1.0), "joint", clear=far)
                yield [Stroke((place, end), "thin")], [Caption(end, radius, _way(place, end), "length"), mass]
            case PointMass():
                yield [], [Caption(place, _mass_at(robot, at, posed), (0.3, -1.0), "joint", clear=DOT * size)]
            case Rod(long, axis):
                way = direction(T, axis, point)
                if long not in told:
                    yield _measured(view, at, way, number(long, point), long, size)
                if not any(part != ZERO for part in coordinates(body)):
                    tail = view.place(along(at, (-0.36 * number(long, point), way)))
                    yield [], [Caption(tail, body.mass, (1.0, -1.0), "joint", clear=0.3 * size)]
            case Cylinder(radius, long, axis):
                way = direction(T, axis, point)
                side = 1 if dot(view.front, way) >= 0 else -1
                top = along(at, (side * number(long, point) / 2, way))
                end = max(solids.circle(view, top, *across(way), number(radius, point)))
                spoke = Stroke((view.place(top), end), "thin")
                yield [spoke], [Caption(end, radius, (1.0, 0.2), "length")]
            case Box():
                yield [], sides_of[k]


def _mass_at(robot: Robot, at: Vector, posed: Posed) -> Expr:
    """That of all bodies whose center is at a place: one label stands there."""
    bodies = (
        (link.body, com_place(link.body, posed, k)) for k, link in enumerate(robot.links, 1) if link.body
    )
    return add(
        *(body.mass for body, place in bodies if body.mass != ZERO and length_between(at, place) < NEAR)
    )


def _of_boxes(
    robot: Robot, view: View, posed: Posed, size: float, told: set[Expr]
) -> dict[int, list[Caption]]:
    """The sides of each box, by its link. What stands at a joint, whose size it would seem to be, is left out
    where a box with this side has a free end."""
    joints = [view.place(joint.at) for joint in posed.joints]

    def at_free_ends(caption: Caption) -> Caption | None:
        spots = [(caption.at, caption.towards), *caption.others]
        free = [spot for spot in spots if all(length(_way(joint, spot[0])) > size for joint in joints)]
        return replace(caption, at=free[0][0], towards=free[0][1], others=tuple(free[1:])) if free else None

    pairs: dict[int, list[tuple[Caption, Caption | None]]] = {}
    for k, body in bodies_of(robot):
        if isinstance(body.inertia, Box):
            at, sides = com_place(body, posed, k), body.inertia.sides
            names = _sides(view, at, posed.poses[k], sides, sizes_of(posed, *sides), told)
            pairs[k] = [(name, at_free_ends(name)) for name in names]
    told_free = {name.text for names in pairs.values() for name, free in names if free}
    return {
        k: [free or name for name, free in names if free or name.text not in told_free]
        for k, names in pairs.items()
    }


def _sides(
    view: View, at: Vector, T: Any, sides: Sequence[Expr], sizes: Sequence[float], told: set[Expr]
) -> Iterator[Caption]:
    """The sides of a box that are no length of the arm, each once, at an edge far from its middle."""
    axes = [column(T, k) for k in range(3)]
    named, middle = set(told), view.place(at)
    for k, side in enumerate(sides):
        if side in named or length(view.place(axes[k])) < SEEN:
            continue
        named.add(side)
        i, j = (n for n in range(3) if n != k)
        edges = [
            view.place(along(at, (p * sizes[i] / 2, axes[i]), (q * sizes[j] / 2, axes[j])))
            for p, q in product((1, -1), repeat=2)
        ]
        spots = sorted(((edge, _way(middle, edge)) for edge in edges), key=lambda each: -length(each[1]))
        yield Caption(spots[0][0], side, spots[0][1], "length", tuple(spots[1:]))


def _measured(view: View, at: Vector, way: Vector, long: float, name: Expr, size: float) -> Marked:
    """A length beside a rod."""
    a, b = (view.place(along(at, (side * long / 2, way))) for side in (-1, 1))
    far = length(_way(a, b))
    side = (b[1] - a[1]) / far, (a[0] - b[0]) / far
    first, last = ((p[0] + ASIDE * size * side[0], p[1] + ASIDE * size * side[1]) for p in (a, b))
    middle = (first[0] + last[0]) / 2, (first[1] + last[1]) / 2
    strokes = [Stroke((middle, first), "measure"), Stroke((middle, last), "measure")]
    strokes += [Stroke(ends, "leader") for ends in ((a, first), (b, last))]
    return strokes, [Caption(middle, name, side, "length")]


def _way(a: Place, b: Place) -> Place:
    return b[0] - a[0], b[1] - a[1]
