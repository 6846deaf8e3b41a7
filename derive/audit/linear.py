"""Linear algebra of matrices of numbers, fractions or numbers of 60 digits, by Gauss's elimination."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

import mpmath

from derive.audit.budget import spend
from derive.audit.points import Number, floating

Rows: TypeAlias = Sequence[Sequence[Number]]
NOTHING = mpmath.mpf(10) ** -30  # what a number of 60 digits is that should be zero


def eliminated(rows: Rows, columns: int) -> tuple[list[list[Number]], list[int], Number]:
    """Reduced rows, the columns of their pivots, and the product of the pivots with the sign of the swaps."""
    left, pivots = [list(row) for row in rows], list[int]()
    product: Number = Fraction(1)
    size = max((abs(floating(entry)) for row in left for entry in row), default=mpmath.mpf(0))
    for column in range(columns):
        at = len(pivots)
        best = max(range(at, len(left)), key=lambda i: abs(left[i][column]), default=None)
        if best is None or is_zero(left[best][column], size):
            continue
        if best != at:
            left[at], left[best], product = left[best], left[at], -product
        pivot = left[at][column]
        product = product * pivot
        left[at] = [entry / pivot for entry in left[at]]
        for i, row in enumerate(left):
            if i != at and row[column]:
                spend(len(row))
                left[i] = [a - row[column] * b for a, b in zip(row, left[at], strict=True)]
        pivots.append(column)
    return left, pivots, product


def is_zero(number: Number, size: Number = 1) -> bool:
    """Whether a number is none beside others of this size."""
    return bool(abs(floating(number)) <= NOTHING * max(abs(floating(size)), mpmath.mpf(10) ** -20))


def rank(rows: Rows) -> int:
    """Of a matrix of numbers."""
    return len(eliminated(rows, len(rows[0]))[1])


def det(rows: Rows) -> Number:
    """Of a square matrix."""
    _, pivots, product = eliminated(rows, len(rows))
    return product if len(pivots) == len(rows) else 0


def solve(A: Rows, B: Rows) -> list[list[Number]]:
    """X with A X = B. Raises ZeroDivisionError where A has no inverse."""
    n = len(A)
    found, pivots, _ = eliminated([[*a, *b] for a, b in zip(A, B, strict=True)], n)
    if len(pivots) < n:
        raise ZeroDivisionError
    return [row[n:] for row in found]


def inverse(A: Rows) -> list[list[Number]]:
    """A^-1. Raises ZeroDivisionError."""
    return solve(A, [[int(i == j) for j in range(len(A))] for i in range(len(A))])


def transposed(A: Rows) -> list[list[Number]]:
    """A^T."""
    return [list(column) for column in zip(*A, strict=True)]


def product(A: Rows, B: Rows) -> list[list[Number]]:
    """A B."""
    return [
        [sum(a * b for a, b in zip(row, column, strict=True)) for column in zip(*B, strict=True)] for row in A
    ]
