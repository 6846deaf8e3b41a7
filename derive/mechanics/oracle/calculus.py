"""Differences and series: derivatives and exponentials of arrays, knowing nothing of what they are."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from derive.algebra.numbers.floats import Point
from derive.mechanics.oracle.values import Array

TERMS, HALVED = 13, 4  # of the exponential series, of entries below 1/16: the next adds less than 1e-16
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
    """e^X (n by n): 1 + Y + Y^2/2 + ... of Y, X halved until it is small, squared as often."""
    import numpy as np

    halved = max(0, math.frexp(float(np.abs(X).max()))[1] + HALVED)
    term: Array = np.eye(len(X))
    total, Y = term, X / 2**halved
    for k in range(1, TERMS):
        term = term @ Y / k
        total = total + term
    for _ in range(halved):
        total = total @ total
    return total
