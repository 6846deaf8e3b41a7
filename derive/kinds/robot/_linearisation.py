"""The equations of motion about rest: D_0, the slope of gravity, friction, and A and B of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from derive.algebra import numeric
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal, normal_matrix
from derive.algebra.operations import operations
from derive.derivation import Claim, Derivation, Step, named_results
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    Call,
    Expr,
    Power,
    Product,
    Quotient,
    Symbol,
    free_symbols,
    negate,
    number,
)
from derive.kinds.checks import agreement, law, links
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import matrix_of
from derive.kinds.robot._drives import moving
from derive.mechanics.drives import Friction
from derive.mechanics.oracle import Oracle
from derive.mechanics.robot import Robot

LONGEST = 80  # operations of A and B together
INVERSE, DET = Power(Symbol("D_0"), number(-1)), Call("det", (Symbol("D_0"),))
STEP = 1e-4  # of differences; what they leave is about its square
LEFT = 1e-5


@dataclass(frozen=True, slots=True)
class Linear:
    """The matrices at an equilibrium: of dx/dt = A x + B u, and what they are made of (n by n)."""

    problem: Problem
    at: Mapping[str, Expr]
    torques: ScalarMatrix
    inertia: ScalarMatrix
    slope: ScalarMatrix
    friction: ScalarMatrix

    @property
    def inverse(self) -> ScalarMatrix:
        return self.inertia.inverse()

    @property
    def A(self) -> ScalarMatrix:
        n = self.inertia.shape[0]
        above = ScalarMatrix.beside([ScalarMatrix.zeros(n, n), ScalarMatrix.identity(n)])
        below = ScalarMatrix.beside([-(self.inverse @ self.slope), -(self.inverse @ self.friction)])
        return ScalarMatrix.stacked([above, below])

    @property
    def B(self) -> ScalarMatrix:
        return ScalarMatrix.stacked([ScalarMatrix.zeros(*self.inertia.shape), self.inverse])

    @property
    def steps(self) -> tuple[Step, ...]:
        """tau_0, D_0, K_0, where there is friction B_f, then A and B; of long ones the blocks that are not
        plain, over the determinant of D_0 that they share."""
        found = [("tau_0", self.torques), ("D_0", self.inertia), ("K_0", self.slope)]
        found += [("B_f", self.friction)] if self.friction else []
        given = tuple(self._step(name, value) for name, value in found)
        if self.long:
            return *given, *self._blocks()
        return *given, self._step("A", self.A), self._step("B", self.B)

    @property
    def long(self) -> bool:
        return sum(operations(self.results[name]) for name in ("A", "B")) > LONGEST

    def _step(self, name: str, value: ScalarMatrix) -> Step:
        return Step(name, (Symbol(name), self.problem.readable_matrix(value)), "linearised")

    def _blocks(self) -> Iterator[Step]:
        """det D_0, then A_21, A_22 and B_2 as a matrix over it."""
        yield Step("det_0", (DET, self.problem.readable(self.inertia.det())), "blocks")
        adjugate = self.inertia.adjugate()
        for name, route, top in (
            ("A_21", negate(Product((INVERSE, Symbol("K_0")))), -(adjugate @ self.slope)),
            ("A_22", negate(Product((INVERSE, Symbol("B_f")))), -(adjugate @ self.friction)),
            ("B_2", INVERSE, adjugate),
        ):
            if top:
                value = Product((Quotient(ONE, DET), self.problem.readable_matrix(top)))
                yield Step(name, (Symbol(name), route, value), "blocks")

    @property
    def results(self) -> dict[str, Expr]:
        values = (("tau_0", self.torques), ("A", self.A), ("B", self.B))
        return {name: self.problem.readable_matrix(value) for name, value in values}

    @property
    def definitions(self) -> dict[Expr, Expr]:
        return named_results(step for step in self.steps if step.rule == "linearised")

    @property
    def claims(self) -> tuple[Claim, ...]:
        n = self.inertia.shape[0]
        lower = self.A.block(slice(n, 2 * n), slice(None))
        left, right = lower.columns(*range(n)), lower.columns(*range(n, 2 * n))
        return (
            *links(self.steps, {**self.problem.names, **self.definitions}),
            law("D_0 A_21 = -K_0", self.inertia @ left == -self.slope),
            law("D_0 A_22 = -B_f", self.inertia @ right == -self.friction),
            law("D_0 B_2 = 1", self.inertia @ self.inverse == ScalarMatrix.identity(n)),
            self._second_route(),
        )

    def _second_route(self) -> Claim:
        """A by differences of the accelerations, which Newton and Euler give."""
        arm = Oracle(_smooth(self.problem.subject), self.problem.where)
        A = self.A
        return agreement(
            "A agrees with differences of the accelerations (Newton-Euler)",
            self.problem.symbols | {"g"} | {name for part in self.at.values() for name in free_symbols(part)},
            lambda point: numeric.matrix_numbers(A, arm.at(point)),
            lambda point: _differences(arm, self.at, point),
            LEFT,
        )


def linearised(problem: Problem, motion: Derivation, at: Mapping[str, Expr]) -> Linear:
    """About rest at these values of joint variables. Raises NotDerivable where D has no inverse there, and
    for names that are no joint variables."""
    names = problem.subject.variables
    strange = [name for name in at if name not in names]
    if strange:
        raise NotDerivable(f"at: {strange[0]} is no joint variable; they are {', '.join(names)}")
    values: Names = {**problem.names, **{Symbol(name): value for name, value in at.items()}}
    g = matrix_of(motion, "g")
    slope = ScalarMatrix.of([[normal(entry).diff(name) for name in names] for (entry,) in g.rows])
    found = Linear(
        problem,
        at,
        normal_matrix(g, values),
        normal_matrix(matrix_of(motion, "D"), values),
        normal_matrix(problem.readable_matrix(slope), values),
        _viscous(problem),
    )
    if not found.inertia.det():
        raise NotDerivable("D is singular there, so that the accelerations are not determined")
    return found


def _viscous(problem: Problem) -> ScalarMatrix:
    values = [normal((link.friction or Friction()).viscous, problem.names) for link in moving(problem.subject)]
    return ScalarMatrix.of([[value if i == j else 0 for j in range(len(values))] for i, value in enumerate(values)])


def _smooth(robot: Robot) -> Robot:
    """Without Coulomb friction, which has no slope at rest."""
    kept = (
        replace(link, friction=Friction(link.friction.viscous) if link.friction else None)
        for link in robot.links
    )
    return replace(robot, links=tuple(kept))


def _differences(arm: Oracle, at: Mapping[str, Expr], point: Mapping[str, float]) -> Any:
    """A (2n by 2n) by central differences of dx/dt about rest, the forces those of rest."""
    import numpy as np

    names = arm.robot.variables
    whole = arm.at(point)
    rest = {**whole, **{name: numeric.number(value, whole) for name, value in at.items()}}
    rest |= {f"{name}_{dots}": 0.0 for name in names for dots in ("dot", "ddot")}
    forces = arm.torques(rest)
    columns = []
    for name in (*names, *(f"{name}_dot" for name in names)):
        ahead, behind = (_rates(arm, {**rest, name: rest[name] + h}, forces) for h in (STEP, -STEP))
        columns.append((ahead - behind) / (2 * STEP))
    return np.array(columns).T


def _rates(arm: Oracle, at: Mapping[str, float], forces: Any) -> Any:
    """dx/dt at a state."""
    import numpy as np

    names = arm.robot.variables
    h = arm.torques(at)
    D = np.array([arm.torques({**at, f"{name}_ddot": 1.0}) - h for name in names])
    return np.concatenate([[at[f"{name}_dot"] for name in names], np.linalg.solve(D, forces - h)])


