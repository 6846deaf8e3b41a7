"""The legend of a plot: what its fillings, lines and links are."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from derive.derivation import Plot
from derive.render.drawing.placing import Box
from derive.render.drawing.sketch import Sketch, said
from derive.render.drawing.style import GREY, LINES, REGION, WIDEST, Pen, series_pen

FILLS = (REGION, "#3f6aa866", "#70707044")  # what lies under the second is seen through it
WIDE, HALF, BESIDE = 20.0, 3.0, 5.0  # points: of a swatch, half of its height, to its name
APART, ROW, ABOVE = 14.0, 13.0, 8.0  # to the next one, to the next row, from the plot
ROOM = WIDEST - 30.0


@dataclass(frozen=True, slots=True)
class Swatch:
    """A line of the legend."""

    name: str
    draw: Callable[[Sketch, Box], None]


def with_legend(sketch: Sketch, plot: Plot) -> Sketch:
    """A plot with its legend above, in rows as wide as a picture; without where there is one entry only."""
    entries = [*_entries(plot)]
    if len(entries) < 2:
        return sketch
    legend, left, low = Sketch(), 0.0, 0.0
    for entry, text in zip(entries, said([entry.name for entry in entries]), strict=True):
        wide = WIDE + BESIDE + text.wide
        if left and left + wide > ROOM:
            left, low = 0.0, low - ROW
        entry.draw(legend, Box(left, low - HALF, left + WIDE, low + HALF))
        legend.text(text, left + WIDE + BESIDE, low - min(text.high, 2 * HALF) / 2)
        left += wide + APART
    sketch.add(legend, 0.0, sketch.whole.high + ABOVE - legend.whole.low)
    return sketch


def _entries(plot: Plot) -> Iterator[Swatch]:
    """What has a name."""
    filled = zip(plot.regions, map(_filled, fills(plot)), strict=True)
    lines = ((name, _line(series_pen(k))) for k, name in enumerate(plot.series))
    links = ((name, _line(LINES["link"])) for name in plot.arms)
    yield from (Swatch(str(name), draw) for name, draw in (*filled, *lines, *links) if name)


def _filled(colour: str) -> Callable[[Sketch, Box], None]:
    def draw(sketch: Sketch, box: Box) -> None:
        corners = ((box.left, box.low), (box.right, box.low), (box.right, box.high), (box.left, box.high))
        sketch.area(corners, colour, Pen(GREY, 0.4))

    return draw


def _line(pen: Pen) -> Callable[[Sketch, Box], None]:
    def draw(sketch: Sketch, box: Box) -> None:
        middle = (box.low + box.high) / 2
        sketch.line(((box.left, middle), (box.right, middle)), pen)

    return draw


def fills(plot: Plot) -> list[str]:
    """One for each region; one without a name belongs to the one before."""
    found: list[str] = []
    for name in plot.regions:
        found.append(FILLS[len({*found}) % len(FILLS)] if name else found[-1])
    return found
