"""Joint rates of an arm with a wrist: first those of the arm from the velocity of the wrist's center, then
those of the wrist from what is left of the angular velocity."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Call, Expr, Matrix, Product, Symbol, column, cross, subtract, transpose
from derive.expression import replace as replaced
from derive.kinds.checks import law, links
from derive.kinds.problem import Problem
from derive.kinds.robot._singular.determinants import determinant, natural, product_tree
from derive.kinds.robot._velocity.solving import quotient
from derive.kinds.robot._velocity.task import Task
from derive.mechanics.jacobian import jacobian
from derive.mechanics.poses import rotation_part
from derive.mechanics.wrist import Wrist

V, OMEGA = Symbol("v"), Symbol("omega")
U, N = Symbol("u"), Symbol("n")
LINEAR, ANGULAR = ("vx", "vy", "vz"), ("wx", "wy", "wz")


@dataclass(frozen=True, slots=True)
class Half:
    """The rates of three joints from three components: their steps, their trees in the names of the
    components, and whether the block times them is what it should be."""

    steps: tuple[Step, ...]
    rates: tuple[Expr, ...]
    exact: Claim
    definitions: dict[Expr, Expr]


@dataclass(frozen=True, slots=True)
class Split:
    """The whole: steps, qdot written out, claims, what the names stand for, and what it rests on."""

    steps: tuple[Step, ...]
    qdot: Matrix
    claims: tuple[Claim, ...]
    definitions: dict[Expr, Expr]
    uses: tuple[Derivation, ...]
    frames: tuple[int, int]
    offset: bool
    zero: tuple[tuple[Expr, Expr], ...]


def by_wrist(task: Task, wrist: Wrist) -> Split:
    """J_11^-1 and J_22^-1 in place of J^-1 (Spong et al., section 4.9.1)."""
    problem = task.problem
    known, center_names = _at_center(task, wrist)
    arm_in = _components(U)
    arm = _half(task, "J_11", wrist.J_11, task.found.variables[:3], arm_in, U)
    J = jacobian(task.found, wrist.center, len(task.found.T_local))
    R_h = rotation_part(task.found.T[wrist.hand])
    J_21 = R_h.T @ J.block(slice(3, 6), slice(0, 3))
    rest, left = _left_over(task, wrist, J_21)
    hand = _half(task, "J_22", wrist.J_22, task.found.variables[3:], _components(N), N)
    steps = (*known, *arm.steps, *rest, *hand.steps)
    names: dict[Expr, Expr] = {**center_names, **arm.definitions, **left, **hand.definitions}
    return Split(
        steps,
        column(_written_out(problem, arm, hand, names)),
        (*links(steps, {**problem.names, **names}), arm.exact, hand.exact),
        names,
        (problem.ask("forward-kinematics"),),
        (wrist.arm, wrist.hand),
        bool(task.point.position - wrist.center),
        tuple((determinant(Symbol(name)), ZERO) for name in ("J_11", "J_22")),
    )


def _components(name: Symbol) -> tuple[Symbol, ...]:
    return tuple(Symbol(f"{name.name}_{k}") for k in (1, 2, 3))


def _at_center(task: Task, wrist: Wrist) -> tuple[tuple[Step, ...], dict[Expr, Expr]]:
    """v_c = v - omega x (o_e - o_c), and u, the same in the axes of the arm's frame."""
    problem = task.problem
    v, omega = column(map(Symbol, LINEAR)), column(map(Symbol, ANGULAR))
    arm = task.point.position - wrist.center
    center, end = Symbol("v_c"), task.point.name
    o_c = Symbol(f"o_{wrist.frame}")
    velocity = normal_matrix(v) - normal_matrix(omega).cross(arm)
    offset = bool(arm)
    route = subtract(V, cross(OMEGA, subtract(end, o_c))) if offset else V
    written = problem.readable_matrix(velocity)
    R = Symbol(f"R_{wrist.arm}^0")
    R_value = rotation_part(task.found.T[wrist.arm])
    here = problem.readable_matrix(R_value.T @ normal_matrix(column(_components(center))))
    steps = (
        Step("v_c", (center, route, written), "center"),
        Step("u", (U, Product((transpose(R), center)), here), "frame"),
    )
    names: dict[Expr, Expr] = {
        V: v,
        OMEGA: omega,
        end: task.point.step.result,
        R: problem.readable_matrix(R_value),
    }
    names[o_c] = problem.readable_matrix(wrist.center)
    names[center] = column(_components(center))
    names[U] = here
    for name, (entry,) in zip(_components(center), written.rows, strict=True):
        names[name] = entry
    for name, (entry,) in zip(_components(U), here.rows, strict=True):
        names[name] = entry
    return steps, names


def _left_over(task: Task, wrist: Wrist, J_21: ScalarMatrix) -> tuple[tuple[Step, ...], dict[Expr, Expr]]:
    """n = R^T omega - J_21 q_a, in the axes of the hand's frame: what the wrist has to add."""
    problem = task.problem
    R = Symbol(f"R_{wrist.hand}^0")
    R_value = rotation_part(task.found.T[wrist.hand])
    omega = normal_matrix(column(map(Symbol, ANGULAR)))
    rates = column(task.rates[:3])
    value = R_value.T @ omega - J_21 @ normal_matrix(rates)
    written = problem.readable_matrix(value)
    shown = problem.readable_matrix(J_21)
    J = Symbol("J_21")
    steps = (
        Step("J_21", (J, shown), "block"),
        Step("n", (N, subtract(Product((transpose(R), OMEGA)), Product((J, rates))), written), "rest"),
    )
    names: dict[Expr, Expr] = {J: shown, R: problem.readable_matrix(R_value), N: written}
    for name, (entry,) in zip(_components(N), written.rows, strict=True):
        names[name] = entry
    return steps, names


def _half(
    task: Task,
    name: str,
    J: ScalarMatrix,
    variables: tuple[str, ...],
    given: tuple[Symbol, ...],
    vector: Symbol,
) -> Half:
    """J^-1 times the components, by the adjugate. Raises NotDerivable where it is singular everywhere."""
    problem = task.problem
    det = J.det()
    if not det:
        raise NotDerivable("the Jacobian of the arm is singular in every configuration")
    known = ScalarMatrix.column([Scalar.symbol(each.name) for each in given])
    exact = J.adjugate() @ known
    rates = tuple(quotient(problem, entry, det, variables) for entry in exact.entries)
    block = Symbol(name)
    unknown = column(Symbol(f"{each}_dot") for each in variables)
    shown = problem.readable_matrix(J)
    steps = (
        Step(name, (block, shown), "block"),
        Step(
            f"det_{name}",
            (determinant(block), product_tree(problem, natural(problem, det, variables))),
            "determinant",
        ),
        Step(f"rates_{name}", (unknown, Product((Call("inverse", (block,)), vector)), column(rates)), "law"),
    )
    holds = J @ exact == known.scaled(det)
    return Half(steps, rates, law("split", holds, block=name, vector=vector.name), {block: shown})


def _written_out(problem: Problem, arm: Half, hand: Half, names: dict[Expr, Expr]) -> tuple[Expr, ...]:
    """All six rates in the given velocities alone, nested as they were found."""
    known: dict[Expr, Expr] = {}
    for vector in (Symbol("v_c"), U):
        known |= {name: replaced(names[name], known) for name in _components(vector)}
    first = tuple(replaced(rate, known) for rate in arm.rates)
    known |= {Symbol(f"{n}_dot"): rate for n, rate in zip(problem.subject.variables, first, strict=False)}
    known |= {name: replaced(names[name], known) for name in _components(N)}
    second = tuple(replaced(rate, known) for rate in hand.rates)
    return tuple(replaced(rate, problem.names) for rate in (*first, *second))
