"""The inertia that the end-effector of an arm shows to a force: D seen through the Jacobian."""

from __future__ import annotations

from typing import Any

from derive.algebra.bounds import no_charge
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import Point, matrix_numbers, numbers
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Result, Step
from derive.errors import NotDerivable, TooManyTerms
from derive.expression import (
    ONE,
    PI,
    Call,
    Expr,
    Matrix,
    Product,
    Symbol,
    number,
    replace,
    symbols,
    transpose,
    walk,
)
from derive.kinds.checks import close, route
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.linear_systems import solution_at
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import BODIES_ALONE
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.at_a_point import AtAPoint, at_a_point, rounded
from derive.kinds.robot._dynamics.inertia_seen import inertia_at, inertia_by_equations, shown_as
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._velocity.solving import quotient
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.kinds.work import Work
from derive.mechanics.robot import Robot
from derive.mechanics.task import moving_rows
from derive.names import require_free

CLAIMED = {"J_inv": "in-numbers", "Lambda": "lambda-at-a-point", "D": "at-a-point"}
INTRODUCED = r"j_[\d,]+"  # entries of J

NEEDS = ("bodies",)
CLAIMS = (
    "symmetric|equations-hold|at-a-point",
    "kinetic-energy|equations-hold|at-a-point",
    "in-numbers|solved|lambda-at-a-point",
)
MOST_JOINTS = 3
MOST_TERMS = 9_000  # of D; with more not even equations are told
J, D, LAMBDA = symbols("J D Lambda")
DET, INVERSE = Call("det", (J,)), J**-1


class Options(OptionsModel):
    """Of which velocities, of which point."""

    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""
    rows: tuple[RowName, ...] = ()
    """The velocities that count, no more than there are joints."""
    evaluate: Evaluation = None


class Facts(PageFacts):
    rows: tuple[Expr, ...]
    redundant: bool = False
    at_a_point: bool = False  # in numbers alone


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Lambda = J^-T D J^-1 (Khatib, A unified approach for motion and force control, 1987, eq. 51).

    Of more than three joints, of an arm whose D is long, and where there are more joints than rows, the
    linear equations for it; where they are too long, its numbers at a point. Raises NotDerivable where the
    rows of J are dependent everywhere.
    """
    require_free(problem.taken, "Lambda")
    task = _task(problem, options)
    try:
        return _in_letters(problem, task)
    except TooManyTerms as error:
        with no_charge():  # what was spent on letters is gone
            return _numbers_alone(task, at_a_point(problem, options.evaluate, error, forces=False))


def _in_letters(problem: Problem, task: Task) -> Derivation:
    arm = Arm(problem)
    arm.refuse_long(MOST_TERMS)
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
    """The rows asked for; else those the arm is built for, and only linear ones where it has fewer joints, as
    many as it has. Raises NotDerivable where rows are more than joints."""
    task = task_of(problem, options.rows, options.point)
    if not options.rows and len(task.rows) > len(task.rates):
        linear, _ = moving_rows(task.whole)
        task = task_of(problem, tuple(linear)[: len(task.rates)], options.point)
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
    return work.answer(
        "operational-space-inertia", results, facts, matrices=frozenset(results), unread=BODIES_ALONE
    )


def _numbers_alone(task: Task, there: AtAPoint) -> Derivation:
    """J, D and Lambda where every name has a value."""
    import numpy as np

    jacobian = np.array(matrix_numbers(task.J, there.at))
    shown = np.linalg.inv(jacobian @ np.linalg.solve(there.motion.D, jacobian.T))
    told = {"J": jacobian, "D": there.motion.D, "Lambda": shown}
    results = {name: rounded(value) for name, value in told.items()}
    formula = (LAMBDA, Product((J, D**-1, transpose(J))) ** -1)
    steps = [Step(name, (Symbol(name), results[name]), "at-a-point") for name in ("J", "D")]
    steps += [Step("seen", formula, "unsolved"), Step("Lambda", (LAMBDA, results["Lambda"]), "at-a-point")]
    work = Work(there.problem).showing(*steps).claim(there.claim(D=results["D"]))
    work = work.claim(shown_as(task, Arm(there.problem), formula))
    seen = (task.numbers(there.at), inertia_at(task, Arm(there.problem), there.at))
    pairs = zip((results["J"], results["Lambda"]), seen, strict=True)
    work = work.claim(route("lambda-at-a-point", (close(numbers(a, {}), b, 1e-6) for a, b in pairs)))
    facts = Facts(rows=task.velocities, at_a_point=True, by_joint=("D",), forms=("Lambda",), numbers=())
    evaluated = {name: value.tolist() for name, value in told.items()}
    return work.answer(
        "operational-space-inertia", results, facts, matrices=frozenset(results), evaluated=evaluated
    )


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
