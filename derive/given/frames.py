"""What is given of frames: their axes and origins as they are observed, their matrices, or their motions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Cell, Phrase, Table
from derive.expression import Expr, Symbol, add, column, free_symbols, multiply, number
from derive.given.datum import TREES, Datum, as_typed, vector
from derive.given.moves import moved
from derive.given.screws_held import Misgiven
from derive.kinds.checks import random_points
from derive.kinds.problem import Problem
from derive.mechanics.frames import ByMatrix, Frame, Frames, Observed
from derive.mechanics.motion import Motion

NEAR = 1e-9


def data(frames: Frames, problem: Problem) -> Iterator[Datum]:
    """A table of those that are observed, then each of the others. Raises Misgiven."""
    every = (*frames.frames, *frames.again)
    observed = [(frame, frame.source) for frame in every if isinstance(frame.source, Observed)]
    if observed:
        axes = map(Symbol, ("x_i", "y_i", "z_i"))
        headings: tuple[Cell, ...] = (Phrase("frame"), Phrase("seen-in"), *axes, Phrase("origin"))
        table = Table(headings, tuple(_line(*pair) for pair in observed))
        if not all(_is_observed(row, *pair) for row, pair in zip(table.rows, observed, strict=True)):
            raise Misgiven("the axes of a frame are not those that were typed")
        yield Datum(_observed([frame for frame, _ in observed]), table)
    for frame in every:
        about = {"frame": number(frame.number), "parent": number(frame.parent)}
        match frame.source:
            case ByMatrix(matrix, rounded):
                key = "matrix" if matrix.shape == (4, 4) else "rotation"
                yield Datum(Phrase(key, about), equations=((as_typed(matrix, rounded),),))
            case Motion(moves):
                yield moved("moved", moves, about)


def _is_observed(row: Sequence[Cell], frame: Frame, source: Observed) -> bool:
    """Whether each axis has the typed factor along each axis of the parent."""
    units = [{f"{a}{frame.parent}": float(a == b) for a in "xyz"} for b in "xyz"]
    names = frozenset[str]().union(*map(free_symbols, (*source.x, *source.y, *source.z)))
    (at,) = random_points(names, 1)
    pairs = (
        (cell, along, factor)
        for cell, axis in zip(row[2:5], (source.x, source.y, source.z), strict=True)
        for along, factor in zip(units, axis, strict=True)
    )
    near = 10.0**-source.rounded if source.rounded else NEAR
    return all(
        isinstance(cell, TREES) and abs(value_of(cell, {**at, **along}) - value_of(factor, at)) <= near
        for cell, along, factor in pairs
    )


def _observed(frames: Sequence[Frame]) -> Phrase:
    """That they have the axes and origins of a table."""
    match frames:
        case [frame]:
            return Phrase("observed-one", {"frame": str(frame.number), "parent": str(frame.parent)})
    return Phrase("observed")


def _line(frame: Frame, source: Observed) -> tuple[Cell, ...]:
    typed = (as_typed(column(axis), source.rounded) for axis in (source.x, source.y, source.z))
    axes = (_combined([factor for (factor,) in axis.rows], frame.parent) for axis in typed)
    return str(frame.number), str(frame.parent), *axes, vector(source.origin)


def _combined(factors: Sequence[Expr], parent: int) -> Expr:
    """The sum of the axes of the parent with these factors."""
    return add(
        *(multiply(factor, Symbol(f"{axis}{parent}")) for factor, axis in zip(factors, "xyz", strict=True))
    )
