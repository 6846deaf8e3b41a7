"""A motion: the matrices of its moves, their product, and how fast they turn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import sympy

from derive.audit import orientation, turning
from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.points import Point
from derive.audit.poses import UNIT, after, homogeneous, moved, turned
from derive.audit.putting_back import put_back
from derive.expression import free_symbols
from derive.mechanics.motion import Motion


def angles(motion: Motion) -> frozenset[str]:
    """The names that it turns by."""
    turns = (move.by for move in motion.moves if move.kind == "rotate")
    return frozenset().union(*map(free_symbols, turns))


def pose(asked: Asked, point: Point) -> sympy.Matrix:
    """T (4 by 4)."""
    return after(asked.subject.moves, asked)


def rotation_matrix(asked: Asked, point: Point) -> Iterator[Test]:
    """R and its factors in the order of the motion, translations left out."""
    yield Same("R", point.each(pose(asked, point)[:3, :3]))
    for k, move in enumerate((m for m in asked.subject.moves if m.kind == "rotate"), 1):
        yield Same(f"R_{k}", point.each(moved(move, asked)[:3, :3]))


def transform(asked: Asked, point: Point) -> Iterator[Test]:
    """T and its factors."""
    yield Same("T", point.each(pose(asked, point)))
    for k, move in enumerate(asked.subject.moves, 1):
        yield Same(f"A_{k}", point.each(moved(move, asked)))


def _names(asked: Asked) -> frozenset[str]:
    """Those that the moves are by."""
    return frozenset().union(*(free_symbols(move.by) for move in asked.subject.moves))


def equivalent_sequences(asked: Asked, point: Point) -> Iterator[Test]:
    """Each makes the same pose; all moves about current axes, and all about those of the world, are there."""
    T, ways = pose(asked, point), [_abouts(_plain(asked.subject))]
    told: Any = asked.results["sequences"]
    for moves in told:
        again = sympy.eye(4)
        for move in moves:
            step = _told(move, asked)
            again = step * again if move["about"] == "world" else again * step
        ways.append(_abouts(moves))
        yield put_back("sequences", point, again, T, f"the sequence {moves} ends elsewhere")
    for about in ("current", "world"):
        found = any(each <= {about} for each in ways)
        yield Holds("sequences", found, f"one of them has every move about {about} axes")


def _plain(motion: Motion) -> list[Mapping[str, Any]]:
    return [{"about": move.about} for move in motion.moves]


def _abouts(moves: list[Mapping[str, Any]]) -> set[str]:
    """About which axes the moves after the first are; for the first both are the same."""
    return {move["about"] for move in moves[1:]}


def _told(told: Mapping[str, Any], asked: Asked) -> sympy.Matrix:
    """T (4 by 4) of a move in the words of an answer."""
    kind = "rotate" if "rotate" in told else "translate"
    axis, by = told[kind], asked.read(told["by"])
    parts = UNIT[axis] if isinstance(axis, str) else tuple(asked.read(axis))
    unit = list(sympy.Matrix(parts) / sympy.sqrt(sum(part**2 for part in parts)))
    if kind == "rotate":
        return homogeneous(turned(unit, by))
    return homogeneous(sympy.eye(3), [part * by for part in unit])


KINDS = {
    "rotation-matrix": rotation_matrix,
    "transform": transform,
    "equivalent-sequences": equivalent_sequences,
    **orientation.kinds(pose),
    **turning.kinds(pose, _names),
}
