"""Joint rates for a velocity: by the adjugate and the determinant, or by the pseudo-inverse."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import common_factor, primitive
from derive.derivation import Step
from derive.errors import NotDerivable
from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    Call,
    Expr,
    Matrix,
    Product,
    Quotient,
    Symbol,
    add,
    column,
    is_negative,
    multiply,
    negate,
    squared,
    transpose,
)
from derive.expression import replace as replaced
from derive.kinds.chains import closing
from derive.kinds.problem import Problem
from derive.kinds.robot._singular.determinants import determinant, natural, product_tree
from derive.kinds.robot._velocity.task import Task
from derive.mechanics.minors import minors

MOST_JOINTS = 4  # of an adjugate that is written out
J, V, RATES = Symbol("J"), Symbol("v"), Symbol("q_dot")
ADJ = Call("adj", (J,))
PLUS = Symbol("J^+")


@dataclass(frozen=True, slots=True)
class Solved:
    """The steps to qdot, written out as `qdot`; `exact` over `det` is its normal form. `zero` is the
    equation of the configurations in which it fails."""

    way: str
    steps: tuple[Step, ...]
    qdot: Expr
    exact: ScalarMatrix
    det: Scalar
    definitions: dict[Expr, Expr]
    zero: tuple[Expr, ...]


def by_inverse(task: Task) -> Solved:
    """adj J / det J. Raises NotDerivable for a Jacobian too large, or singular everywhere."""
    problem, variables = task.problem, task.found.variables
    if len(variables) > MOST_JOINTS:
        raise NotDerivable(
            f"the inverse of a Jacobian of {len(variables)} joints fills pages where no spherical wrist "
            "splits it in two; put numbers into the Jacobian, or ask for fewer rows"
        )
    det = task.J.det()
    if not det:
        raise NotDerivable(f"the Jacobian of {', '.join(task.rows)} is singular in every configuration")
    tree = product_tree(problem, natural(problem, det, variables))
    adjugate = task.J.adjugate()
    shown = problem.readable_matrix(adjugate)
    velocity = column(task.velocities)
    exact = adjugate @ normal_matrix(velocity)
    qdot = column(quotient(problem, entry, det, variables) for entry in exact.entries)
    inverse = Call("inverse", (J,))
    steps = (
        task.step,
        Step("det", (determinant(J), tree), "determinant"),
        Step("adj", (inverse, Quotient(ADJ, determinant(J)), _over(tree, shown)), "adjugate"),
        closing(Step("qdot", (RATES, Product((inverse, V)), qdot), "solve"), problem.final(qdot)),
    )
    definitions: dict[Expr, Expr] = {J: task.written, V: velocity, RATES: qdot}
    return Solved("adjugate", steps, qdot, exact, det, definitions, (_unsigned(tree), ZERO))


def _unsigned(tree: Expr) -> Expr:
    return negate(tree) if is_negative(tree) else tree


def _over(det: Expr, adjugate: Matrix) -> Expr:
    """adjugate / det, the sign in front."""
    factor = Quotient(ONE, _unsigned(det))
    return Product((MINUS_ONE, factor, adjugate) if is_negative(det) else (factor, adjugate))


def by_pseudo_inverse(task: Task) -> Solved:
    """J^T (J J^T)^-1 v, the smallest rates; or (J^T J)^-1 J^T v, the smallest error.

    Raises NotDerivable for a Jacobian too large, and for one that is dependent everywhere.
    """
    turned, A = transpose(J), Symbol("A")
    gram_name = Product((J, turned)) if task.redundant else Product((turned, J))
    gram = task.J @ task.J.T if task.redundant else task.J.T @ task.J
    if gram.shape[0] > MOST_JOINTS - 1:
        raise NotDerivable("the pseudo-inverse of so large a Jacobian fills pages; ask for fewer rows")
    det = gram.det()
    if not det:
        raise NotDerivable(f"the rows {', '.join(task.rows)} are dependent in every configuration")
    made = _by_minors(task) if task.redundant else _by_gram(task, gram, det)
    plus = (
        Product((turned, Call("inverse", (A,))))
        if task.redundant
        else Product((Call("inverse", (A,)), turned))
    )
    chain = (RATES, Product((PLUS, V)), Product((*plus.factors, V)), made.qdot)
    A_step = Step("A", (A, gram_name, task.problem.readable_matrix(gram)), "gram")
    steps = (task.step, A_step, *made.steps, Step("qdot", chain, "solve"))
    velocity = column(task.velocities)
    definitions: dict[Expr, Expr] = {
        J: task.written, A: A_step.result, V: velocity, RATES: made.qdot, PLUS: plus, **made.minors
    }  # fmt: skip
    qdot = made.qdot if not made.minors else replaced(made.qdot, made.minors)
    zero = (determinant(A), ZERO)
    return Solved("pseudo-inverse", steps, qdot, made.exact, det, definitions, zero)


@dataclass(frozen=True, slots=True)
class _Made:
    """The steps between A and qdot, qdot in the names of the minors and in normal form times det A."""

    steps: tuple[Step, ...]
    qdot: Matrix
    exact: ScalarMatrix
    minors: dict[Expr, Expr]


def _by_minors(task: Task) -> _Made:
    """The mean of the solutions with as many joints as rows, each weighted by the square of its minor: it
    is J^+ v (Ben-Israel, 1992), and det A is the sum of those squares (Cauchy and Binet)."""
    problem, variables, velocity = task.problem, task.found.variables, normal_matrix(column(task.velocities))
    found = [minor for minor in minors(task.J) if minor.value]
    names: list[Expr] = [Symbol("Delta_" + "".join(str(k + 1) for k in minor.lines)) for minor in found]
    trees = [product_tree(problem, natural(problem, minor.value, variables)) for minor in found]
    steps = [
        Step(f"minor_{place}", (name, tree), "minor")
        for place, (name, tree) in enumerate(zip(names, trees, strict=True))
    ]
    squares = add(*map(squared, names))
    steps.append(Step("det", (determinant(Symbol("A")), squares), "cauchy-binet"))
    parts = [task.J.columns(*minor.lines).adjugate() @ velocity for minor in found]
    rows, exact = [], []
    for joint in range(len(variables)):
        terms = [
            (name, minor.value, part[minor.lines.index(joint), 0])
            for name, minor, part in zip(names, found, parts, strict=True)
            if joint in minor.lines
        ]
        total = add(*(multiply(name, problem.readable(value)) for name, _, value in terms if value))
        rows.append(Quotient(total, squares))
        exact.append(sum((minor * value for _, minor, value in terms), Scalar.of(0)))
    return _Made(tuple(steps), column(rows), ScalarMatrix.column(exact), dict(zip(names, trees, strict=True)))


def _by_gram(task: Task, gram: ScalarMatrix, det: Scalar) -> _Made:
    """The adjugate of J^T J over its determinant, times J^T v."""
    problem, variables, A = task.problem, task.found.variables, Symbol("A")
    adjugate = gram.adjugate()
    tree = product_tree(problem, natural(problem, det, variables))
    exact = adjugate @ (task.J.T @ normal_matrix(column(task.velocities)))
    qdot = column(quotient(problem, entry, det, variables) for entry in exact.entries)
    shown = Product((Quotient(ONE, determinant(A)), problem.readable_matrix(adjugate)))
    steps = (
        Step("det", (determinant(A), tree), "determinant"),
        Step("A_inv", (Call("inverse", (A,)), shown), "adjugate"),
    )
    return _Made(steps, qdot, exact, {})


def quotient(problem: Problem, top: Scalar, bottom: Scalar, variables: tuple[str, ...]) -> Expr:
    """A fraction without what both sides share, its denominator factored."""
    if not top:
        return ZERO
    if top.denominator is None and bottom.denominator is None:
        _, (top, bottom) = common_factor([top, bottom], variables)
        number = _shared_number(problem, bottom, variables)
        top, bottom = top / number, bottom / number
    if bottom.constant is not None:
        return problem.readable(top / bottom)
    below = product_tree(problem, natural(problem, bottom, variables))
    if is_negative(below):
        top, below = -top, negate(below)
    return Quotient(problem.readable(top), below)


def _shared_number(problem: Problem, value: Scalar, variables: tuple[str, ...]) -> Scalar:
    """The number in front of a denominator, which the numerator takes over."""
    front = natural(problem, value, variables).constant
    return front / primitive(front)
