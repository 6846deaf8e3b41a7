"""Rows of a robot in numbers: the matrices of Denavit and Hartenberg entry by entry, and screws."""

from __future__ import annotations

from typing import Any

from derive.mechanics.oracle.poses import compose, crossing, direction, turn
from derive.mechanics.oracle.values import Array, Value
from derive.mechanics.robot import Convention, DHRow, FreeRow, Row, ScrewRow


def standard(theta: Any, d: Any, a: Any, alpha: Any) -> Array:
    """A_i (4 by 4) as printed in Spong, Hutchinson and Vidyasagar, eq. 3.10."""
    import numpy as np

    ct, st, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array(
        [
            [ct, -st * ca, st * sa, a * ct],
            [st, ct * ca, -ct * sa, a * st],
            [0, sa, ca, d],
            [0, 0, 0, 1],
        ]
    )


def modified(theta: Any, d: Any, a: Any, alpha: Any) -> Array:
    """T_i^{i-1} (4 by 4) as printed in Craig, eq. 3.6; a and alpha are those of the axis before."""
    import numpy as np

    ct, st, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array(
        [
            [ct, -st, 0, a],
            [st * ca, ct * ca, -sa, -sa * d],
            [st * sa, ct * sa, ca, ca * d],
            [0, 0, 0, 1],
        ]
    )


def helix(k: Array, through: Array, by: Any, pitch: Any) -> Array:
    """e^{[S] q} (4 by 4) of a turn `by` about the unit vector k through a point, `pitch` metres along it a
    radian: p = (q 1 + (1 - cos q) K + (q - sin q) K^2) v with v = -k x c + h k (Lynch and Park, eq. 3.88)."""
    import numpy as np

    K, v = crossing(k), np.cross(through, k) + pitch * k
    T = np.eye(4, dtype=np.array(by).dtype)
    T[:3, :3] = turn(k, by)
    T[:3, 3] = (by * np.eye(3) + (1 - np.cos(by)) * K + (by - np.sin(by)) * (K @ K)) @ v
    return T


TYPED = {"standard": standard, "modified": modified}


def local(row: Row, convention: Convention, point: Any, value: Value) -> Array:
    """T (4 by 4) from the frame of a row to the one before."""
    import numpy as np

    match row:
        case FreeRow(moves):
            return compose(moves, point, value)
        case DHRow(theta, d, a, alpha):
            return TYPED[convention](*(value(each, point) for each in (theta, d, a, alpha)))
        case ScrewRow(axis, through, by, pitch, slide):
            k, q = direction(axis, point, value), value(by, point)
            if slide:
                T = np.eye(4, dtype=np.array(q).dtype)
                T[:3, 3] = q * k
                return T
            return helix(k, np.array([value(x, point) for x in through]), q, value(pitch, point))
