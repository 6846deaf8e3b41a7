"""Frames drawn as triads of axes: where each stands, and the body that they stand on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Drawing, Phrase, Said, Stroke
from derive.expression import Expr, Symbol, free_symbols
from derive.figures import bodies
from derive.figures.arm import place_of
from derive.figures.arm_frames import LONG, arrows_drawn, pointing_at_reader, shared
from derive.figures.clear_views import clearest
from derive.figures.described import direction
from derive.figures.turn_arcs import turn_arcs
from derive.figures.typical import completed, typical
from derive.figures.view import Vector, View, in_space, length
from derive.figures.wish import Wish
from derive.mechanics.frames import ByMatrix, Frames, FrameSource, Observed
from derive.mechanics.motion import Motion, Move
from derive.mechanics.oracle import compose
from derive.mechanics.sequences import in_product_order

LOW = 165.0  # points: how high frames alone are drawn
SHARE, WITH_BODY = 0.4, 0.34  # of how far frames are apart: an axis, and one that stands on a body


def of_frames(frames: Frames, where: Mapping[str, Expr], wish: Wish) -> Drawing:
    """Every frame where it stands, and from which frame it is given; or the body on which they stand."""
    import numpy

    every = [move for frame in frames.frames for move in _moves(frame.source)]
    sizes = [part for frame in frames.frames for part in _origins(frame.source)]
    sizes += [part for corner in (wish.body.corners.values() if wish.body else ()) for part in corner]
    sizes += [size for _, _, size in (wish.body.lengths if wish.body else ())]
    point = completed(typical(every, sizes, where, ())[0] | wish_values(wish), where)
    poses = [numpy.eye(4)]
    for frame in frames.frames:
        poses.append(poses[frame.parent] @ _pose(frame.source, point))
    view = in_space() if wish.body else clearest(poses)
    numbers = range(len(poses))
    origins = {f"o{k}": place_of(T) for k, T in enumerate(poses)}
    size = apart(view, [*origins.values()], WITH_BODY if wish.body else SHARE)
    strokes: list[Stroke] = []
    captions: list[Caption] = []
    if wish.body:
        corners = bodies.corners_of(wish.body, origins, point)
        faces, edges = bodies.drawn(wish.body, corners, view)
        strokes += [*faces, *edges]
        captions += bodies.lengths(wish.body, corners, point, view)
        for arc, name in bodies.angles(wish.body, corners, point, view):
            strokes.append(arc)
            captions.append(name)
    else:
        strokes += _ways(_given(frames), origins, view)
    named = [(str(k), poses[k]) for k in numbers]
    arrows = [*arrows_drawn(view, shared(named, "xyz", size), size / LONG)]
    strokes += [stroke for stroke, _ in arrows]
    for arc, name in turn_arcs(frames, poses, point, view, size):
        strokes.append(arc)
        captions.append(name)
    signs = [*pointing_at_reader(view, shared(named, "xyz", size), size)]
    strokes += [stroke for sign, _ in signs for stroke in sign]
    texts = (*(text for _, text in (*arrows, *signs)), *origin_names(view, named), *captions)
    ways = sum(stroke.role == "way" for stroke in strokes)
    key = "frames-on-body" if wish.body else _called(ways, len(_given(frames)), len(frames.frames))
    about: dict[str, Said] = {"last": Symbol(f"o{len(poses) - 1}")}
    return Drawing(
        "figure",
        tuple(strokes),
        texts,
        Phrase(key, about),
        Phrase(
            "frames-on-body-seen" if wish.body else "frames-seen", {"frames": tuple(_seen(poses)), **about}
        ),
        0.0 if wish.body else LOW,
    )


def _given(frames: Frames) -> list[tuple[int, int]]:
    """The frames with those in which they are given, each pair once."""
    return [*dict.fromkeys((frame.parent, frame.number) for frame in (*frames.frames, *frames.again))]


def _ways(given: Sequence[tuple[int, int]], origins: Mapping[str, Vector], view: View) -> Iterator[Stroke]:
    """Lines between the origins of such pairs, where they are two places."""
    for parent, number_ in given:
        start, end = origins[f"o{parent}"], origins[f"o{number_}"]
        if start != end:
            yield Stroke((view.place(start), view.place(end)), "way")


def _called(ways: int, given: int, count: int) -> str:
    """What is said of so many frames and of the lines from where they are given, some in two frames."""
    if not ways:
        return "frames-together"
    if ways < given:
        return "frames-partly"
    return "frames-twice" if given > count else "frames" if count > 1 else "frames-two"


def wish_values(wish: Wish) -> dict[str, float]:
    """What the author wants the names to be in the figure."""
    return {name: number(value, {}) for name, value in wish.at.items()}


def apart(view: View, origins: Sequence[Vector], share: float) -> float:
    """How long axes are: a share of how far their origins are from each other on paper."""
    places = [view.place(origin) for origin in origins]
    gaps = [length((a[0] - b[0], a[1] - b[1])) for a, b in combinations(places, 2)]
    clear = [gap for gap in gaps if gap > 1e-9]
    return share * (sorted(clear)[len(clear) // 2] if clear else 1.0)


def origin_names(view: View, named: Sequence[tuple[str, Any]]) -> Iterator[Caption]:
    """o_0, o_1, ... where they are places of their own."""
    places = [place_of(T) for _, T in named]
    for (index, _), place in zip(named, places, strict=True):
        if sum(max(abs(a - b) for a, b in zip(place, other, strict=True)) < 1e-9 for other in places) == 1:
            yield Caption(view.place(place), Symbol(f"o_{index}"), (-0.3, -1.0), "origin")


def _seen(poses: Sequence[Any]) -> Iterator[Phrase]:
    """Where the axes of each frame point that are along those of frame 0."""
    for number_, pose in enumerate(poses):
        ways = [direction((pose[0][k], pose[1][k], pose[2][k])) for k in range(3)]
        if number_ and all(ways):
            about: dict[str, Said] = {}
            for letter, way in zip("xyz", ways, strict=True):
                about |= {letter: Symbol(f"{letter}{number_}"), f"{letter}_way": way or ""}
            yield Phrase("axes", about)
        elif number_:
            yield Phrase("turned", {"number": number_})


def _moves(source: FrameSource) -> tuple[Move, ...]:
    """The moves of a motion; of axes that hold names, turns by these."""
    match source:
        case Motion(moves):
            return moves
        case Observed():
            entries = [*source.x, *source.y, *source.z]
        case ByMatrix(matrix):
            entries = [entry for row in matrix.rows[:3] for entry in row[:3]]
    names = frozenset().union(*map(free_symbols, entries))
    return tuple(Move("rotate", "z", Symbol(name)) for name in sorted(names))


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
