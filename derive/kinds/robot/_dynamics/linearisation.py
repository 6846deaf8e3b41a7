"""The equations of motion about rest: D_0, the slope of gravity, friction, and A and B of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal, normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, Step, named_results
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Call,
    Expr,
    Matrix,
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
from derive.kinds.robot._dynamics.drives import moving
from derive.mechanics.drives import Friction
from derive.mechanics.oracle import Oracle
from derive.mechanics.robot import Robot

LONGEST = 80  # operations of A and B together
MOST_REDUCED = 2  # joints; with more, common factors of fractions are not looked for
MOST_TERMS = 600  # of an entry of A times the determinant
INVERSE, DET = Power(Symbol("D_0"), number(-1)), Call("det", (Symbol("D_0"),))
STEP = 1e-4  # of differences; what they leave is about its square
LEFT = 1e-5


@dataclass(frozen=True, slots=True)
class Linear:
    """The matrices at an equilibrium: of dx/dt = A x + B u, and what they are made of (n by n); `det` and
    `adjugate` are those of `inertia`, which is D_0."""

    problem: Problem
    at: Mapping[str, Expr]
    torques: ScalarMatrix
    inertia: ScalarMatrix
    slope: ScalarMatrix
    friction: ScalarMatrix
    det: Scalar
    adjugate: ScalarMatrix

    @property
    def tops(self) -> tuple[ScalarMatrix, ScalarMatrix, ScalarMatrix]:
        """The lower blocks A_21, A_22 and B_2, times det D_0."""
        return -(self.adjugate @ self.slope), -(self.adjugate @ self.friction), self.adjugate

    @property
    def steps(self) -> tuple[Step, ...]:
        """tau_0, D_0, K_0, where there is friction B_f, then A and B; of long ones the blocks that are not
        plain, over the determinant of D_0 that they share."""
        found = [("tau_0", self.torques), ("D_0", self.inertia), ("K_0", self.slope)]
        found += [("B_f", self.friction)] if self.friction else []
        given = tuple(
            Step(name, (Symbol(name), self.problem.readable_matrix(value)), "linearised")
            for name, value in found
        )
        if self.long:
            return *given, *self._blocks()
        whole = (Step(name, (Symbol(name), self.results[name]), "linearised") for name in ("A", "B"))
        return *given, *whole

    @property
    def long(self) -> bool:
        return sum(operations(self.results[name]) for name in ("A", "B")) > LONGEST

    def _blocks(self) -> Iterator[Step]:
        """det D_0, then A_21, A_22 and B_2 as a matrix over it."""
        yield Step("det_0", (DET, self.problem.readable(self.det)), "blocks")
        routes = (negate(Product((INVERSE, Symbol(name)))) for name in ("K_0", "B_f"))
        for name, route, top in zip(("A_21", "A_22", "B_2"), (*routes, INVERSE), self.tops, strict=True):
            if top:
                value = Product((Quotient(ONE, DET), self.problem.readable_matrix(top)))
                yield Step(name, (Symbol(name), route, value), "blocks")

    @property
    def results(self) -> dict[str, Expr]:
        n = self.inertia.shape[0]
        slope, friction, inverse = (self._over(top) for top in self.tops)
        zeros = (ZERO,) * n
        above = [(*zeros, *(ONE if i == j else ZERO for j in range(n))) for i in range(n)]
        below = [(*slope[i], *friction[i]) for i in range(n)]
        B = Matrix((*(zeros for _ in range(n)), *inverse))
        return {
            "tau_0": self.problem.readable_matrix(self.torques),
            "A": Matrix((*above, *below)),
            "B": B,
        }

    def _over(self, top: ScalarMatrix) -> list[tuple[Expr, ...]]:
        """Rows over det D_0: reduced where the arm is small, as they are where that would take long."""
        return [tuple(map(self._quotient, row)) for row in top.rows]

    def _quotient(self, top: Scalar) -> Expr:
        if not top:
            return ZERO
        if self.inertia.shape[0] <= MOST_REDUCED or self.det.constant is not None:
            return self.problem.readable(top / self.det)
        return Quotient(self.problem.readable(top), self.problem.readable(self.det))

    @property
    def definitions(self) -> dict[Expr, Expr]:
        return named_results(step for step in self.steps if step.rule == "linearised")

    @property
    def claims(self) -> tuple[Claim, ...]:
        one = ScalarMatrix.identity(self.inertia.shape[0])
        # of long fractions the law below says as much as comparing them, and takes less time
        large = len(one.rows) > MOST_REDUCED
        compared = [step for step in self.steps if not (large and step.rule == "blocks")]
        return (
            *links(compared, {**self.problem.names, **self.definitions}),
            law("adjugate", self.inertia @ self.adjugate == one.scaled(self.det)),
            self._second_route(),
        )

    def _second_route(self) -> Claim:
        """A by differences of the accelerations, which Newton and Euler give."""
        arm = Oracle(_smooth(self.problem.subject), self.problem.where)
        A, names = self.results["A"], {name for part in self.at.values() for name in free_symbols(part)}
        return agreement(
            "differences",
            self.problem.symbols | {"g"} | names,
            lambda point: numeric.numbers(A, arm.at(point)),
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
    D = normal_matrix(matrix_of(motion, "D"), values)
    det = D.det()
    if not det:
        raise NotDerivable("D is singular there, so that the accelerations are not determined")
    K = normal_matrix(problem.readable_matrix(slope), values)
    found = Linear(problem, at, normal_matrix(g, values), D, K, _viscous(problem), det, D.adjugate())
    if max(len(entry.numerator) for top in found.tops for entry in top.entries) > MOST_TERMS:
        raise NotDerivable("the linearised equations would fill pages; give numbers to some of the symbols")
    return found


def _viscous(problem: Problem) -> ScalarMatrix:
    values = [
        normal((link.friction or Friction()).viscous, problem.names) for link in moving(problem.subject)
    ]
    return ScalarMatrix.of(
        [[value if i == j else 0 for j in range(len(values))] for i, value in enumerate(values)]
    )


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
