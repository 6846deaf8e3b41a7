"""D, every c_ijk and g of an arm by both derivations in the algebra, and by numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations_with_replacement
from typing import Any

import numpy as np

from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import generator_numbers, number
from derive.algebra.scalar import Scalar
from derive.kinds.checks import random_points
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.mechanics.chain import Chain, chain
from derive.mechanics.dynamics import christoffel, gravity_of, inertia_matrix, potential_energy
from derive.mechanics.newton_euler import LinkBody, NewtonEuler
from derive.mechanics.oracle import Oracle
from derive.mechanics.robot import Robot
from tests.mechanics.robots import symbols

Dynamics = tuple[ScalarMatrix, dict[tuple[int, int, int], Scalar], tuple[Scalar, ...]]


@dataclass(frozen=True)
class Arm:
    """An arm with a body on one link at least."""

    robot: Robot

    @cached_property
    def chain(self) -> Chain:
        return chain(self.robot)

    @cached_property
    def bodies(self) -> tuple[Weighted, ...]:
        return weighted(Problem("robot", self.robot), self.chain)

    @cached_property
    def gravity(self) -> ScalarMatrix:
        return ScalarMatrix.column(map(normal, gravity_of(self.robot)))

    def by_jacobians(self) -> Dynamics:
        """From the energies, which the Jacobians of the centres of mass give."""
        links = [body.motion for body in self.bodies]
        D, P = inertia_matrix(links), potential_energy(links, self.gravity)
        names = self.robot.variables
        return D, christoffel(D, names), tuple(P.diff(name) for name in names)

    def by_forces(self) -> Dynamics:
        """From the equations of Newton and Euler for each link."""
        arm = NewtonEuler.of(self.chain, self.link_bodies(), self.gravity.entries)
        return arm.inertia_matrix(), arm.christoffel(), arm.gravity_torques(self.gravity.entries)

    def link_bodies(self) -> list[LinkBody | None]:
        """One for each row."""
        found: list[LinkBody | None] = [None] * len(self.robot.links)
        for body in self.bodies:
            found[body.i - 1] = LinkBody(body.motion.mass, body.com, body.motion.inertia)
        return found

    def points(self, count: int) -> list[dict[str, float]]:
        """Values of every symbol, rate and acceleration, and of the names of shapes' moments."""
        rates = [f"{name}_{dot}" for name in self.robot.variables for dot in ("dot", "ddot")]
        found = list(random_points(sorted({*symbols(self.robot), "g", *rates}), count))
        for at in found:
            named = {
                str(text(name)): number(value, at)
                for body in self.bodies
                for name, value in body.named.items()
            }
            at |= named
        return found

    def in_numbers(self, at: Mapping[str, float]) -> Any:
        """tau (n) by the oracle."""
        return Oracle(self.robot, {}).torques(at)


def torques(found: Dynamics, names: Sequence[str], points: Sequence[Mapping[str, float]]) -> Any:
    """D qddot + c qdot qdot + g in numbers, a row for each point (points by n)."""
    D, c, g = found
    n = range(len(names))
    rates, rises = (
        np.array([[at[f"{name}_{dot}"] for at in points] for name in names]) for dot in ("dot", "ddot")
    )
    tau = [at_all(g[k], points) + sum(at_all(D[k, j], points) * rises[j] for j in n) for k in n]
    for i, j in combinations_with_replacement(n, 2):
        twice = 1 if i == j else 2
        for k in n:
            tau[k] = tau[k] + twice * at_all(c[i + 1, j + 1, k + 1], points) * rates[i] * rates[j]
    return np.array(tau).T


def at_all(value: Scalar, points: Sequence[Mapping[str, float]]) -> Any:
    """The value of a polynomial at many points at once: coefficients times powers of the generators."""
    assert value.denominator is None
    if not value:
        return np.zeros(len(points))
    gens = np.array([generator_numbers(value, at) for at in points])
    exponents = np.array(value.numerator.monoms(), dtype=int)
    coefficients = np.array([int(k.p) / int(k.q) for k in value.numerator.coeffs()])
    terms = np.tile(coefficients, (len(points), 1))
    for place in np.flatnonzero(exponents.any(axis=0)):
        terms *= gens[:, place, None] ** exponents[:, place]
    return terms.sum(axis=1)
