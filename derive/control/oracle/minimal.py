"""How many states of a system its input drives and its output shows, counted exactly modulo a prime."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

PRIME = 2**61 - 1
Rows = Sequence[Sequence[Fraction]]


def order(A: Rows, B: Rows, C: Rows) -> int:
    """The rank of the square of C A^(i + j) B (Ho and Kalman)."""
    a, b, c = ([[_residue(x) for x in row] for row in matrix] for matrix in (A, B, C))
    n, seen, state = len(a), list[int](), [row[0] for row in b]
    for _ in range(2 * n - 1):
        seen.append(_dot(c[0], state))
        state = [_dot(row, state) for row in a]
    return _rank([seen[k : k + n] for k in range(n)])


def _residue(x: Fraction) -> int:
    return x.numerator * pow(x.denominator, -1, PRIME) % PRIME


def _dot(left: Sequence[int], right: Sequence[int]) -> int:
    return sum(x * y for x, y in zip(left, right, strict=True)) % PRIME


def _rank(rows: list[list[int]]) -> int:
    rank = 0
    for column in range(len(rows)):
        pivot = next((k for k in range(rank, len(rows)) if rows[k][column]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        inverse = pow(rows[rank][column], -1, PRIME)
        for k in range(rank + 1, len(rows)):
            factor = rows[k][column] * inverse
            rows[k] = [(x - factor * y) % PRIME for x, y in zip(rows[k], rows[rank], strict=True)]
        rank += 1
    return rank
