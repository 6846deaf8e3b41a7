"""Pictures of workspaces: an annulus from above, a swung arm in section."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from derive.derivation import Curve, Label, Phrase, Plot
from derive.expression import Approximate, Symbol
from derive.figures.axes import axis, short
from derive.figures.view import around

CORNERS = 145
X, Y = Symbol("x"), Symbol("y")
WORKSPACE, ANY_WAY, LINKS = Phrase("workspace"), Phrase("any-orientation"), Phrase("its-links")
ELBOWS = (0.5, 1.1, 0.8)  # of the arm drawn into the picture
WHOLE = (0.0, 2 * math.pi)


def from_above(lengths: Sequence[float], secondary: tuple[float, float] | None, unit: str) -> Plot:
    """The annulus of an arm in a plane with its boundaries, and where its end takes every orientation: where
    the last link, whichever way it points, begins in the ring that the others reach (`secondary`: how far
    the end may be, and the hole of that ring)."""
    far, longest = sum(lengths), max(lengths)
    near = max(0.0, 2 * longest - far)
    series: dict[Label, Curve] = {_boundary("boundary", "r_max", far, unit): _circle(far)}
    if near > 0:
        series[_boundary("inner-boundary", "r_min", near, unit)] = _circle(near)
    regions: dict[Label, Curve] = {WORKSPACE: _ring((0.0, 0.0), near, far, WHOLE)}
    rings = [*_any_way(lengths[-1], *secondary)] if secondary else []
    for k, (low, high) in enumerate(rings):
        regions["" if k else ANY_WAY] = _ring((0.0, 0.0), low, high, WHOLE)
    about = {"near": short(near), "far": short(far)}
    return Plot(
        "workspace", axis(X, unit), axis(Y, unit), series, regions=regions,
        arms={Phrase("arm"): _arm(lengths)}, equal=True,
        caption=Phrase("drawn-workspace"), alt=Phrase("seen-annulus" if near else "seen-disc", about),
    )  # fmt: skip


def _any_way(last: float, far: float, gap: float) -> Iterator[tuple[float, float]]:
    """The distances at which every orientation is possible, as rings."""
    if min(last - gap, far) > 0:
        yield 0.0, min(last - gap, far)
    if last + gap < far:
        yield last + gap if gap or last > far else 0.0, far


def _boundary(key: str, name: str, radius: float, unit: str) -> Phrase:
    return Phrase(key, {"name": Symbol(name), "value": Approximate(radius), "unit": unit})


def cross_section(lengths: Sequence[float], offset: float, side: float, unit: str) -> Plot:
    """The section through the first axis: half of a hollow ball, by the distance from that axis; where the
    shoulder stands off the axis, the annulus of the links and where half a turn takes it."""
    near, far = abs(lengths[0] - lengths[1]), sum(lengths)
    arm_x, arm_y = _arm(lengths)
    if offset:
        regions: dict[Label, Curve] = {
            WORKSPACE: _ring((offset, 0.0), near, far, WHOLE),
            Phrase("half-a-turn"): _ring((-offset, 0.0), near, far, WHOLE),
        }
        arm = (tuple(offset + x for x in arm_x), arm_y)
    else:
        xs, ys = _ring((0.0, 0.0), near, far, (-math.pi / 2, math.pi / 2))
        regions = {WORKSPACE: (tuple(math.hypot(x, side) for x in xs), ys)}
        arm = (tuple(math.hypot(x, side) for x in arm_x), arm_y)
    key = "in-the-plane" if offset else "distance"
    return Plot(
        "workspace", _with_unit(key, unit), _with_unit("height", unit), {}, regions=regions,
        arms={LINKS: arm}, equal=True, caption=Phrase("drawn-section"),
        alt=Phrase("seen-section", {"near": short(near), "far": short(far)}),
    )  # fmt: skip


def _with_unit(key: str, unit: str) -> Phrase:
    return Phrase("with-unit", {"name": Phrase(key), "unit": unit}) if unit else Phrase(key)


def _ring(center: tuple[float, float], near: float, far: float, turns: tuple[float, float]) -> Curve:
    """Outside one way, inside back."""
    out = [around(center, far, angle) for angle in _angles(turns)]
    back = [around(center, near, angle) for angle in reversed(_angles(turns))]
    xs, ys = zip(*(out + back), strict=True)
    return xs, ys


def _circle(radius: float) -> Curve:
    xs, ys = zip(*(around((0.0, 0.0), radius, angle) for angle in _angles(WHOLE)), strict=True)
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
