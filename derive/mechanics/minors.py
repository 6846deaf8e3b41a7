"""Minors of matrices of scalars, each made once from smaller ones, within a budget that is counted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.mechanics.budget import Budget


@dataclass(frozen=True, slots=True, eq=False)
class Minor:
    """A minor of full size and the rows or columns it is made of."""

    lines: tuple[int, ...]
    value: Scalar


def minors(J: ScalarMatrix, budget: Budget | None = None) -> tuple[Minor, ...]:
    """All minors of full size: of columns where there are more of them than rows, else of rows.
    Raises TooLong."""
    lines = J.T if J.shape[0] < J.shape[1] else J
    return tuple(maximal_minors(lines, budget))


def maximal_minors(tall: ScalarMatrix, budget: Budget | None = None) -> Iterator[Minor]:
    """Those of all columns of an m by r matrix, r <= m, of each choice of rows: a column at a time."""
    m, r = tall.shape
    found: dict[tuple[int, ...], Scalar] = {(): Scalar(tall.ring, tall.ring.one)}
    for size in range(1, r + 1):
        column = [row[size - 1] for row in tall.rows]
        found = {rows: _expanded(column, rows, found, budget) for rows in combinations(range(m), size)}
    return (Minor(rows, value) for rows, value in found.items())


def minor_of(J: ScalarMatrix, rows: Sequence[int], columns: Sequence[int], budget: Budget) -> Scalar:
    """That of some rows and as many columns. Raises TooLong."""
    square = ScalarMatrix(tuple(tuple(J.rows[i][j] for j in columns) for i in rows))
    (minor,) = maximal_minors(square, budget)
    return minor.value


def _expanded(
    column: Sequence[Scalar],
    rows: tuple[int, ...],
    smaller: Mapping[tuple[int, ...], Scalar],
    budget: Budget | None,
) -> Scalar:
    """Along the last column."""
    home = column[0].ring
    total, last = home.zero, len(rows) - 1
    for k, i in enumerate(rows):
        entry, rest = column[i], smaller[rows[:k] + rows[k + 1 :]]
        if entry and rest:
            if budget:
                budget.spend(len(entry.numerator) * len(rest.numerator))
            product = (entry * rest).numerator
            total = total - product if (last - k) % 2 else total + product
    return Scalar(home, home.reduce(total))
