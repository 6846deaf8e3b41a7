"""Joint rates for a velocity: by the adjugate and the determinant, or by the pseudo-inverse."""

from __future__ import annotations

from dataclasses import dataclass
from math import comb

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import common_factor, primitive
from derive.errors import NotDerivable
from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    Call,
    Expr,
    Matrix,
    Number,
    Power,
    Product,
    Symbol,
    add,
    column,
    factors_of,
    is_negative,
    multiply,
    squared,
    symbols,
    transpose,
)
from derive.expression import replace as replaced
from derive.kinds.problem import Problem
from derive.kinds.robot._determinants import as_product, determinant, natural
from derive.kinds.robot._velocity.linear import collected
from derive.kinds.robot._velocity.task import Task
from derive.kinds.work import Work
from derive.mechanics.minors import minors

MOST_JOINTS = 4  # of an adjugate that is written out
MOST_MINORS = 35  # of those whose solutions are written out
MOST_TERMS = 1000  # of the matrix whose inverse is in the pseudo-inverse
J, V, RATES, A, PLUS = symbols("J v q_dot A J^+")
ADJ = Call("adj", (J,))


@dataclass(frozen=True, slots=True)
class Solved:
    """The board with the lines to qdot, and that written out; `exact` over `det` is its normal form. `zero`
    is the equation of the configurations in which it fails, without the factors that are known not to vanish
    (`apart`)."""

    way: str
    work: Work
    qdot: Expr
    exact: ScalarMatrix
    det: Scalar
    zero: tuple[Expr, ...]
    apart: Expr = ONE


def fills_pages(task: Task) -> bool:
    """Whether the rates as formulas would; the Jacobian says so before any is worked out."""
    m, n = task.J.shape
    least = min(m, n)
    if task.square:
        return n > MOST_JOINTS
    if least > MOST_JOINTS - 1 or (task.redundant and comb(n, m) > MOST_MINORS):
        return True
    return sum(len(entry.numerator) for row in _gram(task).rows for entry in row) > MOST_TERMS


def _gram(task: Task) -> ScalarMatrix:
    """J J^T, or J^T J where there are fewer joints than rows."""
    return task.J @ task.J.T if task.redundant else task.J.T @ task.J


def by_inverse(task: Task) -> Solved:
    """adj J / det J. Raises NotDerivable for a Jacobian that is singular everywhere."""
    problem, variables = task.problem, task.found.variables
    det, adjugate, velocity = task.J.det(), task.J.adjugate(), column(task.velocities)
    if not det:
        raise NotDerivable(
            f"the Jacobian of {', '.join(task.rows)} is singular in every configuration", "rows"
        )
    tree = as_product(problem, det, variables)
    inverse, shown = Call("inverse", (J,)), _over(tree, problem.readable_matrix(adjugate))
    exact = adjugate @ normal_matrix(velocity)
    qdot = column(quotient(problem, entry, det, variables, task.velocities) for entry in exact.entries)
    work = task.board().knowing({V: velocity})
    work = work.line(determinant(J), value=tree, rule="determinant", label="det")
    work = work.line(inverse, ADJ / determinant(J), value=shown, rule="adjugate", label="adj")
    work = work.line(RATES, inverse * V, value=qdot, rule="solve", label="qdot").closed(RATES)
    kept, apart = _vanishing(problem, _unsigned(tree))
    return Solved("adjugate", work, qdot, exact, det, (kept, ZERO), apart)


def _vanishing(problem: Problem, det: Expr) -> tuple[Expr, Expr]:
    """The factors that may vanish, and those that the sheet says do not."""
    apart = [each for each in factors_of(det) if _never_zero(problem, each)]
    kept = [each for each in factors_of(det) if each not in apart]
    return (multiply(*kept), multiply(*apart)) if kept else (det, ONE)


def _never_zero(problem: Problem, factor: Expr) -> bool:
    match factor:
        case Number(value):
            return value != 0
        case Power(base, _):
            return _never_zero(problem, base)
        case Symbol(name):
            return problem.assumptions.get(name) in ("positive", "nonzero")
    return False


def _unsigned(tree: Expr) -> Expr:
    return -tree if is_negative(tree) else tree


def _over(det: Expr, adjugate: Matrix) -> Expr:
    """adjugate / det, the sign in front."""
    factor = ONE / _unsigned(det)
    return Product((MINUS_ONE, factor, adjugate) if is_negative(det) else (factor, adjugate))


def by_pseudo_inverse(task: Task) -> Solved:
    """J^T (J J^T)^-1 v, the smallest rates; or (J^T J)^-1 J^T v, the smallest error.

    Raises NotDerivable for a Jacobian that is dependent everywhere.
    """
    turned, inverse = transpose(J), Call("inverse", (A,))
    plus = Product((turned, inverse) if task.redundant else (inverse, turned))
    gram = _gram(task)
    det = gram.det()
    if not det:
        raise NotDerivable(f"the rows {', '.join(task.rows)} are dependent in every configuration", "rows")
    made, qdot, exact = _by_minors(task) if task.redundant else _by_gram(task, gram, det)
    work = task.board().knowing({V: column(task.velocities), PLUS: plus})
    work = work.line(A, Product((J, turned) if task.redundant else (turned, J)), value=gram, rule="gram")
    work = work.step(*made.steps)
    formulas = PLUS * V, Product((*plus.factors, V))
    work = work.line(RATES, *formulas, value=qdot, rule="solve", label="qdot")
    minors_named = {step.chain[0]: step.result for step in work.steps if step.rule == "minor"}
    return Solved("pseudo-inverse", work, replaced(qdot, minors_named), exact, det, (determinant(A), ZERO))


def _by_minors(task: Task) -> tuple[Work, Matrix, ScalarMatrix]:
    """The mean of the solutions with as many joints as rows, each weighted by the square of its minor: it
    is J^+ v (Ben-Israel, 1992), and det A is the sum of those squares (Cauchy and Binet). With qdot in the
    names of the minors, and in normal form times det A."""
    problem, variables, velocity = task.problem, task.found.variables, normal_matrix(column(task.velocities))
    found = [minor for minor in minors(task.J) if minor.value]
    names = [Symbol("Delta_" + "".join(str(k + 1) for k in minor.lines)) for minor in found]
    work = Work(problem)
    for place, (name, minor) in enumerate(zip(names, found, strict=True)):
        tree = as_product(problem, minor.value, variables)
        work = work.line(name, value=tree, rule="minor", label=f"minor_{place}")
    squares = add(*map(squared, names))
    work = work.line(determinant(A), value=squares, rule="cauchy-binet", label="det")
    parts = [task.J.columns(*minor.lines).adjugate() @ velocity for minor in found]
    rows, exact = [], []
    for joint in range(len(variables)):
        terms = [
            (name, minor.value, part[minor.lines.index(joint), 0])
            for name, minor, part in zip(names, found, parts, strict=True)
            if joint in minor.lines
        ]
        total = add(*(multiply(name, problem.readable(value)) for name, _, value in terms if value))
        rows.append(total / squares)
        exact.append(sum((minor * value for _, minor, value in terms), Scalar.of(0)))
    return work, column(rows), ScalarMatrix.column(exact)


def _by_gram(task: Task, gram: ScalarMatrix, det: Scalar) -> tuple[Work, Matrix, ScalarMatrix]:
    """The adjugate of J^T J over its determinant, times J^T v: qdot, and the same times the determinant."""
    problem, variables = task.problem, task.found.variables
    adjugate = gram.adjugate()
    exact = adjugate @ (task.J.T @ normal_matrix(column(task.velocities)))
    qdot = column(quotient(problem, entry, det, variables, task.velocities) for entry in exact.entries)
    tree = as_product(problem, det, variables)
    work = Work(problem).line(determinant(A), value=tree, rule="determinant", label="det")
    shown = ONE / determinant(A) * problem.readable_matrix(adjugate)
    return work.line(Call("inverse", (A,)), value=shown, rule="adjugate", label="A_inv"), qdot, exact


def quotient(
    problem: Problem,
    top: Scalar,
    bottom: Scalar,
    variables: tuple[str, ...],
    components: tuple[Symbol, ...] = (),
) -> Expr:
    """A fraction without what both sides share, its denominator factored, and a sign in front of it; with
    `components` above a term for each of these."""
    if not top:
        return ZERO
    if top.denominator is None and bottom.denominator is None:
        _, (top, bottom) = common_factor([top, bottom], variables)
        number = _shared_number(problem, bottom, variables)
        top, bottom = top / number, bottom / number
    if bottom.constant is not None:
        return _above(problem, top / bottom, components)
    below = as_product(problem, bottom, variables)
    if is_negative(below):
        top, below = -top, -below
    above = _above(problem, top, components)
    if components and is_negative(above):
        return -(_above(problem, -top, components) / below)
    return above / below


def _above(problem: Problem, value: Scalar, components: tuple[Symbol, ...]) -> Expr:
    return collected(problem, value, components) if components else problem.readable(value)


def _shared_number(problem: Problem, value: Scalar, variables: tuple[str, ...]) -> Scalar:
    """The number in front of a denominator, which the numerator takes over."""
    front = natural(problem, value, variables).constant
    return front / primitive(front)
