"""Joint rates of an arm with a wrist: first those of the arm from the velocity of the wrist's center, then
those of the wrist from what is left of the angular velocity."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point
from derive.errors import NotDerivable
from derive.expression import ZERO, Call, Expr, Matrix, Symbol, column, cross, symbols, transpose
from derive.expression import replace as replaced
from derive.kinds.robot._determinants import as_product, determinant
from derive.kinds.robot._velocity.solving import quotient
from derive.kinds.robot._velocity.task import Task
from derive.kinds.work import Work
from derive.mechanics.jacobian import halves, jacobian
from derive.mechanics.poses import rotation_part
from derive.mechanics.task import ROWS
from derive.mechanics.wrist import Wrist

V, OMEGA, CENTER, U, N, J_21 = symbols("v omega v_c u n J_21")


@dataclass(frozen=True, slots=True)
class Split:
    """The board with the lines to qdot (6 by 1), and that written out; the frames of the arm and the hand,
    whether the center lies apart from the end-effector, and where the rates fail."""

    work: Work
    qdot: Matrix
    frames: tuple[int, int]
    offset: bool
    zero: tuple[tuple[Expr, Expr], ...]


def by_wrist(task: Task, wrist: Wrist) -> Split:
    """J_11^-1 and J_22^-1 in place of J^-1 (Spong et al., section 4.9.1).

    Raises NotDerivable where one of the two is singular in every configuration.
    """
    problem, rates = task.problem, task.rates
    work = Work(problem, uses=(problem.ask("forward-kinematics"),))
    work = work.knowing({V: column(map(Symbol, ROWS[:3])), OMEGA: column(map(Symbol, ROWS[3:]))})
    work, arm = _half(_at_center(work, task, wrist), "J_11", wrist.J_11, rates[:3], U)
    work, hand = _half(_left_over(work, task, wrist), "J_22", wrist.J_22, rates[3:], N)
    return Split(
        work,
        column(_written_out(work, rates, arm, hand)),
        (wrist.arm, wrist.hand),
        bool(task.point.position - wrist.center),
        tuple((determinant(Symbol(name)), ZERO) for name in ("J_11", "J_22")),
    )


def _components(name: Symbol) -> tuple[Symbol, ...]:
    return symbols(f"{name.name}_1 {name.name}_2 {name.name}_3")


def _by_component(work: Work, name: Symbol, value: Matrix) -> Work:
    """The components of a vector by their names."""
    return work.knowing({each: entry for each, (entry,) in zip(_components(name), value.rows, strict=True)})


def _at_center(work: Work, task: Task, wrist: Wrist) -> Work:
    """v_c = v - omega x (o_e - o_c), and u, the same in the axes of the arm's frame."""
    problem, o_e, o_c, R = task.problem, task.point.name, Symbol(f"o_{wrist.frame}"), _rotation(wrist.arm)
    known = {o_e: task.point.position, o_c: wrist.center, R: rotation_part(task.found.T[wrist.arm])}
    work = work.knowing({name: problem.readable_matrix(value) for name, value in known.items()})
    offset = bool(task.point.position - wrist.center)
    route = V - cross(OMEGA, o_e - o_c) if offset else V
    work = work.line(CENTER, route, rule="center")
    velocity = work.matrix(CENTER)
    work = work.knowing({CENTER: column(_components(CENTER))})
    work = work.line(U, transpose(R) * CENTER, rule="frame")
    return _by_component(_by_component(work, CENTER, velocity), U, work.matrix(U))


def _left_over(work: Work, task: Task, wrist: Wrist) -> Work:
    """n = R^T omega - J_21 q_a, in the axes of the hand's frame: what the wrist has to add."""
    R, R_h = _rotation(wrist.hand), rotation_part(task.found.T[wrist.hand])
    _, J_w = halves(jacobian(task.found, wrist.center, len(task.found.T_local)))
    work = work.knowing({R: task.problem.readable_matrix(R_h)})
    work = work.line(J_21, value=R_h.T @ J_w.columns(0, 1, 2), rule="block")
    by_arm = J_21 * column(task.rates[:3])
    work = work.line(N, transpose(R) * OMEGA - by_arm, rule="rest")
    return _by_component(work, N, work.matrix(N))


def _rotation(frame: int) -> Symbol:
    return Symbol(f"R_{frame}^0")


def _half(
    work: Work, name: str, J: ScalarMatrix, rates: tuple[Symbol, ...], vector: Symbol
) -> tuple[Work, tuple[Expr, ...]]:
    """The rates of three joints, J^-1 times the components of the vector, by the adjugate."""
    problem, det = work.problem, J.det()
    if not det:
        raise NotDerivable("the Jacobian of the arm is singular in every configuration")
    variables = tuple(rate.name.removesuffix("_dot") for rate in rates)
    known = normal_matrix(column(_components(vector)))
    exact = J.adjugate() @ known
    found = tuple(quotient(problem, entry, det, variables, _components(vector)) for entry in exact.entries)
    block = Symbol(name)
    work = work.line(block, value=J, rule="block")
    tree = as_product(problem, det, variables)
    work = work.line(determinant(block), value=tree, rule="determinant", label=f"det_{name}")
    formula = Call("inverse", (block,)) * vector
    work = work.line(column(rates), formula, value=column(found), rule="in-numbers", label=f"rates_{name}")
    line, printed = work.steps[-1], work.matrix(block)
    names = work.problem.symbols | {each.name for each in _components(vector)}
    work = work.agrees(
        "lines",
        names,
        lambda at: arrays(line.chain[1], {**at, **_meaning(block, printed, vector, at)}),
        lambda at: arrays(line.result, at),
        block=name,
    )
    return work.law("split", J @ exact == known.scaled(det), block=name, vector=vector.name), found


def _meaning(block: Symbol, printed: Matrix, vector: Symbol, at: Point) -> dict[str, Any]:
    """A block and a vector by the names of its components, in numbers."""
    return {
        block.name: arrays(printed, at),
        vector.name: arrays(column(_components(vector)), at),
    }


def _written_out(
    work: Work, rates: tuple[Symbol, ...], arm: tuple[Expr, ...], hand: tuple[Expr, ...]
) -> tuple[Expr, ...]:
    """All six rates in the given velocities alone, nested as they were found."""
    known: dict[Expr, Expr] = {}

    def written(names: tuple[Symbol, ...], values: tuple[Expr, ...]) -> tuple[Expr, ...]:
        found = tuple(replaced(value, known) for value in values)
        known.update(zip(names, found, strict=True))
        return found

    for vector in (CENTER, U):
        written(_components(vector), tuple(work[name] for name in _components(vector)))
    first = written(rates[:3], arm)
    written(_components(N), tuple(work[name] for name in _components(N)))
    return tuple(replaced(rate, work.problem.names) for rate in (*first, *written(rates[3:], hand)))
