"""One thing that is given, and what a text must hold to say it by itself."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias, get_args

from derive.algebra.formulas.quantities import rational
from derive.algebra.formulas.with_units import measured, unit_of
from derive.derivation import Phrase, Said, Table
from derive.expression import Expr, Matrix, Relation, Symbol, column, number

TREES = get_args(Expr)
Chain: TypeAlias = tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Datum:
    """A sentence, or what leads to a `table`, to `equations` (chains of trees each equal to the next) or to
    `items`.

    A text says it where it has all its names and numbers and, of each entry of `words`, one of the
    alternatives that stand between bars: "revolute|hinge". Names that are `ours` it need not have. Its
    words are those of the subject in `room`, where that is not the subject of the problem.
    """

    said: Phrase
    table: Table | None = None
    equations: tuple[Chain, ...] = ()
    items: tuple[Phrase, ...] = ()
    words: tuple[str, ...] = ()
    ours: frozenset[str] = frozenset()
    room: str = ""

    def trees(self) -> Iterator[Expr]:
        """The mathematics in it, but for the headings of its table; a count is a number too."""
        rows = self.table.rows if self.table else ()
        yield from _trees((self.said, rows, self.equations, self.items))


def _trees(part: Any) -> Iterator[Expr]:
    match part:
        case Phrase(about=about):
            yield from _trees(tuple(about.values()))
        case Relation(left, _, right):
            yield from _trees((left, right))
        case tuple():
            for each in part:
                yield from _trees(each)
        case int():
            yield number(part)
        case _ if isinstance(part, TREES):
            yield part


def vector(parts: Sequence[Expr], unit: str = "") -> Expr:
    """A column, with the unit that its author gave it."""
    return measured(column(parts), unit or next(filter(None, map(unit_of, parts)), ""))


def as_typed(matrix: Matrix, places: int) -> Matrix:
    """A matrix whose rotation its author rounded to so many places (0: to none), as it was typed."""

    def rounded(i: int, j: int, entry: Expr) -> Expr:
        value = rational(entry) if places and max(i, j) < 3 else None
        return entry if value is None else number(round(value, places), decimal=value.denominator > 1)

    rows = enumerate(matrix.rows)
    return Matrix(tuple(tuple(rounded(i, j, entry) for j, entry in enumerate(row)) for i, row in rows))


def valued(name: str | Expr, value: Expr) -> Relation:
    """`name = value`, with the unit that its author gave it."""
    return Relation(Symbol(name) if isinstance(name, str) else name, "=", measured(value))


def names(given: Iterable[str]) -> tuple[Said, ...]:
    """Names to be listed."""
    return tuple(Symbol(name) for name in given)
