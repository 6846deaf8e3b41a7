"""What the names of frames mean in numbers, read off their indices: T_2^1 is frame 2 seen from frame 1."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any

from derive.algebra.numbers.floats import Point
from derive.expression import Expr, Indexed, Symbol, walk
from derive.kinds.frames._frames import factor
from derive.kinds.meanings import Chain, Names, as_told, column_of, skew_of
from derive.kinds.work import Work
from derive.mechanics.frame_places import in_the_world, seen
from derive.mechanics.frames import Frames
from derive.mechanics.motion import Motion
from derive.mechanics.oracle import made

POSE = re.compile(r"([TRo])_(\d+)\^(\d+)")
AXIS = re.compile(r"([xyz])_(\d+)")
COORDINATES = re.compile(r"([A-Za-z]\w*)\^(\d+)")
InFrame = Callable[[int, Point], Any]  # the coordinates of a quantity in a frame


def frames_told(
    work: Work,
    frames: Frames,
    chains: Iterable[Chain] = (),
    quantity: InFrame | None = None,
    others: Callable[[Point], Names] = lambda at: {},
) -> Work:
    """With the claim that every line, and `chains` told beside them, holds in numbers, each name by its
    indices; that of a `quantity`, v^2, by its frame."""
    chains = tuple(chains)
    every = (*(inner.chain for step in work.steps for inner in step.all()), *chains)
    used = {node for chain in every for each in chain for node in walk(each)}

    def meant(at: Point) -> Names:
        found: dict[Expr, Any] = {}
        for name in used:
            if isinstance(name, Symbol) and name.name in at:  # the author's own
                continue
            if isinstance(name, Symbol) and (value := _named(name.name, frames, quantity, at)) is not None:
                found[name] = value
            if isinstance(name, Indexed) and name.base == "S" and isinstance(name.lower[0], Symbol):
                found[name] = skew_of(_named(name.lower[0].name, frames, quantity, at))
        return {**found, **_moves(frames, at), **others(at)}

    return as_told(work, meant, chains)


def _named(name: str, frames: Frames, quantity: InFrame | None, at: Point) -> Any:
    if pose := POSE.fullmatch(name):
        T = seen(frames, int(pose[2]), int(pose[3]), at)
        return {"T": T, "R": T[:3, :3], "o": T[:3, 3:]}[pose[1]]
    if axis := AXIS.fullmatch(name):
        return column_of(in_the_world(frames, int(axis[2]), at)[:3, "xyz".index(axis[1])])
    if quantity and (coordinates := COORDINATES.fullmatch(name)):
        return column_of(quantity(int(coordinates[2]), at))
    return None


def _moves(frames: Frames, at: Point) -> Names:
    """Rot_{z, phi} and the like."""
    sources = (frame.source for frame in frames.frames)
    moves = (move for source in sources if isinstance(source, Motion) for move in source.moves)
    return {factor(move): made((move,), at) for move in moves}
