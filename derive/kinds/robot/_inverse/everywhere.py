"""Newton's method for a pose from many starts at once, by the product of exponentials; and how axes lie."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

Lines: TypeAlias = "Sequence[tuple[Array, Array]]"  # a unit direction and a point (3 each)
STARTS, STEPS = 64, 40
FOUND, REGULAR, CUT, NEAR = 1e-9, 1e-6, 1e-6, 1e-7


def from_everywhere(axes: Lines, home: Array, pose: Array, size: float) -> Array:
    """The joint angles (m by n) at which the pose is reached with a regular Jacobian, by the axes and the
    pose (4 by 4) of the arm at zero; lengths are measured by `size`."""
    import numpy as np

    q = np.random.default_rng(1).uniform(-math.pi, math.pi, (STARTS, len(axes)))
    for _ in range(STEPS):
        off, J = _off(q, axes, home, pose, size)
        q = q - np.einsum("nij,nj->ni", np.linalg.pinv(J, rcond=CUT), off)
    off, J = _off(q, axes, home, pose, size)
    sizes = np.linalg.svd(J, compute_uv=False)
    return np.array(q[(np.abs(off).max(axis=1) < FOUND) & (sizes[:, -1] > REGULAR * sizes[:, 0])])


def _off(q: Array, axes: Lines, home: Array, pose: Array, size: float) -> tuple[Array, Array]:
    """Of many configurations (m by n) how far off they are (m by 6: the position, and a rotation vector in
    the base), and the Jacobians (m by 6 by n)."""
    import numpy as np

    T, columns = np.broadcast_to(np.eye(4), (len(q), 4, 4)), []
    for k, (w, p) in enumerate(axes):
        columns.append((T[:, :3, :3] @ w, T[:, :3, 3] + T[:, :3, :3] @ p))
        T = T @ _turns(q[:, k], w, p)
    end = T @ home
    at = end[:, :3, 3]
    J = np.stack([np.concatenate([np.cross(z, at - o) / size, z], axis=1) for z, o in columns], axis=2)
    D = end[:, :3, :3] @ pose[:3, :3].T
    w = np.stack([D[:, 2, 1] - D[:, 1, 2], D[:, 0, 2] - D[:, 2, 0], D[:, 1, 0] - D[:, 0, 1]], axis=1) / 2
    sine, cosine = np.linalg.norm(w, axis=1), (np.trace(D, axis1=1, axis2=2) - 1) / 2
    w = w * (np.arctan2(sine, cosine) / np.maximum(sine, 1e-300))[:, None]
    w[(sine < FOUND) & (cosine < 0)] = math.pi
    return np.concatenate([(at - pose[:3, 3]) / size, w], axis=1), J


def _turns(q: Array, w: Array, p: Array) -> Array:
    """About the line through p along w (m by 4 by 4), by Rodrigues' formula."""
    import numpy as np

    W = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    s, c = np.sin(q)[:, None, None], np.cos(q)[:, None, None]
    E = np.zeros((len(q), 4, 4))
    E[:, :3, :3] = np.eye(3) + s * W + (1 - c) * (W @ W)
    E[:, :3, 3] = p - E[:, :3, :3] @ p
    E[:, 3, 3] = 1
    return E


def three_are_special(axes: Lines, size: float) -> bool:
    """Whether three lines are parallel, or the second meets both others in the same point."""
    import numpy as np

    (a, p), (b, q), (c, r) = axes
    if max(np.abs(np.cross(a, b)).max(), np.abs(np.cross(b, c)).max()) < NEAR:
        return True
    first, second = _crossing(a, p, b, q, size), _crossing(b, q, c, r, size)
    return first is not None and second is not None and bool(np.abs(first - second).max() < NEAR * size)


def _crossing(a: Array, p: Array, b: Array, q: Array, size: float) -> Array | None:
    """The point in which two lines meet."""
    import numpy as np

    n = np.cross(a, b)
    if np.abs(n).max() < NEAR or abs(n @ (q - p)) > NEAR * size:
        return None
    return np.array(p + a * float(np.cross(q - p, b) @ n) / float(n @ n))
