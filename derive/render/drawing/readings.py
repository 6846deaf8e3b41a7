"""What is read off the curves of a plot, with the places at which its names may stand: levels, vectors, and
lengths along both axes."""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, cos, pi, sin

from derive.derivation import Place, Plot, Span
from derive.render.drawing.axes import Frame
from derive.render.drawing.placing import Lines
from derive.render.drawing.sketch import Sketch
from derive.render.drawing.style import GREY, INK, Pen

STRIP = 15.0  # points of each row below a curve, for lengths along the horizontal axis
DROP, MEASURE, HALF_AXIS = Pen(GREY, 0.5, (1, 1.4)), Pen(INK, 0.7), Pen(INK, 0.9)
DOT, CORNERS = 2.1, 20
Spots = list[tuple[Place, float, float]]  # places, each with the direction and the distance of a name


def strip_rows(plot: Plot) -> int:
    """One for each length along the horizontal axis."""
    return sum(map(_along, plot.spans))


def _along(span: Span) -> bool:
    return span.start[0] != span.end[0]


def marks(plot: Plot, frame: Frame) -> Iterator[tuple[str, Spots]]:
    """Near the right end of its line, above or below; else further left."""
    for name, height in plot.marks.items():
        at = frame.y.at(height)
        spots = ((share * frame.x.end, at) for share in (0.84, 0.7, 0.5, 0.3, 0.15))
        yield str(name), [(spot, way, 5.0) for spot in spots for way in (pi / 2, -pi / 2)]


def arrows(sketch: Sketch, lines: Lines, plot: Plot, frame: Frame) -> Iterator[tuple[str, Spots]]:
    """Each with its name at its head."""
    for name, (start, end) in plot.arrows.items():
        a, b = frame.at(start), frame.at(end)
        sketch.arrow((a, b), HALF_AXIS)
        lines.add((a, b), 1.5)
        yield str(name), [(b, atan2(b[1] - a[1], b[0] - a[0]), 3.0)]


def spans(sketch: Sketch, lines: Lines, plot: Plot, frame: Frame) -> Iterator[tuple[str, Spots]]:
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
            sketch.area(dot(head), INK)
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


def dot(center: Place, radius: float = DOT) -> tuple[Place, ...]:
    turns = (2 * pi * k / CORNERS for k in range(CORNERS))
    return tuple((center[0] + radius * cos(turn), center[1] + radius * sin(turn)) for turn in turns)
