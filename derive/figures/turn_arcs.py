"""The angle by which a frame is turned from another at the same origin: an arc from axis to axis."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import atan2, cos, pi, sin
from typing import Any

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Stroke
from derive.figures.arm import place_of
from derive.figures.arm_bodies import column
from derive.figures.view import View, along, cross, dot, length, unit
from derive.mechanics.frames import Frames
from derive.mechanics.motion import Motion

RADIUS, FURTHER = 0.62, 0.12  # of an axis: an arc, and one more at the same origin
SHARES = 24
LEAST, MOST = 0.09, 0.97  # of half a turn: what can be seen as an arc


def turn_arcs(
    frames: Frames, poses: Sequence[Any], point: Mapping[str, float], view: View, size: float
) -> Iterator[tuple[Stroke, Caption]]:
    """Of each frame that one turn about an axis takes there, by less than half a turn: of both pairs of axes
    that are turned, that which is seen larger."""
    for k, frame in enumerate(frames.frames):
        made = frame.source.moves if isinstance(frame.source, Motion) else ()
        if len(made) != 1 or made[0].kind != "rotate" or not isinstance(made[0].axis, str):
            continue
        if abs(number(made[0].by, point)) > pi:
            continue
        parent, child = poses[frame.parent], poses[frame.number]
        about = "xyz".index(made[0].axis)
        found = []
        for other in ((about + 1) % 3, (about + 2) % 3):
            a, b = column(parent, other), column(child, other)
            normal = cross(a, b)
            if dot(normal, normal) ** 0.5 > LEAST and dot(a, b) > -MOST:
                radius = (RADIUS - FURTHER * (k % 3)) * size
                side = unit(cross(normal, a))
                turn = atan2(dot(side, b), dot(a, b))
                arc = [
                    view.place(along(place_of(child), (radius * cos(t), a), (radius * sin(t), side)))
                    for t in (turn * n / SHARES for n in range(SHARES + 1))
                ]
                wide = length((arc[-1][0] - arc[0][0], arc[-1][1] - arc[0][1]))
                found.append((wide, arc))
        if found:
            arc = max(found)[1]
            center, middle = view.place(place_of(child)), arc[SHARES // 2]
            out = middle[0] - center[0], middle[1] - center[1]
            yield Stroke(tuple(arc), "arc"), Caption(middle, made[0].by, out, "angle")
