"""The inertia that the end-effector of an arm shows to a force: D seen through the Jacobian."""

from __future__ import annotations

from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import Point, numbers
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Result
from derive.errors import NotDerivable
from derive.expression import ONE, PI, Call, Expr, Matrix, Symbol, number, replace, symbols, transpose, walk
from derive.kinds.fields import OptionsModel
from derive.kinds.linear_systems import solution_at
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.inertia_seen import inertia_at, inertia_by_equations
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._velocity.solving import quotient
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.mechanics.robot import Robot
from derive.mechanics.task import moving_rows
from derive.names import require_free

CLAIMED = {"J_inv": "in-numbers"}

NEEDS = ("bodies",)
CLAIMS = ("symmetric|equations-hold", "kinetic-energy|equations-hold", "in-numbers|solved")
MOST_JOINTS = 3
J, D, LAMBDA = symbols("J D Lambda")
DET, INVERSE = Call("det", (J,)), J**-1


class Options(OptionsModel):
    """Of which velocities, of which point."""

    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""
    rows: tuple[RowName, ...] = ()
    """The velocities that count, no more than there are joints."""


class Facts(PageFacts):
    rows: tuple[Expr, ...]
    redundant: bool = False


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Lambda = J^-T D J^-1 (Khatib, A unified approach for motion and force control, 1987, eq. 51).

    Of more than three joints, of an arm whose D is long, and where there are more joints than rows, the
    linear equations for it. Raises NotDerivable where the rows of J are dependent everywhere.
    """
    require_free(problem.taken, "Lambda")
    arm = Arm(problem)
    task = _task(problem, options)
    if len(task.rates) > MOST_JOINTS or arm.long or not task.square:
        return _as_equations(task, arm)
    jacobian = _regular(task)
    work = task.board().resting_on(arm.inertia).knowing({D: arm.inertia.matrix("D")})
    inertia, det, adjugate = normal_matrix(work[D]), jacobian.det(), jacobian.adjugate()
    whole = adjugate.T @ inertia @ adjugate  # Lambda times the square of det J
    written = _over(problem, whole, det * det)
    over = ONE / DET * work.readable(adjugate)
    work = work.line(DET, value=det, label="det", rule="determinant")
    work = work.line(INVERSE, value=over, label="J_inv", rule="inverse")
    product, result = transpose(INVERSE) * D * INVERSE, problem.final(written)
    work = work.line(LAMBDA, product, value=result, rule="operational")
    work = work.law("symmetric", whole == whole.T)
    work = work.law("kinetic-energy", jacobian.T @ whole @ jacobian == inertia.scaled(det * det))
    results = {
        "J": work.final(J),
        "J_inv": problem.final(_over(problem, adjugate, det)),
        "Lambda": result,
    }
    work = work.agrees(
        "in-numbers",
        task.symbols | {"g"},
        lambda at: [numbers(each, at) for each in results.values()],
        lambda at: _in_numbers(task, arm, at),
        tolerance=1e-6,
    )
    facts = Facts(rows=task.velocities)
    return work.answer("operational-space-inertia", results, facts, matrices=frozenset(results))


def _task(problem: Problem, options: Options) -> Task:
    """The rows asked for; else those the arm is built for, and only linear ones where it has fewer joints.
    Raises NotDerivable where rows are more than joints."""
    task = task_of(problem, options.rows, options.point)
    if not options.rows and len(task.rows) > len(task.rates):
        linear, _ = moving_rows(task.whole)
        task = task_of(problem, tuple(linear), options.point)
    m, n = task.J.shape
    if m > n:
        raise NotDerivable(
            f"{m} rows are more than the {n} joints can move; give fewer, as rows: [vx, vy]", "rows"
        )
    return task


def _as_equations(task: Task, arm: Arm) -> Derivation:
    """Lambda by linear equations, J and D in them by their entries."""
    system, work = inertia_by_equations(task, arm)
    work = work.agrees(
        "solved",
        task.symbols | {"g"},
        lambda at: solution_at(system, at),
        lambda at: inertia_at(task, arm, at),
        tolerance=1e-6,
    )
    results: dict[str, Result] = {
        "J": task.problem.final(task.written),
        "D": arm.inertia.results["D"],
        "Lambda": system,
    }
    facts = Facts(rows=task.velocities, redundant=not task.square, by_joint=("D",), forms=("Lambda",))
    return work.answer("operational-space-inertia", results, facts, matrices=frozenset(results))


def _regular(task: Task) -> ScalarMatrix:
    """J, if it has an inverse anywhere. Raises NotDerivable."""
    if not task.J.det():
        rows = ", ".join(task.rows)
        raise NotDerivable(
            f"the rows {rows} of J are dependent everywhere; choose others, as rows: [vx, vy]", "rows"
        )
    return task.J


def _over(problem: Problem, top: ScalarMatrix, bottom: Scalar) -> Matrix:
    """A matrix over a scalar, entry by entry, what they share left out."""
    names = problem.subject.variables
    return Matrix(tuple(tuple(_quotient(problem, each, bottom, names) for each in row) for row in top.rows))


def _quotient(problem: Problem, top: Scalar, bottom: Scalar, names: tuple[str, ...]) -> Expr:
    """An entry as it is written, or in sines of the first angle where a quarter turn on it has only cosines:
    the same in x as in y."""
    found, angle = quotient(problem, top, bottom, names), Symbol(names[0])
    more: dict[Expr, Expr] = {angle: angle + PI * number("1/2")}
    above, below = (normal(replace(problem.readable(each), more)) for each in (top, bottom))
    further = quotient(problem, above, below, names)
    calls = [each for each in walk(further) if isinstance(each, Call) and angle in walk(each)]
    sines = replace(further, {call: Call("sin", call.arguments) for call in calls})
    if any(call.function != "cos" for call in calls) or normal(sines) * bottom != top:
        return found
    return min(found, sines, key=operations)


def _in_numbers(task: Task, arm: Arm, at: Point) -> Any:
    """J by differences of the poses, its inverse, and Lambda with D by Newton and Euler."""
    import numpy as np

    J_now = task.numbers(at)
    inverse = np.linalg.inv(J_now)
    return J_now, inverse, inverse.T @ arm.rigid.inertia_matrix(at) @ inverse
