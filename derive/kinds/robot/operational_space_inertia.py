"""The inertia that the end-effector of an arm shows to a force: D seen through the Jacobian."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    Call,
    Expr,
    Matrix,
    Power,
    Product,
    Quotient,
    Symbol,
    children,
    number,
    transpose,
)
from derive.kinds.checks import agreement, law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import matrix_of, moment_names
from derive.kinds.robot._dynamics.rates import is_long, oracle
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._velocity.solving import quotient
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.mechanics.oracle import Oracle
from derive.mechanics.robot import Robot

RESULTS = {
    "J": "the square Jacobian of the rows (n by n)",
    "J_inv": "its inverse",
    "Lambda": "J^-T D J^-1 (n by n)",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: The inertia at the hand
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [0, 0, 0], inertia: point}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [0, 0, 0], inertia: point}
  find: operational-space-inertia
  rows: [vx, vy]
"""
MOST_JOINTS = 3
LONGEST = 90  # operations of a matrix that is still written out
JACOBIAN, INERTIA, LAMBDA = Symbol("J"), Symbol("D"), Symbol("Lambda")
INVERSE = Power(JACOBIAN, number(-1))


class Options(OptionsModel):
    """`point`: where (the end-effector if left out); `rows`: as many velocities as there are joints."""

    point: PointOn | None = None
    rows: tuple[RowName, ...] = ()


class Facts(PageFacts):
    rows: tuple[Expr, ...]
    short: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Lambda = J^-T D J^-1 (Khatib, A unified approach for motion and force control, 1987, eq. 51)."""
    inertia = problem.ask("inertia-matrix")
    if is_long(problem):
        raise NotDerivable("the matrix would fill pages; give numbers to some of the symbols of the arm")
    task = task_of(problem, options.rows, options.point)
    J = _square(task)
    D = matrix_of(inertia, "D")
    det, adjugate = J.det(), J.adjugate()
    whole = adjugate.T @ normal_matrix(D) @ adjugate  # Lambda times the square of det J
    Lambda = _over(problem, whole, det * det)
    steps = (task.step, *_steps(problem, J, Lambda))
    results = {
        "J": problem.final(task.written),
        "J_inv": problem.final(_over(problem, adjugate, det)),
        "Lambda": problem.final(Lambda),
    }
    definitions: dict[Expr, Expr] = {
        **inertia.definitions,
        JACOBIAN: task.written,
        INERTIA: D,
        LAMBDA: results["Lambda"],
    }
    known = {**problem.names, **definitions, **moment_names(inertia)}
    claims = (
        *links(steps, known),
        law("symmetric", whole == whole.T),
        law("kinetic-energy", J.T @ whole @ J == normal_matrix(D).scaled(det * det)),
        _second_route(problem, task, results["Lambda"]),
    )
    return Derivation(
        "operational-space-inertia",
        steps,
        results,
        claims,
        definitions,
        uses=(task.base, inertia),
        facts=Facts(rows=task.velocities, short=len(steps[-1].chain) > 2),
        matrices=frozenset(results),
    )


def _square(task: Task) -> ScalarMatrix:
    """J, if it has an inverse anywhere. Raises NotDerivable."""
    n = len(task.rates)
    if n > MOST_JOINTS:
        raise NotDerivable(
            f"the operational-space inertia is worked out for at most {MOST_JOINTS} joints; this arm has {n}"
        )
    if not task.square:
        m = len(task.rows)
        raise NotDerivable(f"J must be square: give {n} rows for {n} joints, not {m}, as rows: [vx, vy]")
    if not task.J.det():
        rows = ", ".join(task.rows)
        raise NotDerivable(f"the rows {rows} of J are dependent everywhere; choose others, as rows: [vx, vy]")
    return task.J


def _over(problem: Problem, top: ScalarMatrix, bottom: Scalar) -> Matrix:
    """A matrix over a scalar, entry by entry, what they share left out."""
    names = problem.subject.variables
    return Matrix(tuple(tuple(quotient(problem, each, bottom, names) for each in row) for row in top.rows))


def _steps(problem: Problem, J: ScalarMatrix, written: Matrix) -> tuple[Step, ...]:
    """det J, the inverse of J, and Lambda, written out where they are not too long."""
    det = Step("det", (Call("det", (JACOBIAN,)), problem.readable(J.det())), "determinant")
    adjugate = problem.readable_matrix(J.adjugate())
    over = Product((Quotient(ONE, det.chain[0]), adjugate))
    inverse = Step("J_inv", (INVERSE, over), "inverse")
    product = Product((transpose(INVERSE), INERTIA, INVERSE))
    short = sum(map(operations, children(written))) <= LONGEST
    chain = (LAMBDA, product, problem.final(written)) if short else (LAMBDA, product)
    return det, inverse, Step("Lambda", chain, "operational")


def _second_route(problem: Problem, task: Task, Lambda: Expr) -> Claim:
    """D by Newton and Euler and J by differences of the poses."""
    arm = oracle(problem)

    def other(at: Mapping[str, float]) -> Any:
        import numpy as np

        J = np.linalg.inv(task.numbers(at))
        return J.T @ _inertia(arm, at, problem.subject.variables) @ J

    return agreement(
        "in-numbers",
        task.symbols | {"g"},
        lambda at: numeric.numbers(Lambda, arm.at(at)),
        other,
        tolerance=1e-6,
    )


def _inertia(arm: Oracle, at: Mapping[str, float], names: tuple[str, ...]) -> Any:
    """D in numbers: the torques of unit accelerations."""
    import numpy as np

    still = {f"{name}_{dots}": 0.0 for name in names for dots in ("dot", "ddot")}
    rest = arm.torques({**at, **still})
    return np.array([arm.torques({**at, **still, f"{name}_ddot": 1.0}) - rest for name in names])
