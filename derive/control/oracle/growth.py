"""How a function of s grows near the origin and far away: its degree without its coefficients."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable

CLEAR = 0.02  # of a whole number
FIRST, FURTHER, TIMES = 1e3, 1e2, 5  # places that are looked at


def degree(function: Callable[[complex], complex], inward: bool = False) -> int | None:
    """The n of s^n that it behaves as far away, or close to the origin where it looks `inward`; None where it
    vanishes or no power of s is seen."""
    size = FIRST
    for _ in range(TIMES):
        s = cmath.rect(1 / size if inward else size, 0.7)
        near, far = abs(function(s)), abs(function(2 * s))
        if not near or not far or not math.isfinite(near * far):
            return None
        power = math.log2(far / near)
        if abs(power - round(power)) < CLEAR:
            return round(power)
        size *= FURTHER
    return None
