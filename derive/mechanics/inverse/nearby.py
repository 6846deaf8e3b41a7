"""Solutions at a pose that lies specially, followed there from poses nearby.

Where a pose lies so that the elimination vanishes, it does not a little beside it. A solution at which the
arm is regular is one of a family over all poses around, so that those of a pose nearby lead to all of
them; were the arm singular in one, their number would change on the way or on the other side.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from derive.mechanics.inverse.every_solution import Angles, Sides, Undecided, is_singular, polished, same
from derive.mechanics.inverse.six_axes import SixAxes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

BESIDE = 5e-3  # radians, and lengths of the arm
ROTATION, SHIFT = (0.48, -0.64, 0.6), (0.64, 0.6, 0.48)  # in which direction
STEPS, FAR = 20, 0.5
STARTS = 40
NEARLY, NEARLY_SINGULAR = 1e-7, 1e-4  # Newton's method is slow where the arm is singular


def beside(pose: Array, by: float, size: float) -> Array:
    """The pose (4 by 4) turned and shifted: `by` is from -1 to 1."""
    import numpy as np

    w, angle = np.array(ROTATION), by * BESIDE
    W = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    there = pose.copy()
    there[:3, :3] = (np.eye(3) + math.sin(angle) * W + (1 - math.cos(angle)) * (W @ W)) @ pose[:3, :3]
    there[:3, 3] += by * BESIDE * size * np.array(SHIFT)
    return there


def followed(arm: SixAxes, pose: Array, solve: Callable[[Array], Sequence[Angles]]) -> tuple[Angles, ...]:
    """Where those beside the pose, as they are solved there, lead at the pose. Raises Undecided where the
    arm is singular there."""
    ends, others = (
        [_follow(arm, pose, each, side) for each in solve(beside(pose, side, arm.size))] for side in (1, -1)
    )
    sides = partial(arm.sides, pose)
    if len(ends) != len(others) or not all(any(same(one, each) for each in ends) for one in others):
        raise Undecided
    if any(same(one, other) for k, one in enumerate(ends) for other in ends[:k]) or _is_singular_anywhere(
        arm, sides
    ):
        raise Undecided
    return tuple(ends)


def _follow(arm: SixAxes, pose: Array, start: Angles, side: int) -> Angles:
    """In small steps."""
    here = start
    for k in range(STEPS - 1, -1, -1):
        sides = partial(arm.sides, beside(pose, side * k / STEPS, arm.size))
        there = polished(here, sides)
        if there is None or is_singular(there, sides):
            raise Undecided
        if any(abs(math.remainder(there[name] - here[name], 2 * math.pi)) > FAR for name in there):
            raise Undecided
        here = there
    return here


def _is_singular_anywhere(arm: SixAxes, sides: Sides) -> bool:
    """Whether a search from everywhere ends where the arm is singular."""
    draw = random.Random(1)
    for _ in range(STARTS):
        end = polished({name: draw.uniform(-math.pi, math.pi) for name in arm.joints}, sides, NEARLY)
        if end is not None and is_singular(end, sides, NEARLY_SINGULAR):
            return True
    return False
