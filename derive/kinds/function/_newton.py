"""A second route to stationary points: Newton's method from random starts, derivatives by differences."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from typing import Any

from derive.algebra.fold import Domain, fold
from derive.expression import Expr

STEPS = 30
STARTS = 12
SPREAD = 3.0
SHIFT = 1e-3
BESIDE = 0.05
LONGEST = 2.0  # of one step
FOUND = 1e-9
NEAR = 1e-4


def stationary(
    tree: Expr, known: Mapping[str, float], names: Sequence[str], near: Sequence[Sequence[float]] = ()
) -> list[list[float]]:
    """Points where the gradient of a tree by some names vanishes, the others being known; those that
    were found from a few starts and from some close to places that are `near`, all of which walk at once."""
    import numpy as np

    draw = random.Random(len(names))
    starts = [[draw.uniform(-SPREAD, SPREAD) for _ in names] for _ in range(STARTS)]
    at = np.array(starts + [[x + draw.uniform(-BESIDE, BESIDE) for x in place] for place in near])
    shifts = _shifts(len(names))

    def values(points: Any) -> Any:
        columns = {name: points[..., k] for k, name in enumerate(names)}
        return np.broadcast_to(fold(tree, Arrays({**known, **columns})), points.shape[:-1])

    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            slope, curvature = _derivatives(values(at[:, None, :] + shifts), len(names))
            usable = np.isfinite(slope).all(axis=1) & np.isfinite(curvature).all(axis=(1, 2))
            at, slope, curvature = at[usable], slope[usable], curvature[usable]
            if not len(at):
                return []
            step = (np.linalg.pinv(curvature, rcond=1e-10) @ slope[..., None])[..., 0]
            length = np.linalg.norm(step, axis=1, keepdims=True)
            at = at - step * np.minimum(1.0, LONGEST / np.maximum(length, 1e-12))
        slope, _ = _derivatives(values(at[:, None, :] + shifts), len(names))
    still = (np.linalg.norm(slope, axis=1) < NEAR**2) & (length[:, 0] < FOUND * 1e3)
    return _distinct(at[still].tolist())


def _distinct(points: list[list[float]]) -> list[list[float]]:
    found: list[list[float]] = []
    for point in points:
        if not any(all(abs(a - b) < NEAR for a, b in zip(point, each, strict=True)) for each in found):
            found.append(point)
    return found


def _shifts(size: int) -> Any:
    """Along each axis by 1, -1, 2 and -2 steps, then by one step along two axes with every sign."""
    import numpy as np

    unit = np.eye(size) * SHIFT
    single = [k * u for u in unit for k in (1, -1, 2, -2)]
    mixed = [s * unit[i] + t * unit[j] for i, j in combinations(range(size), 2) for s, t in _SIGNS]
    return np.array([np.zeros(size), *single, *mixed])


_SIGNS = ((1, 1), (1, -1), (-1, 1), (-1, -1))


def _derivatives(f: Any, size: int) -> tuple[Any, Any]:
    """Gradients and Hessians from the values at the shifts, a row for each point."""
    import numpy as np

    single = f[:, 1 : 1 + 4 * size].reshape(len(f), size, 4)
    one, less, two, lesser = np.moveaxis(single, 2, 0)
    slope = (8 * (one - less) - (two - lesser)) / (12 * SHIFT)
    curvature = np.zeros((len(f), size, size))
    diagonal = (one - 2 * f[:, :1] + less) / SHIFT**2
    curvature[:, range(size), range(size)] = diagonal
    mixed = f[:, 1 + 4 * size :].reshape(len(f), -1, 4)
    for place, (i, j) in enumerate(combinations(range(size), 2)):
        a, b, c, d = np.moveaxis(mixed[:, place], 1, 0)
        curvature[:, i, j] = curvature[:, j, i] = (a - b - c + d) / (4 * SHIFT**2)
    return slope, curvature


class Arrays(Domain[Any]):
    """Numbers, and arrays of NumPy for the names that have many values."""

    def __init__(self, at: Mapping[str, Any]) -> None:
        self.at = at

    def number(self, value: Fraction) -> Any:
        return float(value)

    def degrees(self, value: Fraction) -> Any:
        return math.radians(float(value))

    def symbol(self, name: str) -> Any:
        return math.pi if name == "pi" else self.at[name]

    def call(self, function: str, arguments: list[Any]) -> Any:
        import numpy as np

        named = {"atan2": "arctan2", "acos": "arccos", "asin": "arcsin", "atan": "arctan"}
        return getattr(np, named.get(function, function))(*arguments)
