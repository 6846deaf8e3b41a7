"""Moves in words: a rotation about an axis, a translation along one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from derive.algebra.formulas.with_units import measured
from derive.derivation import Phrase
from derive.expression import MINUS_ONE, ZERO, Expr, Symbol, replace
from derive.given.datum import vector
from derive.mechanics.motion import Axis, Move


def moves_said(moves: Iterable[Move], variable: str | None = None) -> Iterator[Phrase]:
    """Each by itself; the name of a joint `variable` has its star."""
    star: dict[Expr, Expr] = {Symbol(variable): Symbol(f"{variable}*")} if variable else {}
    for move in moves:
        axis = Phrase("world-axis" if move.about == "world" else "own-axis", {"axis": axis_said(move.axis)})
        yield Phrase(move.kind, {"by": measured(replace(move.by, star)), "axis": axis})


def axis_said(axis: Axis) -> Phrase:
    """`x-axis`, or a direction by its components."""
    if isinstance(axis, str):
        return Phrase("axis", {"letter": Symbol(axis)})
    for letter in "xyz":
        if axis == tuple(MINUS_ONE if letter == each else ZERO for each in "xyz"):
            return Phrase("axis", {"letter": -Symbol(letter)})
    return Phrase("direction", {"vector": vector(axis)})
