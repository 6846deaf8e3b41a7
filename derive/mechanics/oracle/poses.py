"""Moves as matrices in numbers: Rodrigues' formula, and motions about axes of the world or current ones."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from derive.algebra.numbers.floats import number
from derive.mechanics.motion import Axis, Move
from derive.mechanics.oracle.values import Array, Value

AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def compose(sequence: Iterable[Move], point: Any, value: Value = number) -> Array:
    """T (4 by 4) of moves about current axes."""
    import numpy as np

    T: Array = np.eye(4)
    for move in sequence:
        T = T @ elementary(move, point, value)
    return T


def made(moves: Iterable[Move], point: Any) -> Array:
    """T of moves as they are told, one after the other: about the axes of the world from the left, about
    current ones from the right."""
    import numpy as np

    T: Array = np.eye(4)
    for move in moves:
        step = elementary(move, point)
        T = step @ T if move.about == "world" else T @ step
    return T


def in_sequence(letters: str, angles: Iterable[Any]) -> Array:
    """R (3 by 3) of three angles, as the letters of a convention say: ZYX about current axes, xyz about those
    of the world."""
    import numpy as np

    R: Array = np.eye(3)
    for letter, angle in zip(letters, angles, strict=True):
        step = turn(np.array(AXES[letter.lower()]), angle)
        R = R @ step if letter.isupper() else step @ R
    return R


def elementary(move: Move, point: Any, value: Value = number) -> Array:
    """T (4 by 4) of one move: a turn about an axis through the origin, or a shift."""
    import numpy as np

    k, by = direction(move.axis, point, value), value(move.by, point)
    T = np.eye(4, dtype=np.array(by).dtype)
    if move.kind == "translate":
        T[:3, 3] = by * k
    else:
        T[:3, :3] = turn(k, by)
    return T


def turn(k: Array, angle: Any) -> Array:
    """R (3 by 3) about a unit vector, 1 + sin K + (1 - cos) K^2 (Rodrigues)."""
    import numpy as np

    K = crossing(k)
    R: Array = np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)
    return R


def crossing(k: Array) -> Array:
    """K (3 by 3) with K v = k x v."""
    import numpy as np

    return np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])


def direction(axis: Axis, point: Any, value: Value = number) -> Array:
    """The unit vector (3) of an axis; a written one is divided by its length."""
    import numpy as np

    if isinstance(axis, str):
        unit: Array = np.eye(3)["xyz".index(axis)]
        return unit
    k = np.array([value(part, point) for part in axis])
    return np.array(k / np.sqrt(k @ k))
