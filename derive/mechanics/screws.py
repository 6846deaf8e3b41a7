"""Joints as screws: their axes while all joints stand at zero (Lynch and Park, sections 3.3 and 4.1).

A screw axis has the unit direction w, a point q and a pitch h (m/rad). Its twist is S = (v, w) with
v = q x w + h w, and S = (w, 0) of a slide along w; linear part first, as in a Jacobian.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal
from derive.algebra.scalar import Scalar
from derive.expression import ZERO, Expr, Matrix, Symbol
from derive.mechanics.chain import Chain, chain, tool_pose
from derive.mechanics.coupling import Coupling
from derive.mechanics.dh import screw
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Axis
from derive.mechanics.poses import composed, skew, unit_vector
from derive.mechanics.robot import JointType, Link, Robot, ScrewRow

Read = Callable[[Scalar], Expr]
UNITS: tuple[tuple[tuple[int, int, int], Axis], ...] = (((1, 0, 0), "x"), ((0, 1, 0), "y"), ((0, 0, 1), "z"))


@dataclass(frozen=True, slots=True)
class Screw:
    """The screw of row i: w and q (3 by 1), h, S (6 by 1), and e^{[S] q} (4 by 4). Without a pitch h is 0,
    of a slide q is a point of the line it is drawn along."""

    i: int
    row: ScrewRow
    w: ScalarMatrix
    q: ScalarMatrix
    h: Scalar
    S: ScalarMatrix
    exponential: ScalarMatrix

    @property
    def bracket(self) -> ScalarMatrix:
        """[S] (4 by 4): its exponential is the motion."""
        v, w = self.S.block(slice(0, 3), slice(0, 1)), self.S.block(slice(3, 6), slice(0, 1))
        top = ScalarMatrix.beside([skew(w), v])
        return ScalarMatrix.stacked([top, ScalarMatrix.zeros(1, 4)])


def screws_of(robot: Robot) -> tuple[Screw, ...]:
    """One for each row of a robot of screws."""
    return tuple(
        _screw(i, link.row) for i, link in enumerate(robot.links, 1) if isinstance(link.row, ScrewRow)
    )


def _screw(i: int, row: ScrewRow) -> Screw:
    w = ScalarMatrix.column(unit_vector(row.axis))
    q = ScalarMatrix.column([normal(part) for part in row.through])
    h = normal(row.pitch)
    if row.slide:
        S = ScalarMatrix.stacked([w, ScalarMatrix.zeros(3, 1)])
    else:
        S = ScalarMatrix.stacked([q.cross(w) + w.scaled(h), w])
    return Screw(i, row, w, q, h, S, composed(screw(row)))


def screw_form(robot: Robot, read: Read) -> Robot:
    """The same arm by the screws of its joints: their axes and the end-effector's pose with every joint
    variable zero. `read` writes scalars as trees."""
    if robot.by_screws:
        return robot
    still: dict[Expr, Expr] = {Symbol(name): ZERO for name in robot.variables}
    found = chain(robot, still)
    links = tuple(
        _coupled_links(robot, found.coupling, still, read) if found.coupling else _links(robot, found, read)
    )
    return Robot(robot.name, robot.convention, links, home=ByMatrix(written(found.T_tool, read)))


def _links(robot: Robot, found: Chain, read: Read) -> Iterator[Link]:
    for i, joint in found.moving:
        slides = joint.type == "prismatic"
        row = _row(found.axis(i), found.point(i), Symbol(joint.variable), slides, read)
        yield Link(row, robot.links[i - 1].joint, joint.variable)


def _coupled_links(robot: Robot, coupling: Coupling, still: Names, read: Read) -> Iterator[Link]:
    """One for each motion of a row, by what it has moved since all joint variables were zero; the motion
    that has the star keeps its variable."""
    starred = set(robot.variables)
    for drive in coupling.drives:
        start = normal(drive.by, still)
        by = read(normal(drive.by) - start) if start else drive.by
        row = _row(drive.axis, drive.point, by, drive.slides, read)
        joint: JointType = "prismatic" if drive.slides else "revolute"
        own = robot.links[drive.i - 1] if 0 < drive.i <= len(robot.links) else None
        variable = own.variable if own and own.joint == joint and own.variable in starred else None
        starred.discard(variable or "")
        yield Link(row, joint, variable)


def _row(axis: ScalarMatrix, point: ScalarMatrix, by: Expr, slides: bool, read: Read) -> ScrewRow:
    x, y, z = (read(part) for part in point.entries)
    return ScrewRow(named_axis(axis, read), (x, y, z), by, slide=slides)


def named_axis(axis: ScalarMatrix, read: Read) -> Axis:
    """x, y or z where the direction is one of theirs, else its components."""
    for unit, letter in UNITS:
        if axis == ScalarMatrix.column(unit):
            return letter
    x, y, z = map(read, axis.entries)
    return x, y, z


def written(matrix: ScalarMatrix, read: Read) -> Matrix:
    """A matrix of scalars as a tree, each entry by `read`."""
    return Matrix(tuple(tuple(map(read, row)) for row in matrix.rows))


def home_of(robot: Robot) -> ScalarMatrix:
    """M (4 by 4): the end-effector while all joints of a robot of screws are at zero."""
    return tool_pose(robot)
