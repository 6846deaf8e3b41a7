"""A second route to stationary points: Newton's method from random starts, derivatives by differences."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from typing import Any

STEPS = 40
STARTS = 16
SPREAD = 3.0
SHIFT = 1e-3
FOUND = 1e-9
NEAR = 1e-4


def stationary(function: Callable[[Sequence[float]], float], size: int) -> list[list[float]]:
    """Points where the gradient of a function of `size` numbers vanishes; those that were found."""
    import numpy as np

    draw = random.Random(size)
    found: list[Any] = []
    for _ in range(STARTS):
        at = np.array([draw.uniform(-SPREAD, SPREAD) for _ in range(size)])
        for _ in range(STEPS):
            try:
                slope, curvature = _derivatives(function, at)
                step = np.linalg.lstsq(curvature, slope, rcond=None)[0]
            except (ArithmeticError, ValueError):
                break
            at = at - step * min(1.0, 2.0 / max(1e-9, float(np.linalg.norm(step))))
            if np.linalg.norm(step) < FOUND * (1 + np.linalg.norm(at)) ** 2:
                if np.linalg.norm(slope) < NEAR**2 and not any(np.allclose(at, f, atol=NEAR) for f in found):
                    found.append(at)
                break
            if np.linalg.norm(at) > 1e3:
                break
    return [list(map(float, each)) for each in found]


def _derivatives(function: Callable[[Sequence[float]], float], at: Any) -> tuple[Any, Any]:
    """Gradient and Hessian by central differences of fourth order."""
    import numpy as np

    size = len(at)
    unit = np.eye(size) * SHIFT

    def f(shift: Any) -> float:
        return function(at + shift)

    slope = np.array([(8 * (f(u) - f(-u)) - (f(2 * u) - f(-2 * u))) / (12 * SHIFT) for u in unit])
    curvature = np.zeros((size, size))
    for i in range(size):
        for j in range(i, size):
            u, v = unit[i], unit[j]
            mixed = (f(u + v) - f(u - v) - f(v - u) + f(-u - v)) / (4 * SHIFT**2)
            curvature[i, j] = curvature[j, i] = mixed
    return slope, curvature
