"""Whether a matrix is right but for the places of its rows or columns."""

from __future__ import annotations

from derive.answers.comparing import proved
from derive.answers.diagnosing import COLUMNS, ROWS, TRANSPOSED
from derive.answers.terms import Terms
from derive.expression import Expr, Matrix

MOST = 12  # rows or columns


def moved(theirs: Matrix, ours: Matrix, terms: Terms) -> str:
    """What was done to the whole of a matrix, in a word or two; nothing where that is not it."""
    if same(theirs, ours, terms):
        return ""
    if turned(theirs, ours, terms):
        return TRANSPOSED
    if _reordered(theirs, ours, terms):
        return ROWS
    other = transposed(theirs), transposed(ours)
    return COLUMNS if _reordered(*other, terms) else ""


def turned(theirs: Matrix, ours: Matrix, terms: Terms) -> bool:
    """Whether it is the transpose of what it should be."""
    other = transposed(theirs)
    return other.shape == ours.shape and other != theirs and same(other, ours, terms)


def same(theirs: Matrix, ours: Matrix, terms: Terms) -> bool:
    """Whether matrices of one shape are equal in every entry."""
    return all(map(_equal, theirs.rows, ours.rows, [terms] * len(ours.rows)))


def transposed(matrix: Expr) -> Matrix:
    """The transpose of a matrix."""
    assert isinstance(matrix, Matrix)
    return Matrix(tuple(zip(*matrix.rows, strict=True)))


def _reordered(theirs: Matrix, ours: Matrix, terms: Terms) -> bool:
    """Whether it has the right rows in another order."""
    if not 1 < len(ours.rows) <= MOST:
        return False
    left = list(ours.rows)
    for row in theirs.rows:
        found = next((right for right in left if _equal(row, right, terms)), None)
        if found is None:
            return False
        left.remove(found)
    return True


def _equal(row: tuple[Expr, ...], right: tuple[Expr, ...], terms: Terms) -> bool:
    return all(proved(one, other, terms) for one, other in zip(row, right, strict=True))
