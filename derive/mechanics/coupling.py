"""Coupled joints: joint variables that move more than a row of their own.

In a parallelogram row 3 turns by q3 - q2, on a screw spindle a row turns by q1 and slides by p q1. The
motions phi of such an arm (what its rows turn and slide by, one after the other) are functions of the
joint variables q. Their rates are Gamma qdot with Gamma = dphi/dq, and by the chain rule the Jacobian of
the variables is that of the motions times Gamma.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from derive.algebra.angles import Form
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal
from derive.algebra.trigonometry import linear_form
from derive.errors import NotDerivable
from derive.expression import Expr, free_symbols
from derive.mechanics.dh import moves
from derive.mechanics.motion import Move
from derive.mechanics.poses import pose, position_part, rotation_part, unit_vector
from derive.mechanics.robot import Robot


@dataclass(frozen=True, slots=True)
class Drive:
    """Move `k` (from 0) of row `i`, by `by`: about `axis` through `point`, or along it where it `slides`
    (3 by 1 each, base frame). The moves of the base are those of row 0, those of the tool of row n + 1."""

    i: int
    k: int
    slides: bool
    axis: ScalarMatrix
    point: ScalarMatrix
    by: Expr


@dataclass(frozen=True, slots=True)
class Coupling:
    """The moves that joint variables drive, from base to tip; Gamma (m by n), their partial derivatives by
    the variables; and the angles that turn, alone and added up over parallel axes."""

    drives: tuple[Drive, ...]
    gamma: ScalarMatrix
    angles: tuple[Form, ...]

    @property
    def rows(self) -> tuple[int, ...]:
        """The rows that move, one for each motion."""
        return tuple(drive.i for drive in self.drives)

    @property
    def winds(self) -> bool:
        """Whether a row turns by several variables, or a variable turns several rows."""
        pairs = zip(self.drives, self.gamma.rows, strict=True)
        turning = [tuple(map(bool, row)) for drive, row in pairs if not drive.slides]
        return any(sum(line) > 1 for line in (*turning, *zip(*turning, strict=True)))

    @property
    def free(self) -> bool:
        """Whether each row moves as it likes, in one way: Gamma is constant and has an inverse."""
        square = self.gamma.shape[0] == self.gamma.shape[1]
        once = len(set(self.rows)) == len(self.rows)
        linear = all(entry.constant is not None for entry in self.gamma.entries)
        return square and once and linear and bool(self.gamma.det())


def tangled(coupling: Coupling, variables: tuple[str, ...]) -> str | None:
    """A joint variable that turns one row and slides another, so that a whole turn of it is no return, or
    turns one by other than a number of times itself; None where there is none."""
    for j, name in enumerate(variables):
        rates = zip(coupling.drives, coupling.gamma.columns(j).entries, strict=True)
        if len({drive.slides for drive, rate in rates if rate}) > 1:
            return name
    return out_of_proportion(coupling, variables)


def out_of_proportion(coupling: Coupling, variables: tuple[str, ...]) -> str | None:
    """A joint variable that turns a row by other than a number of times itself; None where there is none."""
    for j, name in enumerate(variables):
        rates = zip(coupling.drives, coupling.gamma.columns(j).entries, strict=True)
        if any(rate and not drive.slides and rate.constant is None for drive, rate in rates):
            return name
    return None


def stages(robot: Robot) -> Iterator[tuple[int, tuple[Move, ...]]]:
    """(row, its moves), the base as row 0 and the tool as the row after the last."""
    yield 0, robot.base
    yield from ((i, moves(link, robot)) for i, link in enumerate(robot.links, 1))
    yield len(robot.links) + 1, robot.tool


def driven(move: Move, robot: Robot) -> bool:
    """Whether a joint variable stands in it."""
    return not free_symbols(move.by).isdisjoint(robot.variables)


def coupling(
    robot: Robot, T: tuple[ScalarMatrix, ...], end: ScalarMatrix, names: Names | None = None
) -> Coupling | None:
    """The coupling of an arm whose frames stand at T (4 by 4 each, from frame 0) and whose tool starts at
    `end`; None where every variable moves its own row alone."""
    if not robot.coupled:
        return None
    starts = (ScalarMatrix.identity(4), *T[:-1], end)
    found = tuple(
        drive
        for start, (i, made) in zip(starts, stages(robot), strict=True)
        for drive in _of_row(robot, start, i, made, names)
    )
    rates = [[normal(drive.by).diff(name) for name in robot.variables] for drive in found]
    return Coupling(found, ScalarMatrix.of(rates), angle_sums(robot, names))


def _of_row(
    robot: Robot, start: ScalarMatrix, i: int, made: tuple[Move, ...], names: Names | None
) -> Iterator[Drive]:
    reached = start
    for k, move in enumerate(made):
        if driven(move, robot):
            axis = rotation_part(reached) @ ScalarMatrix.column(unit_vector(move.axis, names))
            yield Drive(i, k, move.kind == "translate", axis, position_part(reached), move.by)
        reached = reached @ pose(move, names)


def angle_sums(robot: Robot, names: Names | None = None) -> tuple[Form, ...]:
    """The angle of each driven turn, added to those before it where the axes are parallel: the absolute
    angles of a parallelogram arm. Angles that are no linear forms of the joint variables start anew."""
    forms: list[Form] = []
    total, axis = Form.of({}), None
    carried = ScalarMatrix.identity(3)  # the fixed rotation since the last driven turn
    for move in (move for _, made in stages(robot) for move in made if move.kind == "rotate"):
        if not driven(move, robot):
            carried = carried @ rotation_part(pose(move, names))
            continue
        own = ScalarMatrix.column(unit_vector(move.axis, names))
        here = carried @ own
        sign = 0 if axis is None else 1 if axis == here else -1 if axis == -here else 0
        angle = _form(move.by, robot)
        total = angle + total.scaled(sign)
        forms += [total, angle]
        axis, carried = own, ScalarMatrix.identity(3)
    return tuple(form for form in forms if form.parts)


def _form(by: Expr, robot: Robot) -> Form:
    """Its part in the joint variables, nothing where that is not linear."""
    try:
        form = linear_form(normal(by))
    except NotDerivable:
        return Form.of({})
    moving = {atom: n for atom, n in form.parts if not set(robot.variables).isdisjoint(atom.split("*"))}
    return Form.of(moving) if set(moving) <= set(robot.variables) else Form.of({})
