"""Joint axes as they are seen: by what stays in its place while a joint of the oracle moves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.mechanics.chain import Chain

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

MOVE = 0.5  # of a joint


def motion(problem: Problem, found: Chain, i: int, here: Mapping[str, float]) -> Array:
    """The displacement (4 by 4, in the base) of what joint i carries against what carries it."""
    import numpy as np

    name = found.joint(i).variable
    oracle = oracle_of(problem)
    (base, before), (carried, after) = (
        oracle.poses(oracle.at(at))[i - 1 : i + 1] for at in (here, {**here, name: here[name] + MOVE})
    )
    D: Array = base @ np.linalg.inv(carried) @ after @ np.linalg.inv(before)
    return D


def axis_seen(problem: Problem, found: Chain, i: int, here: Mapping[str, float]) -> tuple[Array, Array]:
    """The direction of a joint that turns and a point on its axis (3 each)."""
    import numpy as np

    D = motion(problem, found, i, here)
    S = D[:3, :3] - D[:3, :3].T
    w = np.array([S[2, 1], S[0, 2], S[1, 0]])
    return w / np.linalg.norm(w), meeting([D])


def meeting(motions: Sequence[Array]) -> Array:
    """The point (3) that all these displacements leave where it is."""
    import numpy as np

    rows = np.vstack([D[:3, :3] - np.eye(3) for D in motions])
    return np.array(np.linalg.lstsq(rows, np.concatenate([-D[:3, 3] for D in motions]), rcond=None)[0])


def apart(z: Array, d: Array) -> float:
    """How far d points away from a direction."""
    import numpy as np

    return float(np.linalg.norm(np.cross(z, d)))
