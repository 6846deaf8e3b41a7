"""How the columns of a Jacobian are written: z x (o - o_i) over z, or z over 0."""

from __future__ import annotations

from dataclasses import replace

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.readable.form import readable
from derive.derivation import Step
from derive.expression import ZERO, Expr, Matrix, Product, Sum, Symbol, add, cross, subtract
from derive.kinds.naming import fits
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import TOOL, axis_names, end_frame, pose_name
from derive.kinds.robot._couplings import drive_blocks, gamma_of, phi_of
from derive.mechanics.chain import Chain
from derive.mechanics.jacobian import MovingPoint, motions_jacobian
from derive.mechanics.robot import Robot

MOST_BLOCKS = 3  # columns; more would not stand side by side


def column_blocks(found: Chain, robot: Robot, i: int, point: Symbol, last: int) -> tuple[Expr, Expr]:
    """The linear and the angular part of a column, in the names of its vectors."""
    if i > last:
        return ZERO, ZERO
    z, o = axis_names(found, robot, i)
    joint = found.joint(i)
    if joint.type == "prismatic":
        return z, ZERO
    turned = cross(z, subtract(point, o))
    return (add(turned, Product((readable(joint.pitch), z))) if joint.pitch else turned), z


def jacobian_steps(
    problem: Problem, found: Chain, point: MovingPoint, name: Symbol, at: Symbol
) -> tuple[Step, ...]:
    """The Jacobian `name` of a point, which is called `at`, from its columns; how a point moves in its own
    frame is added at the end."""
    if point.drift is None:
        return _rigid_steps(problem, found, point, name, at)
    own = ScalarMatrix.stacked([point.drift, ScalarMatrix.zeros(*point.drift.shape)])
    rigid = Symbol(f"{name.name}_r")
    steps = _rigid_steps(problem, found, replace(point, drift=None), rigid, at)
    total = Sum((rigid, problem.readable_matrix(own)))
    whole = Step(name.name, (name, total, problem.readable_matrix(point.jacobian(found))), "jacobian")
    return (*steps[:-1], replace(steps[-1], rule="rigid-jacobian"), whole)


def _rigid_steps(
    problem: Problem, found: Chain, point: MovingPoint, name: Symbol, at: Symbol
) -> tuple[Step, ...]:
    """Of a point that is fixed in its frame; of coupled joints by the chain rule, J = J_phi Gamma."""
    robot, coupling, J = problem.subject, found.coupling, point.jacobian(found)
    if coupling is None:
        return _column_steps(
            problem, J, name, [column_blocks(found, robot, i, at, point.last) for i, _ in found.moving]
        )
    motions = Symbol(f"{name.name}_{phi_of(problem).name}")
    blocks = [drive_blocks(found, robot, drive, at, point.last) for drive in coupling.drives]
    value = motions_jacobian(coupling, point.position, point.last)
    if value == J:  # no coupling before this point
        return _column_steps(problem, J, name, blocks)
    steps = _column_steps(problem, value, motions, blocks)
    chain = (name, Product((motions, gamma_of(problem))), problem.readable_matrix(J))
    return (*steps[:-1], replace(steps[-1], rule="motions-jacobian"), Step(name.name, chain, "jacobian"))


def _column_steps(
    problem: Problem, J: ScalarMatrix, name: Symbol, blocks: list[tuple[Expr, Expr]]
) -> tuple[Step, ...]:
    """J as a block matrix and written out; column by column where it is too wide for that. Where nothing
    turns there are no blocks to tell, but the columns themselves."""
    written = problem.readable_matrix(J)
    if all(angular == ZERO for _, angular in blocks):
        return (Step(name.name, (name, written), "jacobian-columns"),)
    if len(blocks) <= MOST_BLOCKS:
        block = Matrix(tuple(zip(*blocks, strict=True)))
        return (Step(name.name, (name, block, written), "jacobian-columns"),)
    return _by_columns(written, blocks, name)


def _by_columns(written: Matrix, blocks: list[tuple[Expr, Expr]], name: Symbol) -> tuple[Step, ...]:
    columns = []
    for k, (linear, angular) in enumerate(blocks, 1):
        column_name = Symbol(f"{name.name}_{k}")
        entries = Matrix(tuple((row[k - 1],) for row in written.rows))
        block = Matrix(((linear,), (angular,)))
        chain = (column_name, block, entries) if linear != ZERO else (column_name, entries)
        columns.append(Step(column_name.name, chain, "jacobian-column"))
    side_by_side = Matrix((tuple(Symbol(step.name) for step in columns),))
    chain = (name, side_by_side, written) if fits(written) else (name, side_by_side)
    whole = Step(name.name, chain, "jacobian")
    return (*columns, whole)


def pose_steps(problem: Problem, found: Chain, last: int) -> tuple[Step, ...]:
    """T_2^0, T_3^0, ... on the way to frame `last`, those that fit on a line.

    T_1^0 is a local pose, and that of the end-effector belongs to the forward kinematics.
    """
    steps = []
    rows = len(found.T_local) + (end_frame(problem.subject) == TOOL)
    for i in range(2, min(last + 1, rows)):
        written = problem.readable_matrix(found.T[i])
        if fits(written):
            product = Product((pose_name(i - 1), pose_name(i, i - 1)))
            steps.append(Step(f"T_{i}^0", (pose_name(i), product, written), "compose"))
    return tuple(steps)
