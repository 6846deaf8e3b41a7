"""Pictures of workspaces with limits: sectors, what a rail sweeps, rectangles, shells in section."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from derive.derivation import Curve, Label, Phrase, Plot
from derive.expression import Symbol
from derive.figures.axes import axis
from derive.figures.view import around
from derive.figures.workspaces import with_unit

CORNERS = 121
X, Y = Symbol("x"), Symbol("y")
Ends = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Outline:
    """The region in numbers, lengths in `unit`: from `near` to `far` between two angles (`turn`; elevations
    of a shell), moved along a `rail`; of a rectangle its two `sides`."""

    kind: str
    unit: str
    near: float
    far: float
    turn: Ends
    rail: Ends = (0.0, 0.0)
    sides: tuple[Ends, ...] = ()
    side: float = 0.0


def drawn(outline: Outline) -> Plot:
    """The region as it is seen along the axes, or in section through the first axis."""
    shell = outline.kind == "ball"
    regions: dict[Label, Curve] = {Phrase("workspace"): outline_of(outline)}
    across, up = axis(X, outline.unit), axis(Y, outline.unit)
    if shell:
        across, up = with_unit("distance", outline.unit), with_unit("height-above", outline.unit)
    return Plot(
        "workspace", across, up, {}, regions=regions, equal=True,
        caption=Phrase("drawn-limited-section" if shell else "drawn-limited"),
        alt=Phrase("seen-limited-section" if shell else "seen-limited"),
    )  # fmt: skip


def outline_of(outline: Outline) -> Curve:
    """The corners, outside one way and inside back."""
    match outline.kind:
        case "box":
            (left, right), (bottom, top) = outline.sides
            corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)]
        case "rail":
            corners = [*_swept(outline)]
        case "ball" if outline.side:
            corners = [
                (math.hypot(x, outline.side), y) for x, y in _ring(outline.near, outline.far, outline.turn)
            ]
        case _:
            corners = [*_ring(outline.near, outline.far, outline.turn)]
    xs, ys = zip(*corners, strict=True)
    return xs, ys


def _swept(outline: Outline) -> Iterator[tuple[float, float]]:
    """Half a circle about each end of the rail; then the lens that is too near to every place of it."""
    low, high = outline.rail
    quarter = math.pi / 2
    yield from _arc(high, outline.far, -quarter, quarter)
    yield from _arc(low, outline.far, quarter, 3 * quarter)
    yield from _arc(high, outline.far, -quarter, -quarter)
    if 2 * outline.near > high - low:
        half = math.acos((high - low) / (2 * outline.near))
        yield from _arc(low, outline.near, half, -half)
        yield from _arc(high, outline.near, math.pi + half, math.pi - half)


def _arc(center: float, radius: float, start: float, end: float) -> Iterator[tuple[float, float]]:
    for k in range(CORNERS):
        yield around((center, 0.0), radius, start + (end - start) * k / (CORNERS - 1))


def _ring(near: float, far: float, turn: Ends) -> Iterator[tuple[float, float]]:
    low, high = turn
    yield from _arc(0.0, far, low, high)
    yield from _arc(0.0, near, high, low)
    yield from _arc(0.0, far, low, low)
