"""The entries of an array of Routh as quotients of determinants of Hurwitz, in numbers.

Gantmacher, The Theory of Matrices, volume 2, chapter XV, section 6: the first entry of row k + 1 is the k-th
leading minor of the matrix a_(2j - i) over the one before; the others have another last column in it.
"""

from __future__ import annotations

from collections.abc import Sequence


def entry(coefficients: Sequence[float], row: int, column: int) -> float | None:
    """Of the polynomial with these coefficients, highest power first; rows and columns count from 1. None
    where the minor below is zero, and no array goes on as usual."""
    import numpy

    if row == 1:
        return _coefficient(coefficients, 2 * (column - 1))
    size = row - 1
    columns = [*range(1, size), size - 1 + column]
    above = numpy.array([[_coefficient(coefficients, 2 * j - i) for j in columns] for i in range(1, row)])
    if size == 1:
        return float(above[0, 0])
    below = above[:-1, :-1]
    first = float(numpy.linalg.det(below))
    bound = float(numpy.prod(numpy.linalg.norm(below, axis=1)))
    if abs(first) <= 1e-12 * bound:
        return None
    return float(numpy.linalg.det(above)) / first


def _coefficient(coefficients: Sequence[float], place: int) -> float:
    return coefficients[place] if 0 <= place < len(coefficients) else 0.0
