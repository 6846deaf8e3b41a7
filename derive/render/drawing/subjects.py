"""A drawing of a subject put on paper: as large as there is room for with its captions around it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from derive.derivation import Caption, Drawing, Place
from derive.render.drawing.lettering import Written, size_of, written
from derive.render.drawing.paper import Paper
from derive.render.drawing.placing import Box, Lines, Wanted, direction, placed
from derive.render.drawing.style import AREAS, ARROWS, HEAD_WIDE, HIGHEST, INK, LETTER_COLOURS, LINES, WIDEST

MARGIN = 2.0  # points round everything
GAPS = {"sign": 1.5, "x": 2.5, "y": 2.5, "z": 2.5, "before": 2.5, "length": 4.5, "angle": 3.0, "joint": 3.0}
GAP = 4.0  # points from its place to a caption
TRIES = 4  # to find the scale at which all fits


@dataclass(frozen=True, slots=True)
class Laid:
    """A drawing at a scale (points for its unit), and where its captions stand."""

    scale: float
    texts: tuple[Written, ...]
    boxes: tuple[Box, ...]
    leaders: tuple[tuple[Place, Place], ...]
    whole: Box


def on_paper(drawing: Drawing) -> Paper:
    """The drawing, its captions clear of each other and of its lines."""
    laid = laid_out(drawing)
    whole = laid.whole.grown(MARGIN)
    paper = Paper(whole.right - whole.left, whole.high - whole.low)

    def at(place: Place) -> Place:
        return place[0] - whole.left, place[1] - whole.low

    for stroke in drawing.strokes:
        places = [at((x * laid.scale, y * laid.scale)) for x, y in stroke.places]
        if stroke.role in AREAS:
            paper.area(places, *AREAS[stroke.role])
        elif stroke.role in ARROWS:
            paper.arrow(places, ARROWS[stroke.role])
        else:
            paper.line(places, LINES[stroke.role])
    for leader in laid.leaders:
        paper.line([at(place) for place in leader], LINES["leader"])
    for caption, text, box in zip(drawing.captions, laid.texts, laid.boxes, strict=True):
        left, high = at((box.left, box.high))
        paper.letters(left, high, text.content, LETTER_COLOURS.get(caption.role, INK), text.size)
    return paper


def laid_out(drawing: Drawing) -> Laid:
    """The largest scale at which the drawing and its captions keep within the limits of a picture."""
    bounds = _bounds(drawing)
    wide, high = WIDEST, drawing.highest or HIGHEST
    texts = tuple(written((caption, size_of(caption)) for caption in drawing.captions))
    if drawing.unit:
        return _laid(drawing, texts, drawing.unit, bounds)
    room_x, room_y = wide - 40, high - 24
    for _ in range(TRIES):
        scale = min(
            room_x / max(bounds.right - bounds.left, 1e-9), room_y / max(bounds.high - bounds.low, 1e-9)
        )
        laid = _laid(drawing, texts, scale, bounds)
        over_x, over_y = laid.whole.right - laid.whole.left - wide, laid.whole.high - laid.whole.low - high
        if max(over_x, over_y) <= 0.5:
            break
        room_x, room_y = room_x - max(0.0, over_x), room_y - max(0.0, over_y)
    return laid


def _laid(drawing: Drawing, texts: Sequence[Written], scale: float, bounds: Box) -> Laid:
    lines = Lines()
    for stroke in drawing.strokes:
        places = [(x * scale, y * scale) for x, y in stroke.places]
        closed = stroke.role in AREAS
        lines.add((*places, places[0]) if closed else places, _half(stroke.role))
        if closed:
            _fill(lines, places)
    wanted = [_wanted(caption, text, scale) for caption, text in zip(drawing.captions, texts, strict=True)]
    boxes, leaders = placed(wanted, lines)
    strokes = Box(*(side * scale for side in (bounds.left, bounds.low, bounds.right, bounds.high)))
    every = [strokes, *boxes]
    whole = Box(
        min(b.left for b in every), min(b.low for b in every),
        max(b.right for b in every), max(b.high for b in every),
    )  # fmt: skip
    return Laid(scale, tuple(texts), tuple(boxes), tuple(leaders), whole)


def _half(role: str) -> float:
    """Half of how wide a line is, heads of arrows included."""
    if role in AREAS:
        return AREAS[role][1].width / 2
    return max(HEAD_WIDE / 2 if role in ARROWS else 0.0, (ARROWS.get(role) or LINES[role]).width / 2)


def _fill(lines: Lines, places: Sequence[Place]) -> None:
    """What is filled is covered as well: lines from its middle to its corners stand for that."""
    x = sum(p[0] for p in places) / len(places)
    y = sum(p[1] for p in places) / len(places)
    for a, b in pairwise((*places, places[0])):
        lines.add(((x, y), ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)), 0.0)


def _wanted(caption: Caption, text: Written, scale: float) -> Wanted:
    place = caption.at[0] * scale, caption.at[1] * scale
    if caption.towards == (0.0, 0.0):
        return Wanted(text, upon=place)
    gap = GAPS.get(caption.role, GAP) + caption.clear * scale
    sides = ((caption.at, caption.towards), *caption.others)
    return Wanted(
        text, tuple(((at[0] * scale, at[1] * scale), direction(towards), gap) for at, towards in sides)
    )


def _bounds(drawing: Drawing) -> Box:
    """Of all strokes and of what is written upon them."""
    places = [place for stroke in drawing.strokes for place in stroke.places]
    places += [caption.at for caption in drawing.captions]
    xs, ys = [p[0] for p in places], [p[1] for p in places]
    return Box(min(xs), min(ys), max(xs), max(ys))
