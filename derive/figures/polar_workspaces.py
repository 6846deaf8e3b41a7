"""Pictures of what an arm in a plane reaches whose first joint turns within a range: cells by angle and
distance, each moved through that range."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from derive.derivation import Curve
from derive.figures.section_workspaces import outlines

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

AROUND, OUTWARD = 480, 160  # cells


def swept(rho: Array, phi: Array, turn: tuple[float, float], ends: tuple[float, float]) -> Array:
    """Which cells (by angle from -pi, by distance between the ends) hold a place after a turn between two
    angles, of places given by distance and angle."""
    import numpy as np

    near, far = ends
    i = np.floor((phi + math.pi) / math.tau * AROUND).astype(int) % AROUND
    k = np.clip(((rho - near) / max(far - near, 1e-12) * OUTWARD).astype(int), 0, OUTWARD - 1)
    met = np.zeros((AROUND, OUTWARD), dtype=bool)
    met[i.ravel(), k.ravel()] = True
    low, high = (round(each / math.tau * AROUND) for each in turn)
    cells = np.zeros_like(met)
    for shift in range(low, high + 1):
        cells |= np.roll(met, shift, axis=0)
    return cells


def filled(cells: Array, ends: tuple[float, float]) -> Curve:
    """Their outline in the plane."""
    near, far = ends
    xs, ys = [], []
    for i, k in outlines(cells, straight=False):
        angle, r = i / AROUND * math.tau - math.pi, near + k / OUTWARD * (far - near)
        xs.append(r * math.cos(angle))
        ys.append(r * math.sin(angle))
    return tuple(xs), tuple(ys)
