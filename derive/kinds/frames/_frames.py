"""What the kinds of frames share: names, and the local poses as steps."""

from __future__ import annotations

from derive.derivation import Record, Step
from derive.expression import (
    Expr,
    Indexed,
    Matrix,
    Number,
    Product,
    Symbol,
    add,
    column,
    factors_of,
    multiply,
)
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.elementary import factor_name, homogeneous
from derive.mechanics.frame_tree import local
from derive.mechanics.frames import ByMatrix, Frame, Frames, Observed
from derive.mechanics.motion import Motion, Move
from derive.mechanics.poses import pose


def pose_name(number: int, reference: int) -> Symbol:
    """T_2^0."""
    return Symbol(f"T_{number}^{reference}")


def rotation_name(number: int, reference: int) -> Symbol:
    """R_2^0."""
    return Symbol(f"R_{number}^{reference}")


def origin_name(number: int, reference: int) -> Symbol:
    """o_2^0."""
    return Symbol(f"o_{number}^{reference}")


def is_given(frame: Frame) -> bool:
    """Whether its transform stands in the problem already, so that there is nothing to find."""
    return isinstance(frame.source, ByMatrix)


class Axes(Record):
    """What is read off a figure for one frame."""

    origin: Symbol
    axes: tuple[tuple[Expr, Expr], ...]  # each by those of the parent


SORTS = ("observed-origin", "observed", "motion", "given")


def local_steps(frame: Frame, problem: Problem) -> tuple[Step, ...]:
    """How the pose of a frame in its parent is found."""
    name = pose_name(frame.number, frame.parent)
    source = frame.source
    if isinstance(source, Observed):
        origin = origin_name(frame.number, frame.parent)
        facts = Axes(origin=origin, axes=observed_axes(source, frame.number, frame.parent))
        return (
            Step(origin.name, (origin, column(source.origin)), "observed-origin"),
            Step(name.name, (name, local_matrix(frame, problem)), "observed", facts),
        )
    if isinstance(source, Motion):
        factors = tuple(factor(move) for move in source.moves)
        product = Product(factors) if len(factors) > 1 else factors[0]
        return (Step(name.name, (name, product, local_matrix(frame, problem)), "motion"),)
    return (Step(name.name, (name, local_matrix(frame, problem)), "given"),)


def with_local(work: Work, frames: Frames) -> Work:
    """A board with these steps of all frames, sort by sort, and with what their names stand for."""
    for frame in frames.frames:
        work = work.knowing(local_definitions(frame, work.problem))
    steps = [step for frame in frames.frames for step in local_steps(frame, work.problem)]
    return work.showing(*sorted(steps, key=lambda step: SORTS.index(step.rule)))


def local_matrix(frame: Frame, problem: Problem) -> Matrix:
    """T (4 by 4) of a frame in its parent, as its author wrote it where it was written out."""
    source = frame.source
    if isinstance(source, Observed):
        return homogeneous(Matrix((source.x, source.y, source.z)).T, source.origin)
    if isinstance(source, ByMatrix):
        return source.matrix if source.matrix.shape == (4, 4) else homogeneous(source.matrix)
    return problem.readable_matrix(local(frame))


def local_definitions(frame: Frame, problem: Problem) -> dict[Expr, Expr]:
    """What the names in those steps stand for."""
    found: dict[Expr, Expr] = {pose_name(frame.number, frame.parent): local_matrix(frame, problem)}
    if isinstance(frame.source, Observed):
        found[origin_name(frame.number, frame.parent)] = column(frame.source.origin)
    if isinstance(frame.source, Motion):
        for move in frame.source.moves:
            found[factor(move)] = problem.readable_matrix(pose(move))
    return found


def observed_axes(source: Observed, number: int, parent: int) -> tuple[tuple[Expr, Expr], ...]:
    """x_1 = -x_0, ...: each axis of the frame by those of its parent, as chains for the words."""
    return tuple(
        (Symbol(f"{letter}_{number}"), combination(axis, parent))
        for letter, axis in zip("xyz", (source.x, source.y, source.z), strict=True)
    )


def combination(axis: tuple[Expr, ...], parent: int) -> Expr:
    """A sum of multiples of the parent's axes."""
    axes = [Symbol(f"{letter}_{parent}") for letter in "xyz"]
    return add(*(multiply(*factors_of(part), unit) for part, unit in zip(axis, axes, strict=True)))


def read_axes(T: Matrix, number: int, reference: int) -> tuple[tuple[Expr, Expr], ...]:
    """The columns of a pose as statements about the axes, where they are plain numbers; else nothing."""
    columns = [tuple(T.rows[i][j] for i in range(3)) for j in range(3)]
    if not all(_plain(entry) for each in columns for entry in each):
        return ()
    return tuple(
        (Symbol(f"{letter}_{number}"), combination(each, reference))
        for letter, each in zip("xyz", columns, strict=True)
    )


def factor(move: Move) -> Indexed:
    """Rot_{z, phi} or Trans_{x, a}, as a move of a frame is called."""
    axis = Symbol(move.axis) if isinstance(move.axis, str) else column(move.axis)
    return factor_name(move, axis, ("Rot", "Trans"))


def _plain(entry: Expr) -> bool:
    return isinstance(entry, Number)
