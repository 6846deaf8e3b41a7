"""A motion drawn step by step: beside each other the frame after each move, and in grey that before it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Drawing, Phrase, Place, Said, Stroke
from derive.expression import Expr, Symbol
from derive.figures.arm import place_of
from derive.figures.arm_frames import LONG, arrows_drawn, shared
from derive.figures.solids import turn
from derive.figures.triads import apart, wish_values
from derive.figures.typical import completed, typical
from derive.figures.view import Vector, View, along, in_space, unit
from derive.figures.wish import Wish
from derive.mechanics.motion import Motion, Move
from derive.mechanics.oracle import compose
from derive.mechanics.sequences import in_product_order

A_ROW = 4  # panels side by side
LOW = 150.0  # points: how high a row of them may be
ROOM = 0.5  # of an axis, between panels


def of_motion(motion: Motion, where: Mapping[str, Expr], wish: Wish) -> Drawing:
    """A panel for each move."""
    import numpy

    point = completed(typical(motion.moves, (), where, ())[0] | wish_values(wish), where)
    made = motion.moves
    poses = [numpy.eye(4), *(compose(in_product_order(made[: k + 1]), point) for k in range(len(made)))]
    view = in_space()
    size = apart(view, [place_of(T) for T in poses], 0.8)
    panels = [_panel(view, poses, k, move, point, size) for k, move in enumerate(made)]
    boxes = [_bounds(strokes) for strokes, _ in panels]
    wide = max(right - left for left, right, _, _ in boxes) + ROOM * size
    high = max(top - low for _, _, low, top in boxes) + 1.3 * ROOM * size
    strokes: list[Stroke] = []
    captions: list[Caption] = []
    for k, ((drawn, texts), (left, right, low, _)) in enumerate(zip(panels, boxes, strict=True)):
        shift = (k % A_ROW) * wide - (left + right) / 2, -(k // A_ROW) * high - low
        strokes += [
            Stroke(tuple(moved_by(place, shift) for place in stroke.places), stroke.role) for stroke in drawn
        ]
        captions += [moved(text, shift) for text in texts]
        title = (k % A_ROW) * wide, -(k // A_ROW) * high - 0.45 * size
        captions.append(Caption(title, _step(made[k], k + 1), (0.0, 0.0), "note"))
    rows = -(-len(made) // A_ROW)
    steps = tuple(_step(move, k + 1) for k, move in enumerate(made))
    return Drawing(
        "figure", tuple(strokes), tuple(captions), Phrase("steps"), Phrase("steps-seen", {"steps": steps}),
        highest=LOW * rows,
    )  # fmt: skip


def _panel(
    view: View, poses: Sequence[Any], k: int, move: Move, point: Mapping[str, float], size: float
) -> tuple[list[Stroke], list[Caption]]:
    """The frame after move k, the one before it, and how the move leads from one to the other."""
    before, after = poses[k], poses[k + 1]
    strokes = [
        Stroke(stroke.places, "before")
        for stroke, _ in arrows_drawn(view, shared([("", before)], "xyz", size), size / LONG)
    ]
    strokes += _way(view, poses, k, move, point, size)
    captions = []
    for stroke, caption in arrows_drawn(view, shared([(str(k + 1), after)], "xyz", size), size / LONG):
        strokes.append(stroke)
        captions.append(caption)
    return strokes, captions


def _way(
    view: View, poses: Sequence[Any], k: int, move: Move, point: Mapping[str, float], size: float
) -> Iterator[Stroke]:
    """A turn about its axis, or the way that is moved."""
    base = poses[0] if move.about == "world" else poses[k]
    if move.kind == "translate":
        ends = place_of(poses[k]), place_of(poses[k + 1])
        if ends[0] != ends[1]:
            yield Stroke((view.place(ends[0]), view.place(ends[1])), "way")
        return
    axis = _axis(move, base, point)
    if number(move.by, point) < 0:
        axis = (-axis[0], -axis[1], -axis[2])
    start = place_of(poses[k])
    yield Stroke((view.place(start), view.place(along(start, (0.95 * size, axis)))), "hidden")
    at = along(start, (0.62 * size, axis))
    yield Stroke(turn(view, at, axis, 0.22 * size), "turn")


def _axis(move: Move, base: Any, point: Mapping[str, float]) -> Vector:
    """The unit vector about which a move turns."""
    if isinstance(move.axis, str):
        k = "xyz".index(move.axis)
        return float(base[0][k]), float(base[1][k]), float(base[2][k])
    local = [number(part, point) for part in move.axis]
    return unit([float(sum(base[i][j] * local[j] for j in range(3))) for i in range(3)])


def _step(move: Move, number_: int) -> Phrase:
    """What a move does, by its axis: `30 deg about z_0`, about the world's or its own."""
    about: dict[str, Said] = {"by": move.by}
    if not isinstance(move.axis, str):
        return Phrase(f"{move.kind}-aslant", about)
    axis = Symbol(f"{move.axis}0") if move.about == "world" else Symbol(f"{move.axis}{number_ - 1}")
    return Phrase(move.kind, {**about, "axis": axis})


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
