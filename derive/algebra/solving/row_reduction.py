"""Rank, null space and range of a matrix of scalars, exactly, by Gauss's elimination.

The rank is that at a general point: a pivot is what is not identically zero.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import TooLong, primitive_column

MOST_TERMS = 60  # in one entry; nobody reads what comes of longer ones


@dataclass(frozen=True, slots=True)
class Eliminated:
    """The reduced row echelon form of a matrix, the columns of its pivots, and what these were divided by:
    where none of those is zero the rank is that at a general point."""

    rows: ScalarMatrix
    pivots: tuple[int, ...]
    leads: tuple[Scalar, ...] = ()

    @property
    def rank(self) -> int:
        """The rank at a general point, which is the number of pivots."""
        return len(self.pivots)


def eliminated(matrix: ScalarMatrix) -> Eliminated:
    """The reduced row echelon form, by the shortest pivot of each column. Raises TooLong where an entry
    outgrows what anyone reads."""
    rows = [list(row) for row in matrix.rows]
    pivots: list[int] = []
    leads: list[Scalar] = []
    for column in range(matrix.shape[1]):
        top = len(pivots)
        candidates = [r for r in range(top, len(rows)) if rows[r][column]]
        if not candidates:
            continue
        best = min(candidates, key=lambda r: _length(rows[r][column]))
        rows[top], rows[best] = rows[best], rows[top]
        lead = rows[top][column]
        rows[top] = [entry / lead if entry else entry for entry in rows[top]]
        for r, row in enumerate(rows):
            if r != top and row[column]:
                factor = row[column]
                rows[r] = [a - factor * b if b else a for a, b in zip(row, rows[top], strict=True)]
        if any(_length(entry) > MOST_TERMS for row in rows for entry in row):
            raise TooLong
        pivots.append(column)
        leads.append(lead)
    return Eliminated(ScalarMatrix.of(rows), tuple(pivots), tuple(leads))


def rank(matrix: ScalarMatrix) -> int:
    """The rank at a general point. Raises TooLong."""
    return eliminated(matrix).rank


def null_space(matrix: ScalarMatrix, names: Iterable[str]) -> tuple[ScalarMatrix, ...]:
    """A basis of the columns x (n by 1) with matrix @ x = 0, without fractions; `names` are the joint
    variables. Raises TooLong."""
    found = eliminated(matrix)
    names = tuple(names)
    free = [j for j in range(matrix.shape[1]) if j not in found.pivots]
    return tuple(primitive_column(_solution(found, j, matrix.shape[1]), names) for j in free)


def column_space(matrix: ScalarMatrix, names: Iterable[str]) -> tuple[ScalarMatrix, ...]:
    """A basis of the range: the columns (m by 1) of the pivots, without common factors. Raises TooLong."""
    names = tuple(names)
    return tuple(primitive_column(matrix.columns(j), names) for j in eliminated(matrix).pivots)


def _solution(found: Eliminated, free: int, size: int) -> ScalarMatrix:
    entries = [Scalar.of(0)] * size
    entries[free] = Scalar.of(1)
    for row, column in enumerate(found.pivots):
        entries[column] = -found.rows[row, free]
    return ScalarMatrix.column(entries)


def _length(entry: Scalar) -> int:
    return len(entry.numerator) + (0 if entry.denominator is None else len(entry.denominator))
