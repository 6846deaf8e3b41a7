"""Laplace transforms inverted in numbers."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Complexes: TypeAlias = NDArray[Any]

EULER = 12  # terms averaged by Euler summation
DAMPING = 20.0  # e^-DAMPING is the error of the method


def inverted(transform: Callable[[Complexes], Complexes], times: Complexes, terms: int) -> Complexes:
    """f at times after 0 from its Laplace transform, which is asked at arrays of s (Abate and Whitt, ORSA J.
    Computing 7, 1995: EULER).

    `terms` should exceed the fastest frequency of f times the last time; the poles must lie left of
    DAMPING / (2 time).
    """
    import numpy as np

    k = np.arange(terms + EULER + 1)
    s = (DAMPING + 2j * math.pi * k)[None, :] / (2 * times[:, None])
    parts = np.where(k % 2, -1.0, 1.0)[None, :] * transform(s).real
    parts[:, 0] /= 2
    sums = np.cumsum(parts, axis=1)[:, terms:]
    weights = np.array([math.comb(EULER, k) for k in range(EULER + 1)]) / 2.0**EULER
    found: Complexes = np.exp(DAMPING / 2) / times * (sums @ weights)
    return found
