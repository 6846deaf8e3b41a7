"""Frames: each seen from the world by way of its parents, and from any other by way of the world."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from derive.audit import orientation
from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.points import Point
from derive.audit.poses import local, seen_from
from derive.audit.putting_back import put_back
from derive.expression import free_symbols
from derive.mechanics.frames import Frames
from derive.mechanics.motion import Motion


def angles(frames: Frames) -> frozenset[str]:
    """The names that frames are turned by."""
    sources = (frame.source for frame in (*frames.frames, *frames.again))
    moves = (move for source in sources if isinstance(source, Motion) for move in source.moves)
    return frozenset().union(*(free_symbols(move.by) for move in moves if move.kind == "rotate"))


def pose(asked: Asked, point: Point) -> sympy.Matrix:
    """T (4 by 4) of the frame `from`, the last one if left out, seen from `to`."""
    source = asked.options.source
    last = len(asked.subject.frames) if source is None else source
    return seen_from(asked.subject, last, asked.options.target, asked)


def transform(asked: Asked, point: Point) -> Iterator[Test]:
    """The one pose."""
    for name in asked.results:
        yield Same(name, point.each(pose(asked, point)))


def transforms(asked: Asked, point: Point) -> Iterator[Test]:
    """T_i^j is what its indices say."""
    for name in asked.results:
        source, target = name.removeprefix("T_").split("^")
        yield Same(name, point.each(seen_from(asked.subject, int(source), int(target), asked)))
    given = {f"T_{frame.number}^{frame.parent}" for frame in asked.subject.frames}
    wanted = given | {f"T_{len(asked.subject.frames)}^0"}
    for name in sorted(wanted - asked.results.keys()):
        yield Holds(name, False, "a frame of the sheet")


def change_of_frame(asked: Asked, point: Point) -> Iterator[Test]:
    """R v; R p + o; and of a twist R v + o x R omega above R omega."""
    T, options = pose(asked, point), asked.options
    R, o = T[:3, :3], T[:3, 3]
    given = sympy.Matrix([asked.formula(part) for part in options.vector or options.point or options.twist])
    if options.twist:
        v, omega = R * given[:3, :], R * given[3:, :]
        found = [*(v + o.cross(omega)), *omega]
    else:
        found = list(R * given + (o if options.point else sympy.zeros(3, 1)))
    for name in asked.results:
        yield Same(name, point.each(found))


def loop(asked: Asked, point: Point) -> Iterator[Test]:
    """A frame given again: the pose found first times E is the pose given again."""
    frames, closed = asked.subject, []
    for k, frame in enumerate(frames.again, 1):
        name = "E" if len(frames.again) == 1 else f"E_{k}"
        E = sympy.Matrix(asked.result(name))
        first, again = seen_from(frames, frame.number, frame.parent, asked), local(frame, asked)
        yield put_back(name, point, first * E, again, "it does not lead from the first pose to the second")
        closed.append("yes" if put_back(name, point, first, again, "").holds else "no")
    yield Holds("closes", asked.results["closes"] == ", ".join(closed), ", ".join(closed))


KINDS = {
    "transform": transform,
    "transforms": transforms,
    "change-of-frame": change_of_frame,
    "loop": loop,
    **orientation.kinds(pose),
}
