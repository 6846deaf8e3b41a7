"""Six revolute joints in floating point: a frame on every axis, and how far the end-effector is off a
pose."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import Point, scalar_number
from derive.mechanics.chain import Chain

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

TINY, NEAR = 1e-12, 1e-9


@dataclass(frozen=True)
class SixAxes:
    """The `frames` (4 by 4) on the axes of the `joints`, z along each, and the `end`, where every joint
    variable is zero; lengths are measured by `size`."""

    joints: tuple[str, ...]
    frames: tuple[Array, ...]
    end: Array
    size: float

    @staticmethod
    def of(chain: Chain, point: Point, size: float) -> SixAxes:
        """Of a chain with values for all other names."""
        import numpy as np

        zero = {**point, **dict.fromkeys(chain.variables, 0.0)}
        frames = []
        for i, joint in chain.moving:
            before = _numbers(chain.T[i - 1], zero) @ _numbers(joint.before, zero)
            axis = np.array([scalar_number(each, zero) for each in joint.axis.entries])
            frames.append(before @ _facing(axis))
        return SixAxes(chain.variables, tuple(frames), _numbers(chain.T_tool, zero), size)

    @cached_property
    def after(self) -> tuple[Array, ...]:
        """From each frame to the next, and to the end."""
        import numpy as np

        return tuple(
            np.linalg.solve(one, other)
            for one, other in zip(self.frames, (*self.frames[1:], self.end), strict=True)
        )

    @cached_property
    def has_formulas(self) -> bool:
        """Whether three neighbouring axes are parallel or meet in one point (Pieper 1968)."""
        return any(meet_or_are_parallel(*self.lines[k : k + 3]) for k in range(len(self.lines) - 2))

    @property
    def lines(self) -> list[tuple[Array, Array]]:
        """The direction of each axis and a point on it, in lengths of the arm, at zero."""
        return [(T[:3, 2], T[:3, 3] / self.size) for T in self.frames]

    def sides(self, pose: Array, angles: Mapping[str, float]) -> tuple[Array, Array]:
        """How far off a pose the end-effector is (6, the position first), and the Jacobian (6 by 6)."""
        import numpy as np

        T, axes = self.frames[0], []
        for name, after in zip(self.joints, self.after, strict=True):
            axes.append((T[:3, 2], T[:3, 3]))
            T = T @ turn(angles[name]) @ after
        p = T[:3, 3]
        J = np.array([[*np.cross(z, p - o) / self.size, *z] for z, o in axes]).T
        return np.array([*(p - pose[:3, 3]) / self.size, *_rotation_vector(T[:3, :3] @ pose[:3, :3].T)]), J


def meet_or_are_parallel(*lines: tuple[Array, Array]) -> bool:
    """Whether lines, each a unit direction and a point, do the one or the other."""
    import numpy as np

    if all(float(np.abs(np.cross(lines[0][0], z)).max()) < NEAR for z, _ in lines[1:]):
        return True
    rows = [np.eye(3) - np.outer(z, z) for z, _ in lines]
    sides = [row @ p for row, (_, p) in zip(rows, lines, strict=True)]
    point = np.linalg.lstsq(np.vstack(rows), np.concatenate(sides), rcond=None)[0]
    return all(float(np.abs(row @ point - side).max()) < NEAR for row, side in zip(rows, sides, strict=True))


def _rotation_vector(R: Array) -> Array:
    import numpy as np

    v = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine, cosine = float(np.linalg.norm(v)), float(np.trace(R) - 1) / 2
    if sine < TINY:
        return v if cosine > 0 else np.array([math.pi, 0.0, 0.0])
    return v * (math.atan2(sine, cosine) / sine)


def _facing(z: Array) -> Array:
    """A frame (4 by 4) with this z-axis."""
    import numpy as np

    x = np.cross(z, np.eye(3)[int(np.abs(z).argmin())])
    x = np.array([1.0, 0.0, 0.0]) if abs(z[2]) > 1 - TINY else x / np.linalg.norm(x)
    T = np.eye(4)
    T[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    return T


def turn(q: float) -> Array:
    """About z (4 by 4)."""
    import numpy as np

    c, s = math.cos(q), math.sin(q)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def _numbers(T: ScalarMatrix, point: Point) -> Array:
    import numpy as np

    return np.array([[scalar_number(each, point) for each in row] for row in T.rows])
