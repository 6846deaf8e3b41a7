"""An arm at one point, its bodies and the terms of its equations of motion by their indices."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from derive.mechanics.oracle.arm import Oracle
from derive.mechanics.oracle.instant import Instant
from derive.mechanics.oracle.sweep import Still
from derive.mechanics.oracle.values import Array


@dataclass(frozen=True)
class Heavy(Instant):
    """The arm in numbers with its masses: indices of joints and links from 1, as in the equations."""

    @cached_property
    def D(self) -> Array:
        """The inertia matrix (n by n), rotors included."""
        return self._rigid.inertia_matrix(self.at, self._still)

    @property
    def D_inv(self) -> Array:
        """Its inverse (n by n)."""
        import numpy as np

        return np.array(np.linalg.inv(self.D))

    @property
    def det(self) -> float:
        """Its determinant."""
        import numpy as np

        return float(np.linalg.det(self.D))

    def D_of(self, i: int) -> Array:
        """What the body of link i alone brings to it (n by n)."""
        links = (
            replace(link, motor=None, body=link.body if k == i else None)
            for k, link in enumerate(self.oracle.robot.links, 1)
        )
        return replace(self.oracle, robot=replace(self._rigid.robot, links=tuple(links))).inertia_matrix(
            self.at
        )

    @cached_property
    def g(self) -> Array:
        """The joint forces (n) that hold the arm."""
        return self._rigid.torques_at_rest(self.at, self._still)

    @cached_property
    def tau(self) -> Array:
        """The joint forces (n) at the rates and accelerations of the point, friction included."""
        return self.oracle.torques(self.at, self._still)

    @cached_property
    def tau_without_acceleration(self) -> Array:
        """What is left of them where nothing accelerates (n)."""
        even = {f"{name}_ddot": 0.0 for name in self.oracle.robot.variables}
        return self.oracle.torques({**self.at, **even}, self._still)

    def accelerations(self, forces: Array) -> Array:
        """qddot (n) that joint forces (n) bring about."""
        import numpy as np

        return np.array(np.linalg.solve(self.D, forces - self.tau_without_acceleration))

    @cached_property
    def christoffel(self) -> Array:
        """c_ijk (n by n by n) from the torques of one and of two rates."""
        import numpy as np

        n = len(self.oracle.robot.variables)
        unit = np.eye(n)
        alone = [self._of_rates(each) for each in unit]
        found = np.zeros((n, n, n))
        for i in range(n):
            found[i, i] = alone[i]
            for j in range(i):
                both = self._of_rates(unit[i] + unit[j])
                found[i, j] = found[j, i] = (both - alone[i] - alone[j]) / 2
        return found

    def potential(self, i: int) -> float:
        """The potential energy of link i, zero at the origin of the base."""
        body = self.bodies[i - 1]
        return 0.0 if body is None else -body.mass * float(self.oracle.gravity(self.at) @ body.com)

    @property
    def potential_energy(self) -> float:
        """That of all links."""
        return sum(self.potential(i) for i, _ in enumerate(self.bodies, 1))

    def kinetic(self, i: int) -> float:
        """The kinetic energy of link i at the rates of the point."""
        body = self.bodies[i - 1]
        if body is None:
            return 0.0
        v, w = self.courses[f"c{i}"].v, self.courses[f"c{i}"].omega
        return float(body.mass * v @ v + w @ body.turned @ w) / 2

    @property
    def kinetic_energy(self) -> float:
        """That of all, rotors included."""
        return float(self.rates @ self.D @ self.rates) / 2

    @cached_property
    def rates(self) -> Array:
        """qdot (n)."""
        import numpy as np

        return np.array([self.at[f"{name}_dot"] for name in self.oracle.robot.variables])

    @cached_property
    def C(self) -> Array:
        """c_kj, the sums of c_ijk qdot_i (n by n)."""
        import numpy as np

        return np.array(np.einsum("ijk,i->kj", self.christoffel, self.rates))

    @property
    def D_dot(self) -> Array:
        """dD/dt (n by n), for the derivative of d_kj by q_i is c_ijk + c_ikj."""
        import numpy as np

        return np.array(self.C + self.C.T)

    def handed(self, i: int) -> Array:
        """The force (3, base frame) that link i gets from the one before."""
        import numpy as np

        return np.array(sum(self.force(k) for k in range(i, len(self.bodies) + 1)))

    def moment_handed(self, i: int, about: Array) -> Array:
        """The moment about a point (3, base frame both) that link i gets from the one before: what turns the
        bodies from it on, and their forces with the way there from the point."""
        import numpy as np

        carried = ((k, body) for k, body in enumerate(self.bodies, 1) if k >= i and body is not None)
        loads = (self.moment(k) + np.cross(body.com - about, self.force(k)) for k, body in carried)
        return np.array(sum(loads, np.zeros(3)))

    def force(self, i: int) -> Array:
        """What moves the body of link i (3, base frame), its weight made up for."""
        import numpy as np

        body = self.bodies[i - 1]
        if body is None:
            return np.zeros(3)
        return np.array(body.mass * (self.courses[f"c{i}"].a - self.oracle.gravity(self.at)))

    def moment(self, i: int) -> Array:
        """The moment about the com that turns the body of link i (3, base frame)."""
        import numpy as np

        body, now = self.bodies[i - 1], self.courses[f"c{i}"]
        if body is None:
            return np.zeros(3)
        return np.array(body.turned @ now.alpha + np.cross(now.omega, body.turned @ now.omega))

    def _of_rates(self, rates: Array) -> Array:
        """The torques (n) of these rates alone."""
        moving = dict(self.at)
        for name, rate in zip(self.oracle.robot.variables, rates, strict=True):
            moving |= {f"{name}_dot": rate, f"{name}_ddot": 0.0}
        return self._rigid.torques(moving, self._still) - self.g

    @cached_property
    def _still(self) -> Still | None:
        return self.oracle.still(self.at)

    @cached_property
    def _rigid(self) -> Oracle:
        """The arm without friction."""
        links = tuple(replace(link, friction=None) for link in self.oracle.robot.links)
        return replace(self.oracle, robot=replace(self.oracle.robot, links=links))
