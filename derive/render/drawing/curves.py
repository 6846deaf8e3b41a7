"""What stands inside the axes of a plot: regions, curves, links, arrows, and what is read off a curve."""

from __future__ import annotations

from collections.abc import Sequence

from derive.derivation import Place, Plot
from derive.render.drawing.axes import Frame
from derive.render.drawing.legend import fills
from derive.render.drawing.placing import Lines, Wanted, placed
from derive.render.drawing.readings import arrows, dot, marks, spans
from derive.render.drawing.sketch import Sketch, said
from derive.render.drawing.style import AREAS, GREY, INK, LINES, Pen, series_pen

BAND, MARK = "#e6e6e6", Pen(GREY, 0.8, (4, 2.5))
JOINT = 3.0  # radius
WALL = 12.0  # half of what is left to ticks at an axis, and to the panel above
SEEN = 0.25  # points between places that are told apart


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
    for fill, region in zip(fills(plot), plot.regions.values(), strict=True):
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
            sketch.area(dot(place), series_pen(k).colour)
    for links in plot.arms.values():
        _arm(sketch, lines, [frame.at(place) for place in zip(*links, strict=True)])
    for place in plot.points:
        sketch.area(dot(frame.at(place)), INK)
    names = [*marks(plot, frame), *arrows(sketch, lines, plot, frame), *spans(sketch, lines, plot, frame)]
    texts = said([name for name, _ in names])
    wanted = [Wanted(text, tuple(spots)) for text, (_, spots) in zip(texts, names, strict=True)]
    boxes, leaders = placed(wanted, lines)
    for leader in leaders:
        sketch.line(leader, LINES["leader"])
    for text, box in zip(texts, boxes, strict=True):
        sketch.text(text, box.left, box.low)
    return sketch


def _arm(sketch: Sketch, lines: Lines, places: Sequence[Place]) -> None:
    """Links with a circle at each joint and a dot at the end."""
    sketch.line(places, LINES["link"])
    lines.add(places, LINES["link"].width / 2)
    for place in places[:-1]:
        sketch.area(dot(place, JOINT), *AREAS["cap"])
        lines.add(dot(place, JOINT), 0.0)
    sketch.area(dot(places[-1]), INK)


def _thinned(places: Sequence[Place]) -> list[Place]:
    """Without places that are nearer to the one before than can be seen."""
    kept = [places[0]]
    for place in places[1:-1]:
        if abs(place[0] - kept[-1][0]) + abs(place[1] - kept[-1][1]) > SEEN:
            kept.append(place)
    return [*kept, *places[len(places) - 1 :]] if len(places) > 1 else kept
