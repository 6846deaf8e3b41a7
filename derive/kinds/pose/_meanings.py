"""What the names in questions about a rotation mean in numbers: its entries, and its axis and angle."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

from derive.expression import Expr, Matrix, Symbol
from derive.kinds.meanings import column_of, valued

if TYPE_CHECKING:
    from numpy.typing import NDArray

HALF = 1e-6  # rad, so near half a turn the axis and its opposite are alike


def entries_of(R: Any) -> dict[Expr, Any]:
    """r_11, r_12, ... of a rotation (3 by 3)."""
    return {Symbol(f"r_{i + 1}{j + 1}"): float(R[i, j]) for i, j in product(range(3), range(3))}


def turn_of(R: Any, like: Any = None) -> tuple[float, NDArray[Any]]:
    """The angle (rad, 0 to pi) and the axis (3) of a rotation, by what it leaves and how it turns what stands
    at right angles to that. For half a turn the axis that is `like` a given one."""
    import numpy as np

    axis = np.linalg.svd(R - np.eye(3))[2][-1]
    aside = np.linalg.svd(axis[None])[2][-1]
    angle = float(np.arctan2(axis @ np.cross(aside, R @ aside), aside @ R @ aside))
    if angle < 0:
        angle, axis = -angle, -axis
    if np.pi - angle < HALF and like is not None and axis @ np.ravel(like) < 0:
        axis = -axis
    return angle, axis


def printed(axis: Matrix, at: Any) -> Any:
    """The column of a printed vector at a point."""
    return column_of(valued(axis, {Symbol(name): value for name, value in at.items()}))
