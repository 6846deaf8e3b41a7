"""Differences and series: derivatives and exponentials of arrays, knowing nothing of what they are."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from derive.algebra.numbers.floats import Point
from derive.mechanics.oracle.values import Array

TERMS = 60  # of the exponential series; far more than angles of a few radians need
NOTHING = 1e-20  # that a term adds, and all after it
STEP = 1e-6  # of differences; their error is about 1e-10


def slope(
    value: Callable[[Point], Array], at: Point, rates: Mapping[str, float], step: float = STEP
) -> Array:
    """How fast a value (an array) changes where the names change at these rates, by central differences."""
    ahead, behind = (
        value({**at, **{name: at[name] + h * rate for name, rate in rates.items()}}) for h in (step, -step)
    )
    return (ahead - behind) / (2 * step)


def vee(S: Array) -> list[float]:
    """The vector (3) of a skew-symmetric matrix, or of that in the corner of a twist."""
    return [S[2, 1], S[0, 2], S[1, 0]]


def exponential(X: Array) -> Array:
    """e^X (n by n), 1 + X + X^2/2 + ..."""
    import numpy as np

    term: Array = np.eye(len(X))
    total = term
    for k in range(1, TERMS):
        term = term @ X / k
        total = total + term
        if np.abs(term).max() < NOTHING:
            break
    return total
