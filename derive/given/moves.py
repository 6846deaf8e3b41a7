"""Moves in words: a rotation about an axis, a translation along one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from derive.algebra.formulas.with_units import measured
from derive.derivation import Phrase, Said
from derive.expression import MINUS_ONE, ZERO, Expr, Symbol, replace
from derive.given.datum import Datum, vector
from derive.mechanics.motion import Axis, Move


def moves_said(moves: Iterable[Move], variable: str | None = None) -> Iterator[Phrase]:
    """Each by itself; the name of a joint `variable` has its star."""
    star: dict[Expr, Expr] = {Symbol(variable): Symbol(f"{variable}*")} if variable else {}
    for move in moves:
        axis = Phrase("world-axis" if move.about == "world" else "own-axis", {"axis": axis_said(move.axis)})
        yield Phrase(move.kind, {"by": measured(replace(move.by, star)), "axis": axis})


def moved(
    key: str, moves: Sequence[Move], about: Mapping[str, Said] | None = None, variable: str | None = None
) -> Datum:
    """What is moved, in the words of `key`, or of `key-one` for a single move, and the moves one by one."""
    said = Phrase(key if len(moves) > 1 else f"{key}-one", about or {})
    return Datum(said, items=(*moves_said(moves, variable),))


def axis_said(axis: Axis) -> Phrase:
    """`x-axis`, or a direction by its components."""
    if isinstance(axis, str):
        return Phrase("axis", {"letter": Symbol(axis)})
    for letter in "xyz":
        if axis == tuple(MINUS_ONE if letter == each else ZERO for each in "xyz"):
            return Phrase("axis", {"letter": -Symbol(letter)})
    return Phrase("direction", {"vector": vector(axis)})
