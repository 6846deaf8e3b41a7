"""How the columns of a Jacobian are written: z x (o - o_i) over z, or z over 0."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from derive.algebra.matrix import ScalarMatrix
from derive.derivation import PageFacts, Phrase, Step
from derive.expression import ZERO, Expr, Matrix, Product, Symbol, add, cross
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import axis_names, pose_name
from derive.kinds.robot._couplings import drive_names, gamma_of, phi_of
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.jacobian import MovingPoint, motions_jacobian
from derive.names import pose_entries

MOST_BLOCKS = 3  # columns; more would not stand side by side
Block = tuple[Expr, Expr]  # the linear and the angular part of a column


class Facts(PageFacts):
    """What the words need to know of a Jacobian, geometric or analytic."""

    analytic: bool = False
    angles: tuple[Symbol, ...] = ()  # of the analytic one
    own: tuple[tuple[Expr, Expr], ...] = ()  # the angles that are joint variables
    det: Expr | None = None  # that of their rates
    restated: bool = False
    point: Phrase | None = None  # where it is no origin that is known
    sorts: Phrase | None = None  # of joints, and how they move it
    helical: Phrase | None = None
    still: Phrase | None = None  # joints after the point


def blocks(
    problem: Problem,
    found: Chain,
    point: Symbol | None = None,
    last: int | None = None,
    nothing: Expr = ZERO,
) -> tuple[Block, ...]:
    """The columns in the names of their vectors, of coupled joints those of the motions of the rows: for a
    point that moves with frame `last`, or for that point of the last body which just passes the origin.
    `nothing` is what three zeros are called."""

    def block(i: int, axis: Symbol, o: Symbol | None, along: tuple[Expr, ...]) -> Block:
        if last is not None and i > last:
            return nothing, nothing
        if o is None:
            return axis, nothing
        return add(cross(axis, point - o) if point else cross(o, axis), *along), axis

    return tuple(block(*each) for each in _axes(problem, found))


def _axes(problem: Problem, found: Chain) -> Iterator[tuple[int, Symbol, Symbol | None, tuple[Expr, ...]]]:
    """(row, axis, a point on it unless it is slid along, how a helical joint advances) of each motion."""
    if found.coupling:
        for drive in found.coupling.drives:
            axis, o = drive_names(found, problem.subject, drive)
            yield drive.i, axis, None if drive.slides else o, ()
        return
    for i, joint in found.moving:
        z, o = axis_names(found, problem.subject, i)
        along = (problem.readable(joint.pitch) * z,) if joint.pitch else ()
        yield i, z, None if joint.type == "prismatic" else o, along


def jacobian_steps(
    problem: Problem, found: Chain, point: MovingPoint, name: Symbol, at: Symbol
) -> tuple[Step, ...]:
    """The lines of `jacobian_lines` alone."""
    return jacobian_lines(Work(problem), found, point, name, at).steps


def jacobian_lines(
    work: Work, found: Chain, point: MovingPoint, name: Symbol, at: Symbol, rule: str = ""
) -> Work:
    """The Jacobian `name` (6 by n) of a point, which is called `at`, from its columns; of coupled joints by
    the chain rule, J = J_phi Gamma. How a point moves in its own frame is added at the end."""
    J, coupling, problem = point.jacobian(found), found.coupling, work.problem
    if point.drift is not None:
        rigid = Symbol(f"{name.name}_r")
        work = jacobian_lines(work, found, replace(point, drift=None), rigid, at, "rigid-jacobian")
        own = ScalarMatrix.stacked([point.drift, ScalarMatrix.zeros(*point.drift.shape)])
        return work.line(name, rigid + problem.readable_matrix(own), value=J, rule="jacobian")
    columns = blocks(problem, found, at, point.last)
    J_phi = motions_jacobian(coupling, point.position, point.last) if coupling else J
    if J_phi == J:  # no coupling before this point
        return _by_columns(work, J, name, columns, rule)
    motions = Symbol(f"{name.name}_{phi_of(problem).name}")
    work = _by_columns(work, J_phi, motions, columns, "motions-jacobian")
    return work.line(name, motions * gamma_of(problem), value=J, rule=rule or "jacobian")


def _by_columns(work: Work, J: ScalarMatrix, name: Symbol, columns: tuple[Block, ...], rule: str) -> Work:
    """J as a block matrix and written out; column by column where it is too wide for that. Where nothing
    turns there are no blocks to tell, but the columns themselves."""
    if all(angular == ZERO for _, angular in columns):
        return work.line(name, value=J, rule=rule or "jacobian-columns")
    still = [column == (ZERO, ZERO) for column in columns]
    if still.count(False) <= MOST_BLOCKS:
        block = Matrix(tuple(zip(*columns, strict=True)))
        return work.line(name, block, value=J, rule=rule or "jacobian-columns")
    written = work.problem.readable_matrix(J)
    names = tuple(ZERO if none else Symbol(f"{name.name}_{k}") for k, none in enumerate(still, 1))
    for k, (linear, angular) in enumerate(columns):
        if not still[k]:
            column = Matrix(((linear,), (angular,)))
            work = work.line(names[k], column, value=J.columns(k), rule="jacobian-column")
    return work.line(name, Matrix((names,)), value=written, rule=rule or "jacobian", spare=(written,))


def pose_lines(work: Work, found: Chain, last: int) -> Work:
    """T_2^0, T_3^0, ... on the way to frame `last`; T_1^0 is a local pose, and that of the end-effector
    belongs to the forward kinematics."""
    robot = work.problem.subject
    rows = len(found.T_local) + bool(robot.tool and not robot.by_screws)
    for i in range(2, min(last + 1, rows)):
        written = work.problem.readable_matrix(found.T[i])
        product = pose_name(i - 1) * pose_name(i, i - 1)
        work = work.line(pose_name(i), product, value=written, rule="compose", spare=(written,))
    return work


def product_lines(work: Work, name: Symbol, factors: tuple[Expr, ...], T: ScalarMatrix) -> Work:
    """A pose T (4 by 4) as the product of these factors; no line for a single one."""
    if len(factors) > 1:
        entries = pose_entries(work.problem.taken, _pose_known(work.problem))
        work = work.line(name, Product(factors), value=T, rule="compose", entries=entries)
        rows = work.matrix(name).rows
        return work.knowing({symbol: rows[i][j] for (i, j), symbol in entries.items()})
    return work.knowing({name: work.problem.readable_matrix(T)})


def _pose_known(problem: Problem) -> bool:
    """Whether a question gives the pose or the orientation of the end-effector by its elements."""
    return any(getattr(options, "given", None) in ("pose", "orientation") for _, options in problem.questions)
