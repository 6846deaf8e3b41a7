"""What a matrix makes of vectors: its rank by Gauss's elimination, and the spaces that follow from it."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import TooLong
from derive.algebra.solving.row_reduction import eliminated, null_space
from derive.errors import NotDerivable

TOO_LONG = "the elimination comes to formulas that are too long; give more values under evaluate"


@dataclass(frozen=True, slots=True)
class Span:
    """Of J (m by n): its rank r, the reduced echelon form with its rows of zeros left out (r by n) and the
    columns of its pivots; bases of null space (n by 1 each), range and left null space (m by 1 each), the
    second made of the columns of J with a pivot. The rank is r wherever none of the `leads` vanishes."""

    rank: int
    reduced: ScalarMatrix | None
    pivots: tuple[int, ...]
    leads: tuple[Scalar, ...]
    null: tuple[ScalarMatrix, ...]
    range: tuple[ScalarMatrix, ...]
    left: tuple[ScalarMatrix, ...]


def span(J: ScalarMatrix, variables: tuple[str, ...]) -> Span:
    """The spaces of J; `variables` stand in its sines and cosines. Raises NotDerivable where they are too
    long to be written."""
    try:
        found = eliminated(J)
        reduced = ScalarMatrix.of(found.rows.rows[: found.rank]) if found.rank else None
        image = tuple(J.columns(j) for j in found.pivots)
        spaces = (null_space(J, variables), image, null_space(J.T, variables))
        return Span(found.rank, reduced, found.pivots, found.leads, *spaces)
    except TooLong as error:
        raise NotDerivable(TOO_LONG) from error


def solution(J: ScalarMatrix, v: ScalarMatrix) -> ScalarMatrix | None:
    """One x (n by 1) with J x = v (m by 1), zero where no pivot stands; None where there is none at a general
    point. Raises NotDerivable where it is too long."""
    n = J.shape[1]
    try:
        found = eliminated(ScalarMatrix.beside([J, v]))
    except TooLong as error:
        raise NotDerivable(TOO_LONG) from error
    if n in found.pivots:
        return None
    x = [Scalar.of(0)] * n
    for row, column in enumerate(found.pivots):
        x[column] = found.rows[row, n]
    return ScalarMatrix.column(x)
