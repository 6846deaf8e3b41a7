"""Singular configurations of a matrix that is not square, sought in numbers: it loses rank where all its
largest minors vanish at once, which a line meets nowhere; Newton's method goes down to it."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, Any

from derive.kinds.robot._singular.search import Values

if TYPE_CHECKING:
    from numpy.typing import NDArray

STARTS, ROUNDS = 6, 24
STEP = 1e-6
FALLEN = 1e-9  # of the minors, relative to the size of the matrix
LONGEST = 0.8  # rad or lengths in one round


def fallen_to(
    matrix: Callable[[Values], Any], at: Mapping[str, float], names: Sequence[str], slides: Sequence[str]
) -> Iterator[Values]:
    """Places where all minors of full size vanish, from starts at random."""
    import numpy as np

    draw = random.Random(" ".join(names))

    def minors(q: NDArray[Any]) -> NDArray[Any]:
        J = np.asarray(matrix({**at, **dict(zip(names, q.tolist(), strict=True))}), float)
        J = J if J.shape[0] <= J.shape[1] else J.T
        chosen = (list(columns) for columns in combinations(range(J.shape[1]), J.shape[0]))
        found: NDArray[Any] = np.array([np.linalg.det(J[:, columns]) for columns in chosen])
        found /= max(1.0, float(abs(J).max())) ** len(J)
        return found

    for _ in range(STARTS):
        widest = [2.0 if name in slides else math.pi for name in names]
        q = np.array([draw.uniform(-wide, wide) for wide in widest])
        for _ in range(ROUNDS):
            here = minors(q)
            if abs(here).max() < FALLEN:
                yield {**at, **dict(zip(names, q.tolist(), strict=True))}
                break
            sides = [minors(q + STEP * each) for each in np.eye(len(q))]
            slope = (np.array(sides).T - here[:, None]) / STEP
            step = -np.linalg.pinv(slope, rcond=1e-8) @ here
            q = q + step * min(1.0, LONGEST / (float(np.linalg.norm(step)) or 1.0))
