"""Sines and cosines together, as pairs (cosine, sine)."""

from __future__ import annotations

from functools import reduce
from typing import TypeAlias

from derive.algebra.scalar import Scalar

Pair: TypeAlias = tuple[Scalar, Scalar]


def added(a: Pair, b: Pair) -> Pair:
    """Of the sum of two angles, by the addition theorem."""
    return a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]


def multiple(pair: Pair, n: int) -> Pair:
    """Of n times the angle."""
    base = pair if n >= 0 else (pair[0], -pair[1])
    return reduce(added, [base] * abs(n), (Scalar.of(1), Scalar.of(0)))
