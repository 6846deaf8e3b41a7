"""What stands inside the axes of a plot: regions, curves, links, arrows, and what is read off a curve."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from math import atan2, cos, pi, sin

from derive.derivation import Place, Plot, Span
from derive.render.drawing.axes import Axis
from derive.render.drawing.placing import Box, Lines, Wanted, placed
from derive.render.drawing.sketch import Sketch, said
from derive.render.drawing.style import AREAS, GREY, INK, LINES, REGION, Pen, series_pen

STRIP = 15.0  # points of each row below a curve, for lengths along the horizontal axis
FILLS = (REGION, "#3f6aa866", "#70707044")  # what lies under the second is seen through it
BAND, MARK, DROP, MEASURE = "#e6e6e6", Pen(GREY, 0.8, (4, 2.5)), Pen(GREY, 0.5, (1, 1.4)), Pen(INK, 0.7)
HALF_AXIS = Pen(INK, 0.9)
DOT, JOINT = 2.1, 3.0  # radii
CORNERS = 20
WALL = 12.0  # half of what is left to ticks at an axis, and to the panel above


@dataclass(frozen=True, slots=True)
class Frame:
    """Both axes of a plot; a `panel` has another above it."""

    x: Axis
    y: Axis
    panel: bool = False

    def at(self, place: Place) -> Place:
        return self.x.at(place[0]), self.y.at(place[1])


@dataclass(frozen=True, slots=True)
class Swatch:
    """A line of the legend."""

    name: str
    draw: Callable[[Sketch, Box], None]


def strip_rows(plot: Plot) -> int:
    """One for each length along the horizontal axis."""
    return sum(map(_along, plot.spans))


def _along(span: Span) -> bool:
    return span.start[0] != span.end[0]


def contents(plot: Plot, frame: Frame) -> Sketch:
    """From back to front, and names where there is room for them: not at the axes, nor beyond a panel."""
    sketch, lines = Sketch(), Lines()
    for height in (-WALL, frame.y.end + WALL) if frame.panel else (-WALL,):
        lines.add(((-WALL, height), (frame.x.end + WALL, height)), WALL)
    lines.add(((-WALL, -WALL), (-WALL, frame.y.end)), WALL)
    if plot.band:
        low, high = (frame.y.at(edge) for edge in plot.band)
        sketch.area(((0.0, low), (frame.x.end, low), (frame.x.end, high), (0.0, high)), BAND)
        lines.add(((0.0, low), (frame.x.end, low), (frame.x.end, high), (0.0, high)), 0.5)
    for fill, region in zip(_fills(plot), plot.regions.values(), strict=True):
        sketch.area([frame.at(place) for place in zip(*region, strict=True)], fill)
    for height in plot.marks.values():
        mark = ((0.0, frame.y.at(height)), (frame.x.end, frame.y.at(height)))
        sketch.line(mark, MARK)
        lines.add(mark, 0.5)
    for k, curve in enumerate(plot.series.values()):
        places = _thinned([frame.at(place) for place in zip(*curve, strict=True)])
        sketch.line(places, series_pen(k))
        lines.add(places, 0.8)
        for place in places if plot.counted else ():
            sketch.area(_circle(place, DOT), series_pen(k).colour)
    for links in plot.arms.values():
        _arm(sketch, lines, [frame.at(place) for place in zip(*links, strict=True)])
    for place in plot.points:
        sketch.area(_circle(frame.at(place), DOT), INK)
    names = [*_marks(plot, frame), *_arrows(sketch, lines, plot, frame), *_spans(sketch, lines, plot, frame)]
    texts = said([name for name, _ in names])
    wanted = [Wanted(text, tuple(spots)) for text, (_, spots) in zip(texts, names, strict=True)]
    for text, box in zip(texts, placed(wanted, lines)[0], strict=True):
        sketch.text(text, box.left, box.low)
    return sketch


def _fills(plot: Plot) -> list[str]:
    """One for each region; one without a name belongs to the one before."""
    found: list[str] = []
    for name in plot.regions:
        found.append(FILLS[len({*found}) % len(FILLS)] if name else found[-1])
    return found


Spots = list[tuple[Place, float, float]]  # places, each with the direction and the distance of a name


def _marks(plot: Plot, frame: Frame) -> Iterator[tuple[str, Spots]]:
    """Near the right end of its line, above or below; else further left."""
    for name, height in plot.marks.items():
        at = frame.y.at(height)
        spots = ((share * frame.x.end, at) for share in (0.84, 0.7, 0.5, 0.3, 0.15))
        yield str(name), [(spot, way, 5.0) for spot in spots for way in (pi / 2, -pi / 2)]


def _arrows(sketch: Sketch, lines: Lines, plot: Plot, frame: Frame) -> Iterator[tuple[str, Spots]]:
    """Each with its name at its head."""
    for name, (start, end) in plot.arrows.items():
        a, b = frame.at(start), frame.at(end)
        sketch.arrow((a, b), HALF_AXIS)
        lines.add((a, b), 1.5)
        yield str(name), [(b, atan2(b[1] - a[1], b[0] - a[0]), 3.0)]


def _spans(sketch: Sketch, lines: Lines, plot: Plot, frame: Frame) -> Iterator[tuple[str, Spots]]:
    """Those along the horizontal axis in rows below the curve, the one that ends last on top."""
    level = frame.y.start
    for span in sorted(filter(_along, plot.spans), key=lambda span: -span.end[0]):
        level -= STRIP
        ends = frame.at(span.start), frame.at(span.end)
        row = level + STRIP / 2 - 1.0
        for place in ends:
            sketch.line((place, (place[0], row - 3.0)), DROP)
            lines.add((place, (place[0], row - 3.0)), 0.3)
        _measured(sketch, lines, (ends[0][0], row), (ends[1][0], row))
        yield str(span.label), [((ends[1][0], row), 0.0, 4.0), ((ends[0][0], row), pi, 4.0)]
    for span in plot.spans:
        if not _along(span):
            foot, head = frame.at(span.start), frame.at(span.end)
            _measured(sketch, lines, foot, head)
            sketch.area(_circle(head, DOT), INK)
            yield str(span.label), [(head, way, 5.0) for way in (0.3, 0.0, pi / 2, pi - 0.3, -0.3)]


def _measured(sketch: Sketch, lines: Lines, a: Place, b: Place) -> None:
    """A line with a head at each end, where it is long enough for both."""
    lines.add((a, b), 2.0)
    if max(abs(b[0] - a[0]), abs(b[1] - a[1])) < 11.0:
        sketch.line((a, b), MEASURE)
        return
    middle = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
    sketch.arrow((middle, b), MEASURE)
    sketch.arrow((middle, a), MEASURE)


def _arm(sketch: Sketch, lines: Lines, places: Sequence[Place]) -> None:
    """Links with a circle at each joint and a dot at the end."""
    sketch.line(places, LINES["link"])
    lines.add(places, LINES["link"].width / 2)
    for place in places[:-1]:
        sketch.area(_circle(place, JOINT), *AREAS["cap"])
        lines.add(_circle(place, JOINT), 0.0)
    sketch.area(_circle(places[-1], DOT), INK)


def swatches(plots: Sequence[Plot]) -> list[Swatch]:
    """What a legend says of the first of some plots, which have the same curves."""
    found: list[Swatch] = []
    for plot in plots:
        found += [Swatch(str(n), _filled(fill)) for fill, n in zip(_fills(plot), plot.regions, strict=True)]
        found += [Swatch(str(name), _line(series_pen(k))) for k, name in enumerate(plot.series)]
        found += [Swatch(str(name), _line(LINES["link"])) for name in plot.arms]
    return [swatch for swatch in found if swatch.name]


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


def _circle(center: Place, radius: float) -> tuple[Place, ...]:
    turns = (2 * pi * k / CORNERS for k in range(CORNERS))
    return tuple((center[0] + radius * cos(turn), center[1] + radius * sin(turn)) for turn in turns)


def _thinned(places: Sequence[Place]) -> list[Place]:
    """Without places that are nearer to the one before than can be seen."""
    kept = [places[0]]
    for place in chain(places[1:-1]):
        if abs(place[0] - kept[-1][0]) + abs(place[1] - kept[-1][1]) > 0.25:
            kept.append(place)
    return [*kept, *places[len(places) - 1 :]] if len(places) > 1 else kept
