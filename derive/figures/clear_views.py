"""The view in which frames are seen best: no axis end on, none upon another, turns as open circles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import hypot, radians
from typing import Any

from derive.figures.arm import place_of
from derive.figures.arm_bodies import column
from derive.figures.view import Vector, View, dot, in_space, length

USUAL = 38, 22  # degrees: the view of all other figures, kept where it will do
AZIMUTHS, ELEVATIONS = range(18, 73, 6), range(12, 43, 5)
LONG, OPEN, WIDE, GAP = 0.42, 0.26, 0.3, 0.25  # as much of an axis, a circle, an angle, a gap is enough
COST = 0.004  # of a degree away from the usual view


def clearest(poses: Sequence[Any], turned_about: Sequence[Vector] = ()) -> View:
    """For frames (4 by 4) and unit vectors about which something turns."""
    azimuth, elevation = max(_ways(), key=lambda way: _worth(way, poses, turned_about))
    return in_space(radians(azimuth), radians(elevation))


def _ways() -> Iterator[tuple[int, int]]:
    yield USUAL
    yield from ((a, e) for a in AZIMUTHS for e in ELEVATIONS)


def _worth(way: tuple[int, int], poses: Sequence[Any], turned_about: Sequence[Vector]) -> float:
    """The sum of how well axes, angles between them, turns and gaps between origins are seen at worst."""
    view = in_space(*map(radians, way))
    axes = [[view.place(column(T, k)) for k in range(3)] for T in poses]
    turned = (view.place(axis) for axis in turned_about)
    seen = min(length(axis) for axis in (*turned, *(axis for frame in axes for axis in frame)))
    spread = min(
        abs(a[0] * b[1] - a[1] * b[0]) / (length(a) * length(b) or 1.0)
        for frame in axes for a, b in combinations(frame, 2)
    )  # fmt: skip
    round_ = min((abs(dot(view.front, axis)) for axis in turned_about), default=1.0)
    spots = {tuple(round(c, 6) for c in place_of(T)) for T in poses}
    places = [view.place(spot) for spot in spots]
    gaps = [hypot(a[0] - b[0], a[1] - b[1]) for a, b in combinations(places, 2)]
    gap = min(gaps) / max(gaps) if gaps and max(gaps) > 0 else 1.0
    parts = (seen / LONG, spread / WIDE, round_ / OPEN, gap / GAP)
    away = hypot(way[0] - USUAL[0], way[1] - USUAL[1])
    return sum(min(1.0, part) for part in parts) + min(1.0, *parts) - COST * away
