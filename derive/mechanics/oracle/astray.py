"""An arm of the same sort in general position, where no two frames share an axis or an origin by chance.

What is told of a frame by its number holds whatever the lengths and twists of an arm are. In an arm in a
plane the third axes of all frames are one direction; in this one they are not.
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random
from typing import Any

from derive.mechanics.oracle.arm import Oracle
from derive.mechanics.oracle.poses import turn
from derive.mechanics.oracle.values import Array
from derive.mechanics.robot import DHRow


@dataclass(frozen=True, slots=True)
class Astray(Oracle):
    """Each row with a displacement more that its convention leaves free: after it, or before it where the
    axis of its joint is that of its own frame."""

    def _row(self, i: int, point: Any) -> Array:
        T, by = Oracle._row(self, i, point), _displacement(i)
        own = self.robot.convention == "modified" and isinstance(self.robot.links[i].row, DHRow)
        return by @ T if own else T @ by


def _displacement(i: int) -> Array:
    """T (4 by 4), one for each row."""
    import numpy as np

    draw, T = Random(i), np.eye(4)
    k = np.array([draw.uniform(0.2, 1.0) for _ in range(3)])
    T[:3, :3] = turn(k / np.sqrt(k @ k), draw.uniform(0.4, 1.2))
    T[:3, 3] = [draw.uniform(0.2, 1.0) for _ in range(3)]
    return T
