"""The equations of motion of an open chain at one point, in numbers, where letters would fill books.

D is the sum of m J_v^T J_v + J_w^T I J_w of all links, and h what the rates and gravity add, with the time
derivatives of the same Jacobians (Spong et al., section 6.2; Siciliano et al., section 7.1.1).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


@dataclass(frozen=True)
class Screw:
    """A joint of row `i`: its axis z (3) through o (3), in the base frame; whether it turns."""

    i: int
    turns: bool
    z: Array
    o: Array


@dataclass(frozen=True)
class Load:
    """The body of row `i`: its mass, com c (3) and I about it (3 by 3), both in the base frame."""

    i: int
    mass: float
    c: Array
    I: Array


@dataclass(frozen=True)
class Instantaneous:
    """Joints and bodies at a point, the joint rates there (n), and the acceleration of gravity (3)."""

    joints: Sequence[Screw]
    loads: Sequence[Load]
    rates: Array
    gravity: Array

    @cached_property
    def D(self) -> Array:
        """The inertia matrix (n by n)."""
        import numpy as np

        n = len(self.joints)
        whole = np.zeros((n, n))
        for load in self.loads:
            J_v, J_w = self._columns(load.c, load.i)
            whole += load.mass * J_v.T @ J_v + J_w.T @ load.I @ J_w
        return whole

    @cached_property
    def h(self) -> Array:
        """What the joint forces have beside D qddot (n)."""
        import numpy as np

        rest = np.zeros(len(self.joints))
        for load in self.loads:
            J_v, J_w = self._columns(load.c, load.i)
            a, alpha = self._accelerations(load)
            omega = J_w @ self.rates
            rest += J_v.T @ (load.mass * (a - self.gravity))
            rest += J_w.T @ (load.I @ alpha + np.cross(omega, load.I @ omega))
        return rest

    def accelerations(self, forces: Array) -> Array:
        """qddot (n) of joint forces (n)."""
        import numpy as np

        return np.array(np.linalg.solve(self.D, forces - self.h))

    def _columns(self, p: Array, i: int) -> tuple[Array, Array]:
        """J_v and J_w (3 by n each) of a point p of row i."""
        import numpy as np

        nothing = np.zeros(3)
        linear, angular = [], []
        for joint in self.joints:
            moves = joint.i <= i
            turned = np.cross(joint.z, p - joint.o) if joint.turns else joint.z
            linear.append(turned if moves else nothing)
            angular.append(joint.z if moves and joint.turns else nothing)
        return np.array(linear).T, np.array(angular).T

    def _accelerations(self, load: Load) -> tuple[Array, Array]:
        """Of the com and of the rotation of a body while no rate changes (3 each): the derivatives of the
        columns times the rates."""
        import numpy as np

        v = self._columns(load.c, load.i)[0] @ self.rates
        a, alpha = np.zeros(3), np.zeros(3)
        for joint, rate, z_dot, o_dot in self._carried():
            if joint.i > load.i:
                break
            if joint.turns:
                a += (np.cross(z_dot, load.c - joint.o) + np.cross(joint.z, v - o_dot)) * rate
                alpha += z_dot * rate
            else:
                a += z_dot * rate
        return a, alpha

    def _carried(self) -> Iterator[tuple[Screw, float, Array, Array]]:
        """Each joint with its rate, and how fast the row before it moves its axis and the point on it."""
        import numpy as np

        for joint, rate in zip(self.joints, self.rates, strict=True):
            J_v, J_w = self._columns(joint.o, joint.i - 1)
            yield joint, float(rate), np.cross(J_w @ self.rates, joint.z), J_v @ self.rates
