"""Three ways to the singular configurations: the determinant, its split at a wrist, or the minors."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.solving.factors import Factored
from derive.derivation import Phrase, Step
from derive.errors import NotDerivable
from derive.expression import Product, Symbol
from derive.kinds.robot._determinants import determinant, natural, product_tree
from derive.kinds.robot._singular.geometry import Seeing
from derive.kinds.robot._singular.minors import (
    Part,
    Way,
    closed,
    minors_of,
    oblong,
    refuse_dependent,
    square,
)
from derive.kinds.robot._singular.sets import Block
from derive.kinds.robot._velocity.task import Task
from derive.kinds.work import Work
from derive.mechanics.jacobian import jacobian
from derive.mechanics.poses import position_part, rotation_part
from derive.mechanics.seen import seen_shortest
from derive.mechanics.strata import of_determinant, searching
from derive.mechanics.wrist import Wrist

SIX = 6


def by_determinant(task: Task) -> Way:
    """det J of a square Jacobian, in the axes of a middle frame where it has six rows."""
    variables = task.found.variables
    frame = _middle(task) if len(task.rows) == SIX else 0
    J = _seen_from(task, frame) if frame else task.J
    block = Block(f"J^{frame}" if frame else "J", J, variables, task.rows, frame, _seeing(task))
    search = searching(task.found, task.problem.readable)
    return square(_resting_on(task, frame), block, "frame" if frame else "rows", search, _moved(task))


def by_wrist(task: Task, wrist: Wrist) -> Way:
    """det J = det J_11 det J_22 at the center of the wrist."""
    problem, found = task.problem, task.found
    arm = Seeing(problem, found, wrist.center, wrist.arm_rows)
    hand = Seeing(problem, found, wrist.center, wrist.hand_rows)
    blocks = (
        Block("J_11", wrist.J_11, found.variables[:3], task.rows[:3], wrist.arm, arm),
        Block("J_22", wrist.J_22, found.variables[3:], task.rows[3:], wrist.hand, hand),
    )
    center = (Symbol(f"o_{wrist.frame}"), problem.readable_matrix(wrist.center))
    work = _resting_on(task, wrist.frame).step(Step("center", center, "center"))
    parts, dets = [], []
    search = searching(found, problem.readable)
    for block in blocks:
        det = natural(problem, block.J.det(), block.variables)
        dets.append(det)
        refuse_dependent(block, bool(det.constant))
        name = Symbol(block.name)
        work = work.step(
            Step(block.name, (name, problem.readable_matrix(block.J)), "block"),
            closed(problem, f"det_{block.name}", (determinant(name), product_tree(problem, det))),
        )
        parts.append(Part(block, of_determinant(det, search)))
    whole = Factored(dets[0].constant * dets[1].constant, (*dets[0].factors, *dets[1].factors))
    tree = product_tree(problem, whole)
    split = Product(tuple(determinant(Symbol(block.name)) for block in blocks))
    work = work.step(Step("det", (determinant(Symbol("J")), split, problem.final(tree)), "in-numbers"))
    (six,) = minors_of(seen_from_middle(task), found.variables)
    work = work.law("blocks", six.value == whole.value)
    return Way("wrist", Phrase("center-of-the-wrist"), work, tree, tuple(parts), not search.open)


def by_minors(task: Task) -> Way:
    """All minors of full size, in the axes of the frame where they are shortest."""
    frame, rows, J = seen_shortest(task.found, task.whole, task.rows)
    name = f"J^{frame}" if frame else "J"
    block = Block(name, J, task.found.variables, rows, frame, _seeing(task))
    search = searching(task.found, task.problem.readable)
    return oblong(_resting_on(task, frame), block, "frame" if frame else "rows", search, _moved(task))


def _resting_on(task: Task, frame: int) -> Work:
    """The poses where the velocities are seen from a frame, else the Jacobian that was asked for."""
    return Work(task.problem, uses=(task.problem.ask("forward-kinematics"),) if frame else task.base)


def _seeing(task: Task) -> Seeing:
    rows = tuple(i for i, _ in task.found.moving if i <= task.point.last)
    return Seeing(task.problem, task.found, task.point.position, rows)


def _moved(task: Task) -> Phrase:
    return Phrase("the-point" if task.point.carried else "end-effector")


def _middle(task: Task) -> int:
    """The frame of the joint in the middle: seen from there a Jacobian is shortest."""
    moving = [i for i, _ in task.found.moving]
    return moving[(len(moving) - 1) // 2]


def seen_from_middle(task: Task) -> ScalarMatrix:
    """The whole Jacobian where it is shortest: in the axes of the middle frame. No determinant of six rows
    and no minor of that size changes."""
    return _seen_from(task, _middle(task))


def _seen_from(task: Task, frame: int) -> ScalarMatrix:
    """The whole Jacobian of the origin of the last frame, in the axes of a frame."""
    found = task.found
    tool_moves = found.coupling is not None and found.coupling.rows[-1] > len(found.T_local)
    if tool_moves or task.point.drift is not None:
        raise NotDerivable(
            "six rows are worked at the origin of the last row, and here the point moves against it; "
            "ask for three of them, as rows: [vx, vy, vz]",
            "rows",
        )
    R_T = rotation_part(found.T[frame]).T
    J = jacobian(found, position_part(found.T[-1]), len(found.T_local))
    return ScalarMatrix.stacked([R_T @ J.block(rows, slice(None)) for rows in (slice(0, 3), slice(3, 6))])
