"""Six revolute joints and the pose that they make as a closed loop of turns, in exact numbers.

With a frame on every axis the arm is F_1 Rz(q_1) C_1 Rz(q_2) C_2 ... Rz(q_6) C = T, and with T on the
other side a loop, Rz(q_1) C_1 ... Rz(q_6) C_6 = 1, that may begin at any joint. Rotations are made of
quaternions with rational parts, so that they are rotations exactly, and axes that meet in the numbers
given meet exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from flint import fmpq, fmpq_mat

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

BITS = 46  # of a number after the point, in lengths of the arm: beyond is rounding


@dataclass(frozen=True)
class Loop:
    """`joints` in order from the one that the loop begins at, and the displacements (4 by 4) after each."""

    joints: tuple[str, ...]
    after: tuple[fmpq_mat, ...]

    def beginning(self, place: int) -> Loop:
        """The same, from another joint."""
        k = place % len(self.joints)
        return Loop(self.joints[k:] + self.joints[:k], self.after[k:] + self.after[:k])

    def backwards(self) -> Loop:
        """The same from its other end, with every axis turned round, so that the angles stay what they
        are."""
        flip = fmpq_mat([[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]])
        *inner, last = [flip * inverse(T) * flip for T in self.after]
        return Loop(self.joints[::-1], (*inner[::-1], last))


def closed(
    joints: Sequence[str], frames: Sequence[Array], end: Array, pose: Array, size: float = 1.0
) -> Loop:
    """Of an arm with these frames (4 by 4) on its axes, z along each, and its end-effector where every joint
    variable is zero, and of the pose it should take; lengths are measured by `size`."""
    import numpy as np

    after = [np.linalg.solve(one, other) for one, other in pairwise(frames)]
    after.append(np.linalg.solve(frames[-1], end) @ np.linalg.solve(pose, frames[0]))
    return Loop(tuple(joints), tuple(rigid(T, size) for T in after))


def rigid(T: Array, size: float = 1.0) -> fmpq_mat:
    """The displacement with a rational quaternion and rational lengths."""
    a, b, c, d = map(rational, _quaternion(T))
    n = a * a + b * b + c * c + d * d
    R = [
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ]
    rows = [[each / n for each in row] + [rational(T[i, 3] / size)] for i, row in enumerate(R)]
    return fmpq_mat([*rows, [0, 0, 0, 1]])


def rational(value: float) -> fmpq:
    """A number without what rounding may have left of it."""
    return fmpq(round(float(value) * 2**BITS), 2**BITS)


def inverse(T: fmpq_mat) -> fmpq_mat:
    """Of a displacement."""
    R = [[T[j, i] for j in range(3)] for i in range(3)]
    p = [-sum((row[j] * T[j, 3] for j in range(3)), fmpq(0)) for row in R]
    return fmpq_mat([[*row, each] for row, each in zip(R, p, strict=True)] + [[0, 0, 0, 1]])


def turned(c: fmpq, s: fmpq) -> fmpq_mat:
    """About z."""
    return fmpq_mat([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def _quaternion(T: Array) -> list[float]:
    """Scalar first, of the rotation: the eigenvector of the largest eigenvalue (Bar-Itzhack 2000)."""
    import numpy as np

    R = T[:3, :3]
    K = np.zeros((4, 4))
    K[:3, :3] = R + R.T - np.trace(R) * np.eye(3)
    K[3, :3] = K[:3, 3] = R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]
    K[3, 3] = np.trace(R)
    x, y, z, scalar = map(float, np.linalg.eigh(K)[1][:, -1])
    return [scalar, x, y, z]
