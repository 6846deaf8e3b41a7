"""Frames, and a motion from its start to its end, drawn as triads of axes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Drawing, Stroke
from derive.expression import Expr, Symbol
from derive.figures.solids import triad
from derive.figures.typical import completed, typical
from derive.figures.view import View, in_space, length
from derive.mechanics.frames import ByMatrix, Frames, FrameSource, Observed
from derive.mechanics.motion import Motion, Move
from derive.mechanics.oracle import compose
from derive.mechanics.sequences import in_product_order


def of_frames(frames: Frames, where: Mapping[str, Expr]) -> Drawing:
    """Every frame where it stands, and from which frame it is given."""
    import numpy

    every = [move for frame in frames.frames for move in _moves(frame.source)]
    lengths = [part for frame in frames.frames for part in _origins(frame.source)]
    point = completed(typical(every, lengths, where, ())[0], where)
    poses = [numpy.eye(4)]
    for frame in frames.frames:
        poses.append(poses[frame.parent] @ _pose(frame.source, point))
    view = in_space()
    strokes: list[Stroke] = []
    for frame in frames.frames:
        ends = view.place(_origin(poses[frame.parent])), view.place(_origin(poses[frame.number]))
        strokes.append(Stroke(ends, "way"))
    return _with_triads("figure", view, strokes, [(str(k), T, "") for k, T in enumerate(poses)])


def of_motion(motion: Motion, where: Mapping[str, Expr]) -> Drawing:
    """The triad before the motion and after it."""
    import numpy

    point = completed(typical(motion.moves, (), where, ())[0], where)
    T = compose(in_product_order(motion.moves), point)
    view = in_space()
    strokes = []
    start, end = view.place((0.0, 0.0, 0.0)), view.place(_origin(T))
    if length((end[0] - start[0], end[1] - start[1])) > 1e-9:
        strokes.append(Stroke((start, end), "way"))
    return _with_triads("figure", view, strokes, [("0", numpy.eye(4), "before"), ("1", T, "")])


def _with_triads(
    name: str, view: View, strokes: Sequence[Stroke], triads: Sequence[tuple[str, Any, str]]
) -> Drawing:
    origins = [view.place(_origin(T)) for _, T, _ in triads]
    gaps = [length((a[0] - b[0], a[1] - b[1])) for k, a in enumerate(origins) for b in origins[:k]]
    apart = [gap for gap in gaps if gap > 1e-9]
    size = 0.55 * (sorted(apart)[len(apart) // 2] if apart else 1.0)
    lines, captions = list(strokes), list(_origin_names(view, triads))
    for index, T, role in triads:
        for stroke, caption in triad(view, T, size, index, role=role):
            lines.append(stroke)
            captions.append(caption)
    return Drawing(name, tuple(lines), tuple(captions))


def _origin_names(view: View, triads: Sequence[tuple[str, Any, str]]) -> Iterator[Caption]:
    """o_0, o_1, ... where they are places of their own."""
    places = [_origin(T) for _, T, _ in triads]
    for (index, _, _), place in zip(triads, places, strict=True):
        if sum(max(abs(a - b) for a, b in zip(place, other, strict=True)) < 1e-9 for other in places) == 1:
            yield Caption(view.place(place), Symbol(f"o_{index}"), (-0.3, -1.0), "origin")


def _moves(source: FrameSource) -> tuple[Move, ...]:
    return source.moves if isinstance(source, Motion) else ()


def _origins(source: FrameSource) -> tuple[Expr, ...]:
    """The expressions that are lengths."""
    match source:
        case Observed():
            return source.origin
        case ByMatrix(matrix) if matrix.shape == (4, 4):
            return tuple(row[3] for row in matrix.rows[:3])
        case _:
            return ()


def _pose(source: FrameSource, point: Mapping[str, float]) -> Any:
    import numpy

    T = numpy.eye(4)
    match source:
        case Motion(made):
            return compose(in_product_order(made), point)
        case Observed():
            for k, axis in enumerate((source.x, source.y, source.z)):
                T[:3, k] = [number(part, point) for part in axis]
            T[:3, 3] = [number(part, point) for part in source.origin]
        case ByMatrix(matrix):
            for i, row in enumerate(matrix.rows[:3]):
                T[i, : len(row)] = [number(part, point) for part in row]
    return T


def _origin(T: Any) -> tuple[float, float, float]:
    return float(T[0, 3]), float(T[1, 3]), float(T[2, 3])
