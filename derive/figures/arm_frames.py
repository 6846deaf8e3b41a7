"""The frames of an arm: arrows from their origins; axes of one origin with one direction share an arrow."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from derive.derivation import Caption, Stroke
from derive.figures.arm import Posed, place_of
from derive.figures.solids import pointing
from derive.figures.view import Vector, View, along, length
from derive.mechanics.robot import Robot

LONG, LONGER = 1.7, 2.2  # sizes of a joint: an arrow, and one whose direction another letter has as well
SEEN = 0.25  # of its length: an arrow that is seen shorter points at the reader


@dataclass(frozen=True, slots=True)
class Arrow:
    """Axes of frames with one origin and one direction."""

    letter: str
    origin: Vector
    way: Vector
    names: tuple[str, ...]


def frames_of(robot: Robot, view: View, posed: Posed, size: float) -> Iterator[tuple[Stroke, Caption]]:
    """x and z of every frame (x and y in a plane, where z points at the reader)."""
    shown = list(enumerate(posed.poses)) if not robot.by_screws else [(0, posed.poses[0])]
    frames: list[tuple[str, Any]] = [(str(number), pose) for number, pose in shown]
    if robot.ends_in_tool:
        frames.append(("_e", posed.end))
    yield from arrows_drawn(view, shared(frames, "xyz" if view.flat else "xz", size), size)


def shared(frames: Sequence[tuple[str, Any]], axes: str, size: float) -> list[Arrow]:
    """The arrows of frames by their indices; places and directions are compared to a thousandth."""
    found: dict[tuple[object, ...], Arrow] = {}
    for index, pose in frames:
        origin = place_of(pose)
        for k, letter in enumerate("xyz"):
            if letter not in axes:
                continue
            way = float(pose[0][k]), float(pose[1][k]), float(pose[2][k])
            key = (letter, *(round(c / size, 2) + 0.0 for c in origin), *(round(c, 3) + 0.0 for c in way))
            before = found.get(key)
            names = (*before.names, f"{letter}{index}") if before else (f"{letter}{index}",)
            found[key] = Arrow(letter, origin, way, names)
    return list(found.values())


def arrows_drawn(view: View, arrows: Sequence[Arrow], size: float) -> Iterator[tuple[Stroke, Caption]]:
    """Each arrow that does not point at the reader, with the names of its axes at its end."""
    for k, arrow in enumerate(arrows):
        also = any(_same(arrow, other, size) for other in arrows[:k])
        long = (LONGER if also else LONG) * size
        start, end = view.place(arrow.origin), view.place(along(arrow.origin, (long, arrow.way)))
        towards = end[0] - start[0], end[1] - start[1]
        if max(map(abs, towards)) < SEEN * size:
            continue
        text = arrow.names if len(arrow.names) > 1 else arrow.names[0]
        middle = (start[0] + 0.75 * towards[0], start[1] + 0.75 * towards[1])
        sides = ((middle, (-towards[1], towards[0])), (middle, (towards[1], -towards[0])))
        yield Stroke((start, end), arrow.letter), Caption(end, text, towards, arrow.letter, sides)


def _same(one: Arrow, other: Arrow, size: float) -> bool:
    """Whether an arrow of another letter lies upon it."""
    apart = max(abs(a - b) for a, b in zip(one.origin, other.origin, strict=True))
    turned = max(abs(a - b) for a, b in zip(one.way, other.way, strict=True))
    return apart < 0.01 * size and turned < 1e-3


def pointing_at_reader(
    view: View, arrows: Sequence[Arrow], size: float
) -> Iterator[tuple[list[Stroke], Caption]]:
    """The sign of each axis that is seen end on, with its names."""
    for arrow in arrows:
        start, end = view.place(arrow.origin), view.place(along(arrow.origin, (size, arrow.way)))
        if length((end[0] - start[0], end[1] - start[1])) < SEEN * size:
            text = arrow.names if len(arrow.names) > 1 else arrow.names[0]
            name = Caption(start, text, (-1.0, -1.0), arrow.letter, clear=0.1 * size)
            yield [*pointing(view, arrow.origin, arrow.way, 0.1 * size)], name
