"""Pictures of workspaces: an annulus from above, a swung arm in section."""

from __future__ import annotations

import math
from collections.abc import Sequence

from derive.derivation import Curve, Label, Phrase, Plot
from derive.figures.view import around

CORNERS = 145
HEIGHT, WORKSPACE, LINKS = Phrase("height"), Phrase("workspace"), Phrase("its-links")
ELBOWS = (0.5, 1.1, 0.8)  # of the arm drawn into the picture


def from_above(lengths: Sequence[float]) -> Plot:
    """The annulus of an arm in a plane, and where its end takes every orientation."""
    far, longest = sum(lengths), max(lengths)
    near = max(0.0, 2 * longest - far)
    series: dict[Label, Curve] = {Phrase("arm"): _arm(lengths), Phrase("boundary"): _circle(far)}
    if near > 0:
        series[Phrase("inner-boundary")] = _circle(near)
    if len(lengths) == 3 and (radius := lengths[0] + lengths[1] - lengths[2]) > 0:
        series[Phrase("every-orientation")] = _circle(radius)
    ring = _ring((0.0, 0.0), near, far, (0.0, 2 * math.pi))
    return Plot("workspace", "x", "y", series, regions={WORKSPACE: ring}, equal=True)


def cross_section(lengths: Sequence[float], offset: float, side: float) -> Plot:
    """The section through the first axis: half of a hollow ball, by the distance from that axis; where the
    shoulder stands off the axis, the annulus of the links and where half a turn takes it."""
    if offset:
        return _two_rings(lengths, offset)
    xs, ys = _ring((0.0, 0.0), abs(lengths[0] - lengths[1]), sum(lengths), (-math.pi / 2, math.pi / 2))
    region = (tuple(math.hypot(x, side) for x in xs), ys)
    arm_x, arm_y = _arm(lengths)
    arm = (tuple(math.hypot(x, side) for x in arm_x), arm_y)
    return Plot(
        "workspace", Phrase("distance"), HEIGHT, {LINKS: arm}, regions={WORKSPACE: region}, equal=True,
    )  # fmt: skip


def _two_rings(lengths: Sequence[float], offset: float) -> Plot:
    near, far, whole = abs(lengths[0] - lengths[1]), sum(lengths), (0.0, 2 * math.pi)
    arm_x, arm_y = _arm(lengths)
    regions: dict[Label, Curve] = {
        WORKSPACE: _ring((offset, 0.0), near, far, whole),
        Phrase("half-a-turn"): _ring((-offset, 0.0), near, far, whole),
    }
    arm = (tuple(offset + x for x in arm_x), arm_y)
    return Plot("workspace", Phrase("in-the-plane"), HEIGHT, {LINKS: arm}, regions=regions, equal=True)


def _ring(center: tuple[float, float], near: float, far: float, turns: tuple[float, float]) -> Curve:
    """Outside one way, inside back."""
    out = [around(center, far, angle) for angle in _angles(turns)]
    back = [around(center, near, angle) for angle in reversed(_angles(turns))]
    xs, ys = zip(*(out + back), strict=True)
    return xs, ys


def _circle(radius: float) -> Curve:
    xs, ys = zip(*(around((0.0, 0.0), radius, angle) for angle in _angles((0.0, 2 * math.pi))), strict=True)
    return xs, ys


def _angles(turns: tuple[float, float]) -> list[float]:
    start, end = turns
    return [start + (end - start) * k / (CORNERS - 1) for k in range(CORNERS)]


def _arm(lengths: Sequence[float]) -> Curve:
    """The arm somewhere in its workspace."""
    x = y = angle = 0.0
    xs, ys = [0.0], [0.0]
    for k, length in enumerate(lengths):
        angle += ELBOWS[k % len(ELBOWS)]
        x, y = x + length * math.cos(angle), y + length * math.sin(angle)
        xs.append(x)
        ys.append(y)
    return tuple(xs), tuple(ys)
