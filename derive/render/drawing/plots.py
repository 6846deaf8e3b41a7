"""Plots put on paper: axes with their ticks around what `curves` draws, a legend above, panels in a row."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from derive.derivation import Panels, Plot
from derive.render.drawing.axes import Axis, Frame, span
from derive.render.drawing.curves import contents
from derive.render.drawing.legend import with_legend
from derive.render.drawing.lettering import Written
from derive.render.drawing.paper import Paper
from derive.render.drawing.readings import STRIP, strip_rows
from derive.render.drawing.sketch import Sketch, said
from derive.render.drawing.style import FAINT, INK, LETTERS, PALE, WIDEST, Pen

MARGIN = 2.0  # points round everything
WIDE, HIGH, LOW, PANEL, SQUARE = WIDEST - 46, 150.0, 90.0, 46.0, 150.0  # of what is inside the axes
ONE, OTHER = (88.0, 96.0), (150.0, 165.0)  # high and wide: what stands before another, and that one
BETWEEN, APART = 9.0, 22.0  # panels above each other, and beside each other
TICK, AIR = 3.0, 3.0
ROOM_X, ROOM_Y = 42.0, 24.0  # points that ticks are apart at least
AXIS, GRID, MOMENT = Pen(INK, 0.8), Pen(PALE, 0.5), Pen(FAINT, 0.6, (1, 1.6))
LETTER = 12.0  # points: a name of an axis as short as a letter is not turned


def on_paper(picture: Plot | Panels) -> Paper:
    """A picture whose labels are said already."""
    return sketched(picture).paper(MARGIN)


def sketched(picture: Plot | Panels) -> Sketch:
    """Everything of it, in points."""
    match picture:
        case Plot():
            high = SQUARE if picture.equal else LOW if picture.unscaled else HIGH
            return _alone(picture, framed(picture, high))
        case Panels(plots=plots, beside=True):
            *first, last = plots
            return _row(
                [*(_alone(plot, framed(plot, *ONE)) for plot in first), _alone(last, framed(last, *OTHER))]
            )
        case Panels(plots=plots):
            return _stack(plots)


def _alone(plot: Plot, frame: Frame) -> Sketch:
    return with_legend(_drawn(plot, frame), plot)


def framed(plot: Plot, high: float, wide: float = WIDE) -> Frame:
    """Both axes, with room for all that is drawn."""
    xs, ys = _reached(plot)
    low, top = span(ys, 0.06 if not plot.log else 0.0, plot.log)
    strip = STRIP * strip_rows(plot)
    if not plot.equal:
        left, right = span(xs, 0.02 if plot.counted else 0.0)
        return Frame(Axis(left, right, 0.0, wide), Axis(low, top, strip, high, plot.log))
    left, right = span(xs, 0.06)
    scale = min(wide / (right - left), high / (top - low))
    return Frame(Axis(left, right, 0.0, scale * (right - left)), Axis(low, top, 0.0, scale * (top - low)))


def _reached(plot: Plot) -> tuple[list[float], list[float]]:
    """Every number to the right and up that is drawn."""
    curves = [*plot.series.values(), *plot.regions.values(), *plot.arms.values()]
    places = [*plot.points, *(place for arrow in plot.arrows.values() for place in arrow)]
    places += [place for each in plot.spans for place in (each.start, each.end)]
    xs = [x for curve in curves for x in curve[0]] + [x for x, _ in places] + [*plot.moments.values()]
    ys = [y for curve in curves for y in curve[1]] + [y for _, y in places] + [*plot.marks.values()]
    return xs, [*ys, *(plot.band or ())]


def _drawn(plot: Plot, frame: Frame, bottom: bool = True, ticks: float = 0.0) -> Sketch:
    """The axes and what is inside; at the `bottom` of several the horizontal axis is named. `ticks` is how
    wide those of others are at the vertical axis."""
    sketch, x, y = Sketch(), frame.x, frame.y
    across = [] if plot.unscaled else x.ticks(ROOM_X, plot.counted)
    up = _heights(plot, frame)
    for tick in across:
        sketch.line(((x.at(tick), 0.0), (x.at(tick), y.end)), GRID)
    for tick, _ in () if plot.unscaled else up:
        sketch.line(((0.0, y.at(tick)), (x.end, y.at(tick))), GRID)
    for time in plot.moments.values():
        sketch.line(((x.at(time), 0.0), (x.at(time), y.end)), MOMENT)
    sketch.add(contents(plot, frame), 0.0, 0.0)
    sketch.line(((0.0, y.end), (0.0, 0.0), (x.end, 0.0)), AXIS)
    for tick, text in up:
        sketch.line(((-TICK, y.at(tick)), (0.0, y.at(tick))), AXIS)
        sketch.text(text, -TICK - AIR - text.wide, y.at(tick) - text.high / 2)
    for tick, text in zip(across, said([x.written(tick) for tick in across]), strict=True):
        sketch.line(((x.at(tick), -TICK), (x.at(tick), 0.0)), AXIS)
        if bottom:
            sketch.text(text, x.at(tick) - text.wide / 2, -TICK - AIR - text.high)
    (name,) = said([str(plot.y_label)], LETTERS)
    turned = name.wide > LETTER
    room = max([ticks, *(text.wide for _, text in up)])
    left = -TICK - AIR - room - 6.0 - (name.high if turned else name.wide)
    middle = (y.start + y.end) / 2 - (name.wide if turned else name.high) / 2
    sketch.text(name, left, middle, turned)
    if bottom:
        _below(sketch, plot, frame)
    return sketch


def _heights(plot: Plot, frame: Frame) -> list[tuple[float, Written]]:
    """What stands at the vertical axis, and where."""
    ticks = [] if plot.unscaled else frame.y.ticks(ROOM_Y)
    named = {
        **{tick: frame.y.written(tick) for tick in ticks},
        **{at: str(n) for n, at in plot.levels.items()},
    }
    return list(zip(named, said([*named.values()]), strict=True))


def _below(sketch: Sketch, plot: Plot, frame: Frame) -> None:
    """Moments under the ticks, in as many rows as they need, and the name of the axis."""
    low = 2.0 if plot.unscaled else -TICK - AIR - 7.0
    ends: list[float] = []  # of each row
    names = said([str(name) for name in plot.moments])
    for time, text in sorted(zip(plot.moments.values(), names, strict=True), key=lambda each: each[0]):
        left = frame.x.at(time) - text.wide / 2
        row = next((k for k, end in enumerate(ends) if left > end + 2 * AIR), len(ends))
        ends[row : row + 1] = [left + text.wide]
        sketch.text(text, left, low - 12.0 * (row + 1))
    (name,) = said([str(plot.x_label)], LETTERS)
    if plot.unscaled and ends:
        sketch.text(name, frame.x.end - name.wide, low - 12.0)
        return
    at = (frame.x.start + frame.x.end) / 2 - name.wide / 2
    sketch.text(name, at, low - 12.0 * len(ends) - 5.0 - name.high)


def _stack(plots: Sequence[Plot]) -> Sketch:
    """One above the other; the horizontal axis is named below the last."""
    sketch, frames = Sketch(), [framed(plot, PANEL + STRIP * strip_rows(plot)) for plot in plots]
    low, high = min(f.x.low for f in frames), max(f.x.high for f in frames)
    ticks = max((text.wide for each in map(_heights, plots, frames) for _, text in each), default=0.0)
    at = 0.0
    for k, (plot, frame) in enumerate(zip(reversed(plots), reversed(frames), strict=True)):
        same = replace(frame, x=replace(frame.x, low=low, high=high), panel=True)
        sketch.add(_drawn(plot, same, k == 0, ticks), 0.0, at)
        at += frame.y.end + BETWEEN
    return with_legend(sketch, plots[0])


def _row(sketches: Sequence[Sketch]) -> Sketch:
    """Beside each other, their horizontal axes at one height."""
    whole, at = Sketch(), 0.0
    for sketch in sketches:
        box = sketch.whole
        whole.add(sketch, at - box.left, 0.0)
        at += box.right - box.left + APART
    return whole
