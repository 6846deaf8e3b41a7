"""Joint variables drawn: the angle of a joint in a plane as an arc, an arrow round an axis in space."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from math import atan2, inf, pi, remainder

from derive.derivation import Caption, Place, Stroke
from derive.figures import solids
from derive.figures.arm import Joint, Posed, length_between, place_of
from derive.figures.view import View, along, around, between, dot, from_line
from derive.mechanics.robot import Robot

NEARLY = 0.02  # rad: directions that are drawn as one
WIDE, NARROW = 1.7, 1.2  # sizes of a joint: an arc, and one that ends at an arrow
RAY = 2.3  # and the lines that an arc begins and ends at
SHORT, BEYOND = 2.6, 0.45  # a shorter offset along its axis is part of the cylinder of a joint, which goes on
ENDS, BESIDE = (75.0, 55.0, 95.0, 35.0), (0.0, 0.3, -0.3)  # degrees where an arc ends; sizes along a joint
HEAD, FREE = 5, 0.22  # places of an arc under its head; sizes of a joint that stay free about it
SHARES = 24  # pieces of an arc

Marked = tuple[list[Stroke], list[Caption]]


def turns(view: View, joints: Sequence[Joint], size: float, arrows: Sequence[Stroke]) -> Iterator[Marked]:
    """An arrow round each revolute joint in space, the way in which it turns, and its variable; its head
    stands clear of the arrows of frames where it can."""
    for joint in joints:
        if joint.slides:
            continue
        low, high = reach(joint, size)
        middles = (along(joint.at, (((low + high) / 2 + b) * size, joint.axis)) for b in BESIDE)
        tried = [solids.turn(view, middle, joint.axis, size, end) for middle, end in product(middles, ENDS)]
        clear = (arc for arc in tried if _clear(arc[-HEAD:], arrows) > FREE * size)
        arc = next(clear, tried[0])
        places = [arc[len(arc) // 2], arc[-1], arc[0]]
        center = view.place(joint.at)
        sides = [(place, (place[0] - center[0], place[1] - center[1])) for place in places]
        (at, towards), *others = sides
        yield [Stroke(arc, "turn")], [Caption(at, joint.name, towards, "joint", tuple(others))]


def _clear(places: Sequence[Place], arrows: Sequence[Stroke]) -> float:
    """How far places are from straight lines."""
    return min((from_line(p, *arrow.places) for p in places for arrow in arrows), default=inf)


def reach(joint: Joint, size: float) -> tuple[float, float]:
    """From where to where along its axis a cylinder goes, in sizes: a short offset is part of it."""
    if not within_joint(joint, size):
        return -0.7, 0.7
    ends = sorted((0.0, joint.offset / size))
    return ends[0] - BEYOND, ends[1] + BEYOND


def within_joint(joint: Joint, size: float) -> bool:
    """Whether the offset along its axis is part of the cylinder of a joint."""
    return 0 < abs(joint.offset) < SHORT * size


def angles(robot: Robot, view: View, posed: Posed, size: float) -> Iterator[Marked]:
    """The angle of each revolute joint in a plane: from where it counts, by its value, to the link that it
    turns, or where that lies otherwise to the direction that has turned."""
    for joint in posed.joints:
        if joint.slides:
            continue
        center = view.place(joint.at)
        value = posed.values.get(joint.name, 0.0) * (1 if dot(view.front, joint.axis) > 0 else -1)
        sweep = remainder(value, 2 * pi)
        if abs(sweep) < NEARLY:
            yield [], [Caption(center, joint.name, (-1.0, 1.0), "joint", clear=0.5 * size)]
            continue
        start = _angle(view.place(joint.before))
        rays = [start]
        names: list[Caption] = []
        wide = WIDE
        if not _ends_at_link(view, posed, joint, start + sweep):
            letter, here = _turned(robot, view, posed, joint, start + sweep)
            wide = NARROW if here else WIDE
            if not here:
                rays.append(start + sweep)
                tip = around(center, RAY * size, start + sweep)
                names += [Caption(tip, letter, _way(center, tip), "x")] if letter else []
        arc = [around(center, wide * size, start + sweep * k / SHARES) for k in range(SHARES + 1)]
        spots = [around(center, wide * size, start + sweep * share) for share in (0.5, 0.7, 0.3)]
        (at, towards), *others = [(spot, _way(center, spot)) for spot in spots]
        dashed = [Stroke((center, around(center, RAY * size, ray)), "hidden") for ray in rays]
        name = Caption(at, joint.name, towards, "angle", tuple(others))
        yield [*dashed, Stroke(tuple(arc), "arc")], [name, *names]


def _ends_at_link(view: View, posed: Posed, joint: Joint, end: float) -> bool:
    """Whether the link after a joint lies in a direction on paper."""
    after = next((p for p in posed.parts if length_between(p.start, joint.at) < 1e-6), None)
    return after is not None and _as_one(_angle(view.place(between(joint.at, after.end))), end)


def _turned(robot: Robot, view: View, posed: Posed, joint: Joint, end: float) -> tuple[str, bool]:
    """The x-axis of the frame behind a joint, where it has a direction on paper, and whether that stands at
    the joint; no name where it has not."""
    for k, link in enumerate(robot.links, 1):
        if link.variable == joint.name and k < len(posed.poses):
            T = posed.poses[k]
            x = view.place((float(T[0, 0]), float(T[1, 0]), float(T[2, 0])))
            if _as_one(_angle(x), end):
                return f"x{k}", length_between(place_of(T), joint.at) < 1e-6
    return "", False


def _as_one(a: float, b: float) -> bool:
    return abs(remainder(a - b, 2 * pi)) < NEARLY


def _angle(way: Place) -> float:
    return atan2(way[1], way[0])


def _way(a: Place, b: Place) -> Place:
    return b[0] - a[0], b[1] - a[1]
