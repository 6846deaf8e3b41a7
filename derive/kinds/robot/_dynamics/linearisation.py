"""The equations of motion about rest: D_0, the slope of gravity, friction, and A and B of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal, normal_matrix
from derive.algebra.numbers.floats import Point, number, numbers
from derive.algebra.readable.form import common_factor
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Step
from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Call, Expr, Matrix, Symbol, children, free_symbols
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.drives import diagonal, moving
from derive.kinds.robot._dynamics.matrix_laws import linear_laws
from derive.kinds.work import Work
from derive.mechanics.drives import Friction
from derive.mechanics.oracle import Oracle, slope
from derive.mechanics.robot import Robot

MOST_WHOLE = 80  # operations of A and B together; longer ones are worked block by block
MOST_BESIDE = 12  # operations of an entry that stands in a matrix over the determinant
MOST_REDUCED = 2  # joints; with more, common factors of fractions are not looked for
MOST_TERMS = 600  # of an entry of A times the determinant
D_0 = Symbol("D_0")
INVERSE, DET = D_0**-1, Call("det", (D_0,))
STEP = 1e-4  # of differences; what they leave is about its square
LEFT = 1e-5


@dataclass(frozen=True)
class Linear:
    """An arm at an equilibrium: the joint forces that hold it (n by 1), its D_0, the slope K_0 of gravity and
    its viscous friction F_v (n by n)."""

    problem: Problem
    at: Mapping[str, Expr]
    torques: ScalarMatrix
    inertia: ScalarMatrix
    slope: ScalarMatrix
    friction: ScalarMatrix

    @cached_property
    def det(self) -> Scalar:
        """The determinant of D_0."""
        return self.inertia.det()

    @cached_property
    def tops(self) -> tuple[ScalarMatrix, ScalarMatrix, ScalarMatrix]:
        """The lower blocks A_21, A_22 and B_2 (n by n), times det D_0."""
        adjugate = self.inertia.adjugate()
        return -(adjugate @ self.slope), -(adjugate @ self.friction), adjugate

    @cached_property
    def A(self) -> Matrix:
        """Of dx/dt = A x + B u for x = (q, qdot) (2n by 2n)."""
        n = range(len(self.at_rest))
        above = [(*self.at_rest, *(ONE if i == j else ZERO for j in n)) for i in n]
        slope, friction, _ = map(self._over, self.tops)
        return Matrix((*above, *((*slope[i], *friction[i]) for i in n)))

    @cached_property
    def B(self) -> Matrix:
        """Of the same (2n by n)."""
        return Matrix((*(self.at_rest for _ in self.at_rest), *self._over(self.tops[2])))

    @property
    def at_rest(self) -> tuple[Expr, ...]:
        """A row of zeros (n)."""
        return (ZERO,) * self.inertia.shape[0]

    @property
    def long(self) -> bool:
        """Whether A and B are shown block by block."""
        return operations(self.A) + operations(self.B) > MOST_WHOLE

    def _over(self, top: ScalarMatrix) -> list[tuple[Expr, ...]]:
        """Rows over det D_0: reduced where the arm is small, as they are where that would take long."""
        return [tuple(map(self._quotient, row)) for row in top.rows]

    def _quotient(self, top: Scalar) -> Expr:
        if not top:
            return ZERO
        if self.inertia.shape[0] <= MOST_REDUCED or self.det.constant is not None:
            return self.problem.readable(top / self.det)
        return self.problem.readable(top) / self.problem.readable(self.det)


def linear_at(problem: Problem, at: Mapping[str, Expr]) -> Linear:
    """About rest at these values of joint variables. Raises NotDerivable where D has no inverse there, and
    for names that are no joint variables."""
    names, motion = problem.subject.variables, problem.ask("dynamics")
    strange = [name for name in at if name not in names]
    if strange:
        raise NotDerivable(f"at: {strange[0]} is no joint variable; they are {', '.join(names)}", "at")
    values: Names = {**problem.names, **{Symbol(name): value for name, value in at.items()}}
    g = motion.matrix("g")
    slope = ScalarMatrix.of([[normal(entry).diff(name) for name in names] for (entry,) in g.rows])
    D = normal_matrix(motion.matrix("D"), values)
    if not D.det():
        raise NotDerivable("D is singular there, so that the accelerations are not determined")
    K = normal_matrix(problem.readable_matrix(slope), values)
    found = Linear(problem, at, normal_matrix(g, values), D, K, _viscous(problem))
    if max(len(entry.numerator) for top in found.tops for entry in top.entries) > MOST_TERMS:
        raise NotDerivable("the linearised equations would fill pages; give numbers to some of the symbols")
    return found


def linearised(work: Work, linear: Linear) -> Work:
    """With tau_0, D_0, K_0, where there is friction F_v, then A and B; of long ones the blocks that are not
    plain, over the determinant of D_0 that they share."""
    found = {"tau_0": linear.torques, "D_0": linear.inertia, "K_0": linear.slope}
    found |= {"F_v": linear.friction} if linear.friction else {}
    at_rest, slope, *state = linear_laws(linear.problem.taken, bool(linear.friction))
    for name, value in found.items():
        work = work.line(name, value=value, rule="linearised")
        work = work.showing(at_rest, slope) if name == "tau_0" else work
    work = work.showing(*state)
    if linear.long:
        work = work.showing(*_blocks(linear))
    else:
        work = work.line("A", value=linear.A, rule="linearised").line("B", value=linear.B, rule="linearised")
    # of long fractions the law below says as much as comparing them, and takes less time
    large = len(linear.at_rest) > MOST_REDUCED
    work = work.linked(but=[step.name for step in work.steps if large and step.rule == "blocks"])
    one, adjugate = ScalarMatrix.identity(len(linear.at_rest)), linear.tops[2]
    work = work.law("adjugate", linear.inertia @ adjugate == one.scaled(linear.det))
    problem = linear.problem
    arm = Oracle(_smooth(problem.subject), problem.where)
    names = {name for part in linear.at.values() for name in free_symbols(part)}
    return work.agrees(
        "differences",
        problem.symbols | {"g"} | names,
        lambda point: [numbers(each, point) for each in (*map(work.matrix, found), linear.A, linear.B)],
        lambda point: _differences(arm, linear.at, point, bool(linear.friction)),
        LEFT,
    )


def _blocks(linear: Linear) -> Iterator[Step]:
    """det D_0, then A_21, A_22 and B_2 as a matrix over it."""
    yield Step("det_0", (DET, linear.problem.readable(linear.det)), "blocks")
    routes = (-(INVERSE * Symbol("K_0")), -(INVERSE * Symbol("F_v")), INVERSE)
    for name, route, top in zip(("A_21", "A_22", "B_2"), routes, linear.tops, strict=True):
        if top:
            yield Step(name, (Symbol(name), route, _over_det(linear.problem, top)), "blocks")


def _over_det(problem: Problem, value: ScalarMatrix) -> Expr:
    """A matrix over det D_0 and times what its entries share; entry by entry where these are long, so that a
    page can name them."""
    shared, top = common_factor(value), problem.readable_matrix(value)
    if shared is not None and value.shape[0] <= MOST_REDUCED:
        rest = problem.readable_matrix(value.map(lambda entry: entry / shared))
        return problem.readable(shared) / DET * rest
    if max(map(operations, children(top))) <= MOST_BESIDE:
        return (ONE / DET) * top
    return Matrix(tuple(tuple(entry if entry == ZERO else entry / DET for entry in row) for row in top.rows))


def _viscous(problem: Problem) -> ScalarMatrix:
    """F_v."""
    frictions = (link.friction or Friction() for link in moving(problem.subject))
    return normal_matrix(diagonal(each.viscous for each in frictions), problem.names)


def _smooth(robot: Robot) -> Robot:
    """Without Coulomb friction, which has no slope at rest."""
    kept = (
        replace(link, friction=Friction(link.friction.viscous) if link.friction else None)
        for link in robot.links
    )
    return replace(robot, links=tuple(kept))


def _differences(arm: Oracle, at: Mapping[str, Expr], point: Point, rubs: bool) -> Any:
    """tau_0 (n), D_0, K_0, where there is friction F_v (n by n), A (2n by 2n) and B (2n by n) by central
    differences of torques and of dx/dt about rest, the forces those of rest."""
    import numpy as np

    names = arm.robot.variables
    rest = {**point, **{name: number(value, point) for name, value in at.items()}}
    rest |= {f"{name}_{dots}": 0.0 for name in names for dots in ("dot", "ddot")}
    forces = arm.torques(rest)
    speeds, still = [f"{name}_dot" for name in names], arm.inertia_matrix(rest)

    def slopes(value: Callable[[Point], Any], along: Iterable[str]) -> Any:
        return np.array([slope(value, rest, {name: 1}, STEP) for name in along]).T

    found = [forces, still, slopes(arm.torques, names), *([slopes(arm.torques, speeds)] if rubs else [])]
    B = np.vstack([np.zeros_like(still), np.linalg.inv(still)])
    return [*found, slopes(lambda state: _rates(arm, state, forces), (*names, *speeds)), B]


def _rates(arm: Oracle, at: Point, forces: Any) -> Any:
    """dx/dt at a state."""
    import numpy as np

    rise = np.linalg.solve(arm.inertia_matrix(at), forces - arm.torques(at))
    return np.concatenate([[at[f"{name}_dot"] for name in arm.robot.variables], rise])
