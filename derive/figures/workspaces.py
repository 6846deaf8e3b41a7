"""Pictures of workspaces: an annulus from above, a swung arm in section."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from derive.derivation import Curve, Label, Phrase, Plot, Said
from derive.expression import Approximate, Symbol
from derive.figures.axes import axis, short
from derive.figures.view import around

CORNERS = 145
X, Y = Symbol("x"), Symbol("y")
WORKSPACE, ANY_WAY, LINKS = Phrase("workspace"), Phrase("any-orientation"), Phrase("its-links")
ELBOWS = (0.5, 1.1, 0.8)  # of the arm drawn into the picture
WHOLE, HALF = (0.0, 2 * math.pi), (-math.pi / 2, math.pi / 2)


@dataclass(frozen=True, slots=True)
class Sizes:
    """Lengths of the links, with their unit; where they are not `known` they are only examples. A shoulder
    may stand off the first axis by an `offset`, and the links to its `side`."""

    lengths: Sequence[float]
    unit: str
    known: bool = True
    offset: float = 0.0
    side: float = 0.0

    @property
    def far(self) -> float:
        """The largest distance from the shoulder."""
        return sum(self.lengths)

    @property
    def near(self) -> float:
        """The smallest one."""
        return max(0.0, 2 * max(self.lengths) - self.far)

    def boundaries(self) -> Iterator[tuple[Label, float]]:
        """The outer one, and the inner one where there is a hole, with what the legend says of them."""
        outer = "boundary" if self.known else "boundary-in-letters"
        inner = "inner-boundary" if self.known else "inner-boundary-in-letters"
        for key, name, radius in ((outer, "r_max", self.far), (inner, "r_min", self.near)):
            if radius > 0:
                about: dict[str, Said] = {
                    "name": Symbol(name),
                    "value": Approximate(math.hypot(radius, self.side)),
                    "unit": self.unit,
                }
                yield Phrase(key, about | {"unit": self.unit}), radius

    def said(self) -> dict[str, Said]:
        """The distances for who does not see them."""
        ends = {"near": self.near, "far": self.far}
        return {name: short(math.hypot(end, self.side)) for name, end in ends.items()}


def from_above(sizes: Sizes, secondary: tuple[float, float] | None) -> Plot:
    """The annulus of an arm in a plane with its boundaries, and where its end takes every orientation: where
    the last link, whichever way it points, begins in the ring that the others reach (`secondary`: how far
    the end may be, and the hole of that ring)."""
    series: dict[Label, Curve] = {name: _circle(radius) for name, radius in sizes.boundaries()}
    regions: dict[Label, Curve] = {WORKSPACE: _ring((0.0, 0.0), sizes.near, sizes.far, WHOLE)}
    rings = [*_any_way(sizes.lengths[-1], *secondary)] if secondary else []
    for k, (low, high) in enumerate(rings):
        regions["" if k else ANY_WAY] = _ring((0.0, 0.0), low, high, WHOLE)
    told = sizes.said()
    seen = Phrase("seen-annulus", told) if sizes.near else Phrase("seen-disc", {"far": told["far"]})
    return Plot(
        "workspace", axis(X, sizes.unit), axis(Y, sizes.unit), series, regions=regions,
        arms={Phrase("arm"): _arm(sizes.lengths)}, equal=True, unscaled=not sizes.known,
        caption=Phrase("drawn-workspace" if sizes.known else "drawn-workspace-in-letters"),
        alt=seen if sizes.known else Phrase("seen-in-letters"),
    )  # fmt: skip


def _any_way(last: float, far: float, gap: float) -> Iterator[tuple[float, float]]:
    """The distances at which every orientation is possible, as rings."""
    if min(last - gap, far) > 0:
        yield 0.0, min(last - gap, far)
    if last + gap < far:
        yield last + gap if gap or last > far else 0.0, far


def cross_section(sizes: Sizes) -> Plot:
    """The section through the first axis: half of a hollow ball, by the distance from that axis; where the
    shoulder stands off the axis, the annulus of the links and where half a turn takes it."""
    x, y = _arm(sizes.lengths)
    if sizes.offset:
        ring = sizes.near, sizes.far, WHOLE
        regions: dict[Label, Curve] = {
            WORKSPACE: _ring((sizes.offset, 0.0), *ring),
            Phrase("half-a-turn"): _ring((-sizes.offset, 0.0), *ring),
        }
        series: dict[Label, Curve] = {}
        arm = (tuple(sizes.offset + each for each in x), y)
    else:
        regions = {WORKSPACE: _aside(_ring((0.0, 0.0), sizes.near, sizes.far, HALF), sizes.side)}
        series = {name: _aside(_circle(radius, HALF), sizes.side) for name, radius in sizes.boundaries()}
        arm = _aside((x, y), sizes.side)
    key = "in-the-plane" if sizes.offset else "distance"
    return Plot(
        "workspace", with_unit(key, sizes.unit), with_unit("height", sizes.unit), series, regions=regions,
        arms={LINKS: arm}, equal=True, unscaled=not sizes.known,
        caption=Phrase("drawn-section" if sizes.known else "drawn-section-in-letters"),
        alt=Phrase("seen-section", sizes.said()) if sizes.known else Phrase("seen-section-in-letters"),
    )  # fmt: skip


def _aside(curve: Curve, side: float) -> Curve:
    """What moves in a plane beside the axis, by its distance from the axis."""
    x, y = curve
    return tuple(math.hypot(each, side) for each in x), y


def with_unit(key: str, unit: str) -> Phrase:
    """What an axis of the plot is called, with its unit."""
    return Phrase("with-unit", {"name": Phrase(key), "unit": unit}) if unit else Phrase(key)


def _ring(center: tuple[float, float], near: float, far: float, turns: tuple[float, float]) -> Curve:
    """Outside one way, inside back."""
    out = [around(center, far, angle) for angle in _angles(turns)]
    back = [around(center, near, angle) for angle in reversed(_angles(turns))]
    xs, ys = zip(*(out + back), strict=True)
    return xs, ys


def _circle(radius: float, turns: tuple[float, float] = WHOLE) -> Curve:
    xs, ys = zip(*(around((0.0, 0.0), radius, angle) for angle in _angles(turns)), strict=True)
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
