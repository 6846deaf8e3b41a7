"""The mechanics of an arm from its energies: D, c_ijk and g in numbers at one configuration."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import sympy

from derive.audit.asked import Asked
from derive.audit.points import Number, Point
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.inertia import inertia
from derive.audit.subjects.robot.series import Array, Series, diff, values
from derive.mechanics.bodies import Body


@dataclass(frozen=True)
class Carried:
    """The body of link i where the arm stands: mass, com and J_v, J_w (base frame), D_i, all as series."""

    i: int
    mass: Series
    com: Array
    J_v: Array
    J_w: Array
    I: Array  # (3 by 3) in the base frame

    @cached_property
    def D(self) -> Array:
        """m J_v^T J_v + J_w^T I J_w (n by n)."""
        found: Array = self.J_v.T @ self.J_v * self.mass + self.J_w.T @ self.I @ self.J_w
        return found

    def potential(self, gravity: Array) -> Series:
        """-m g^T c."""
        found: Series = -(self.com @ gravity) * self.mass
        return found


class Mechanics(Arm):
    """An arm with its bodies, motors and friction."""

    def __init__(self, asked: Asked, point: Point) -> None:
        super().__init__(asked, point)
        self.indices = range(self.n)
        self.qdot = np.array([point[f"{name}_dot"] for name in self.robot.variables], dtype=object)
        self.qddot = np.array([point[f"{name}_ddot"] for name in self.robot.variables], dtype=object)

    @cached_property
    def gravity(self) -> Array:
        """The acceleration in the base frame, g down along z where the sheet is silent."""
        if self.robot.gravity is None:
            return np.array([0, 0, -self.point["g"]], dtype=object)
        return np.array([self.series(part) for part in self.robot.gravity], dtype=object)

    @cached_property
    def bodies(self) -> list[Carried]:
        """Those of the links that have one."""
        return [self._carried(i, link.body) for i, link in enumerate(self.robot.links, 1) if link.body]

    def _carried(self, i: int, body: Body) -> Carried:
        T, before = self.poses[i], self.poses[i - 1]
        if body.com == "center":
            com = (T[:3, 3] + before[:3, 3]) * self.point.at(sympy.Rational(1, 2))
        else:
            com = T[:3, :3] @ np.array([self.series(part) for part in body.com], dtype=object) + T[:3, 3]
        R = T[:3, :3]
        I = R @ inertia(body, self) @ R.T
        return Carried(i, self.series(body.mass), com, self.linear(com), self.angular(R), I)

    @cached_property
    def rotors(self) -> Array:
        """G^2 J of each motor (n): it turns G times as fast as its joint."""
        motors = [link.motor for link in self.robot.links if link.variable]
        return np.array(
            [
                self.series(m.inertia) * self.series(m.ratio) * self.series(m.ratio) if m else 0
                for m in motors
            ],
            dtype=object,
        )

    @cached_property
    def D(self) -> Array:
        """The inertia matrix as series of order 1."""
        whole: Array = sum((body.D for body in self.bodies), np.diag(self.rotors))
        zero = Series({}, 1)
        return np.array([[zero + entry for entry in row] for row in whole], dtype=object)

    @cached_property
    def P(self) -> Series:
        """The potential energy, of order 2."""
        return sum((body.potential(self.gravity) for body in self.bodies), Series({}, 2))

    @cached_property
    def g(self) -> Array:
        """dP/dq as series of order 1."""
        return np.array([self.P.diff(i) for i in self.indices], dtype=object)

    @cached_property
    def slopes(self) -> list[Array]:
        """dD/dq_k for each k."""
        return [values(diff(self.D, k)) for k in self.indices]

    def christoffel(self, i: int, j: int, k: int) -> Number:
        """c_ijk, indices from 0 (Spong et al., eq. 6.57): half of d_kj,i + d_ki,j - d_ij,k."""
        dD = self.slopes
        return (dD[i][k, j] + dD[j][k, i] - dD[k][i, j]) / self.point.number(2)

    @cached_property
    def C(self) -> Array:
        """C with entries c_kj = sum of c_ijk qdot_i."""
        return np.array(
            [
                [sum(self.christoffel(i, j, k) * self.qdot[i] for i in self.indices) for j in self.indices]
                for k in self.indices
            ],
            dtype=object,
        )

    @cached_property
    def D_dot(self) -> Array:
        """The derivative of D by time."""
        found: Array = sum(
            (dD * rate for dD, rate in zip(self.slopes, self.qdot, strict=True)),
            np.zeros((self.n, self.n), object),
        )
        return found

    @cached_property
    def friction(self) -> Array:
        """Viscous and Coulomb friction (n), which the motors overcome."""
        found = []
        for link in self.robot.links:
            if link.variable:
                rate = sympy.Symbol(f"{link.variable}_dot")
                rub = link.friction
                expr = 0 * rate
                if rub:
                    expr = self.formula(rub.viscous) * rate + self.formula(rub.coulomb) * sympy.sign(rate)
                found.append(self.point.at(expr))
        return np.array(found, dtype=object)

    @cached_property
    def rest(self) -> Array:
        """What the torques are without accelerations: C qdot + g and friction."""
        found: Array = self.C @ self.qdot + values(self.g) + self.friction
        return found

    @cached_property
    def tau(self) -> Array:
        """Lagrange's equations, with friction."""
        found: Array = values(self.D) @ self.qddot + self.rest
        return found

    @cached_property
    def torques(self) -> Array:
        """tau_1, ... as names that are given (n)."""
        return np.array([self.point[f"tau_{k + 1}"] for k in self.indices], dtype=object)

    def kinetic(self, D: Array) -> Number:
        """qdot^T D qdot / 2."""
        found: Number = self.qdot @ values(D) @ self.qdot / self.point.number(2)
        return found

    def triples(self) -> Iterator[tuple[int, int, int]]:
        """All (i, j, k) from 0."""
        return ((i, j, k) for i in self.indices for j in self.indices for k in self.indices)
