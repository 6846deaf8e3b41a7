"""A motion drawn step by step: beside each other the frame after each move, and in grey that before it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Drawing, Phrase, Place, Said, Stroke
from derive.expression import Expr, Symbol
from derive.figures.arm import direction, place_of
from derive.figures.arm_frames import LONG, Arrow, arrows_drawn, pointing_at_reader, shared
from derive.figures.clear_views import clearest
from derive.figures.solids import turn
from derive.figures.triads import apart, wish_values
from derive.figures.typical import completed, typical
from derive.figures.view import Vector, View, along, dot
from derive.figures.wish import Wish
from derive.mechanics.motion import Motion, Move
from derive.mechanics.oracle import compose
from derive.mechanics.sequences import in_product_order

A_ROW = 4  # panels side by side
ROOM = 0.85  # of an axis, between panels
SAME = 1e-6  # places and directions that differ by less
AXIS = 1.15  # of an axis: how far that of a turn is drawn
SLANTED = "k"  # one that is no axis of a frame
LARGE, WIDE = 42.0, 345.0  # points: an axis of a frame in every such figure, and all panels side by side


def of_motion(motion: Motion, where: Mapping[str, Expr], wish: Wish) -> Drawing:
    """A panel for each move."""
    import numpy

    point = completed(typical(motion.moves, (), where, ())[0] | wish_values(wish), where)
    made = motion.moves
    poses = [numpy.eye(4), *(compose(in_product_order(made[: k + 1]), point) for k in range(len(made)))]
    turns = [_axis(move, poses, k, point) for k, move in enumerate(made) if move.kind == "rotate"]
    view = clearest(poses, turns)
    size = apart(view, [place_of(T) for T in poses], 0.8)
    panels = [_panel(view, poses, k, move, point, size) for k, move in enumerate(made)]
    boxes = [_bounds(strokes) for strokes, _ in panels]
    wide = max(right - left for left, right, _, _ in boxes) + ROOM * size
    high = max(top - low for _, _, low, top in boxes) + 0.75 * ROOM * size
    strokes: list[Stroke] = []
    captions: list[Caption] = []
    for k, ((drawn, texts), (left, right, low, _)) in enumerate(zip(panels, boxes, strict=True)):
        shift = (k % A_ROW) * wide - (left + right) / 2, -(k // A_ROW) * high - low
        strokes += [
            Stroke(tuple(moved_by(place, shift) for place in stroke.places), stroke.role) for stroke in drawn
        ]
        captions += [moved(text, shift) for text in texts]
        title = (k % A_ROW) * wide, -(k // A_ROW) * high - 0.6 * size
        captions.append(Caption(title, _step(made[k], k + 1), (0.0, 0.0), "note"))
    steps = tuple(_step(move, k + 1) for k, move in enumerate(made))
    seen = any(not _hidden(before, after, size) for before, after in pairwise(poses))
    key = "step" if len(made) == 1 else "steps"
    told = Phrase(key if seen else f"{key}-alone")
    return Drawing(
        "figure", tuple(strokes), tuple(captions), told, Phrase("steps-seen", {"steps": steps}),
        unit=min(LARGE / size, WIDE / (wide * min(A_ROW, len(made)))),
    )  # fmt: skip


def _panel(
    view: View, poses: Sequence[Any], k: int, move: Move, point: Mapping[str, float], size: float
) -> tuple[list[Stroke], list[Caption]]:
    """The frame after move k, the one before it, and how the move leads from one to the other."""
    before = shared([(str(k), poses[k])], "xyz", size)
    strokes = [Stroke(stroke.places, "before") for stroke, _ in arrows_drawn(view, before, size / LONG)]
    arrows = shared([(str(k + 1), poses[k + 1])], "xyz", size)
    if _hidden(poses[k], poses[k + 1], size):
        arrows = [_also(arrow, before) for arrow in arrows]
    captions: list[Caption] = []
    if move.kind == "translate":
        strokes += _shift(view, place_of(poses[k]), place_of(poses[k + 1]))
    else:
        axis, name = _axis(move, poses, k, point), _axis_name(move, k)
        captions += _named_along(view, arrows, axis, name, place_of(poses[k]), size)
        strokes += _turn(view, place_of(poses[k]), axis, number(move.by, point), size)
    for stroke, caption in arrows_drawn(view, arrows, size / LONG):
        strokes.append(stroke)
        captions.append(caption)
    for signs, caption in pointing_at_reader(view, arrows, size):
        strokes += signs
        captions.append(caption)
    return strokes, captions


def _hidden(before: Any, after: Any, size: float) -> bool:
    """Whether each axis of the frame before a move lies under one of that after it."""
    first, then = (shared([("", pose)], "xyz", size) for pose in (before, after))
    return all(any(_on(arrow, other) for other in then) for arrow in first)


def _on(arrow: Arrow, other: Arrow) -> bool:
    return math.dist(arrow.origin, other.origin) < SAME and math.dist(arrow.way, other.way) < SAME


def _also(arrow: Arrow, before: Sequence[Arrow]) -> Arrow:
    """The arrow with the names of that which lies under it."""
    under = (name for each in before if _on(arrow, each) for name in each.names)
    return replace(arrow, names=(*arrow.names, *under))


def _shift(view: View, start: Vector, end: Vector) -> Iterator[Stroke]:
    """The way that is moved."""
    if start != end:
        yield Stroke((view.place(start), view.place(end)), "way")


def _turn(view: View, start: Vector, axis: Vector, by: float, size: float) -> Iterator[Stroke]:
    """The axis of a turn, dashed, and an arrow round it."""
    yield Stroke((view.place(start), view.place(along(start, (AXIS * size, axis)))), "hidden")
    at = along(start, (0.62 * size, axis))
    circle = turn(view, at, axis, 0.26 * size)
    yield Stroke(circle if by >= 0 else tuple(reversed(circle)), "turn")


def _named_along(
    view: View, arrows: list[Arrow], axis: Vector, name: str, start: Vector, size: float
) -> Iterator[Caption]:
    """The name of the axis of a turn: with that of the axis of the frame that lies on it, or at its end."""
    for k, arrow in enumerate(arrows):
        if dot(arrow.way, axis) > 1 - 1e-6:
            arrows[k] = replace(arrow, names=(name, *(each for each in arrow.names if each != name)))
            return
    foot, end = view.place(start), view.place(along(start, (AXIS * size, axis)))
    yield Caption(end, name, (end[0] - foot[0], end[1] - foot[1]), "before")


def _axis(move: Move, poses: Sequence[Any], k: int, point: Mapping[str, float]) -> Vector:
    """The unit vector about which a move turns."""
    return direction(poses[0] if move.about == "world" else poses[k], move.axis, point)


def _axis_name(move: Move, k: int) -> str:
    """`z0` of the world, `z1` of the frame that is turned, `k` for a slanted axis."""
    if not isinstance(move.axis, str):
        return SLANTED
    return f"{move.axis}{0 if move.about == 'world' else k}"


def _step(move: Move, number_: int) -> Phrase:
    """What a move does, by its axis: `30 deg about z_0`, about the world's or its own."""
    about: dict[str, Said] = {"by": move.by}
    if move.kind == "translate" and not isinstance(move.axis, str):
        return Phrase("translate-aslant", about)
    return Phrase(move.kind, {**about, "axis": Symbol(_axis_name(move, number_ - 1))})


def _bounds(strokes: Sequence[Stroke]) -> tuple[float, float, float, float]:
    places = [place for stroke in strokes for place in stroke.places]
    xs, ys = [p[0] for p in places], [p[1] for p in places]
    return min(xs), max(xs), min(ys), max(ys)


def moved_by(place: Place, shift: Place) -> Place:
    """A place on paper, moved."""
    return place[0] + shift[0], place[1] + shift[1]


def moved(caption: Caption, shift: Place) -> Caption:
    """A caption with all its places moved."""
    others = tuple((moved_by(place, shift), side) for place, side in caption.others)
    return replace(caption, at=moved_by(caption.at, shift), others=others)
