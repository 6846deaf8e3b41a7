"""Pictures of workspaces with limits: sectors, what a rail sweeps, rectangles, shells in section."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TypeAlias

from derive.derivation import Curve, Label, Phrase, Plot
from derive.expression import Symbol
from derive.figures.axes import axis
from derive.figures.view import around
from derive.figures.workspaces import with_unit

CORNERS = 121
Ends: TypeAlias = tuple[float, float]
Corners: TypeAlias = Sequence[tuple[float, float]]


def from_along(parts: Sequence[Corners], names: tuple[str, str], unit: str) -> Plot:
    """Regions in a plane of the base, whose axes are these."""
    regions: dict[Label, Curve] = {
        "" if k else Phrase("workspace"): _curve(part) for k, part in enumerate(parts)
    }
    across, up = (axis(Symbol(name), unit) for name in names)
    return Plot(
        "workspace", across, up, {}, regions=regions, equal=True,
        caption=Phrase("drawn-limited"), alt=Phrase("seen-limited"),
    )  # fmt: skip


def in_section(part: Corners, unit: str) -> Plot:
    """A region by its distance from the first axis."""
    return Plot(
        "workspace", with_unit("distance", unit), with_unit("height-above", unit), {},
        regions={Phrase("workspace"): _curve(part)}, equal=True,
        caption=Phrase("drawn-limited-section"), alt=Phrase("seen-limited-section"),
    )  # fmt: skip


def _curve(corners: Corners) -> Curve:
    xs, ys = zip(*corners, strict=True)
    return xs, ys


def outline(near: float, far: float, turn: Ends, rail: Ends) -> Corners:
    """From `near` to `far` between two angles, or all that moved along a rail."""
    return [*(_swept(near, far, rail) if rail[1] > rail[0] else _ring(near, far, turn))]


def _swept(near: float, far: float, rail: Ends) -> Iterator[tuple[float, float]]:
    """Half a circle about each end of the rail; then the lens that is too near to every place of it."""
    low, high = rail
    quarter = math.pi / 2
    yield from _arc(high, far, -quarter, quarter)
    yield from _arc(low, far, quarter, 3 * quarter)
    yield around((high, 0.0), far, -quarter)
    if 2 * near > high - low:
        half = math.acos((high - low) / (2 * near))
        yield from _arc(low, near, half, -half)
        yield from _arc(high, near, math.pi + half, math.pi - half)
        yield around((high, 0.0), far, -quarter)


def _arc(center: float, radius: float, start: float, end: float) -> Iterator[tuple[float, float]]:
    for k in range(CORNERS):
        yield around((center, 0.0), radius, start + (end - start) * k / (CORNERS - 1))


def _ring(near: float, far: float, turn: Ends) -> Iterator[tuple[float, float]]:
    low, high = turn
    yield from _arc(0.0, far, low, high)
    yield from _arc(0.0, near, high, low)
    yield around((0.0, 0.0), far, low)
