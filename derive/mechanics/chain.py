"""An open chain in normal form: its local poses, its joint axes, and the poses of its frames."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce

from derive.algebra.angles import Form
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal
from derive.algebra.ring import Ring, ring
from derive.algebra.scalar import Scalar
from derive.expression import Symbol, walk
from derive.mechanics.bodies import moments
from derive.mechanics.drives import reflected
from derive.mechanics.dh import moves
from derive.mechanics.motion import Move
from derive.mechanics.poses import composed, position_part, rotation_part, unit_vector
from derive.mechanics.frame_tree import pose_of
from derive.mechanics.robot import JointType, Link, Robot, ScrewRow, gravity_of


ZERO_PITCH = Scalar.of(0)


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint and where it acts: frame i-1, then `before` (4 by 4), then about or along `axis`
    (3 by 1, in the frame reached so far). `variable` is its name; `pitch` of a helical joint is in
    metres a radian."""

    variable: str
    type: JointType
    before: ScalarMatrix
    axis: ScalarMatrix
    pitch: Scalar = ZERO_PITCH


@dataclass(frozen=True, slots=True)
class Chain:
    """T_local[i] takes frame i+1 to frame i; T[i] frame i to the base, T[n] the last row's, the base
    motion included. T_tool is the pose of the end-effector. joints[i] belongs to row i+1."""

    T_local: tuple[ScalarMatrix, ...]
    T: tuple[ScalarMatrix, ...]
    T_tool: ScalarMatrix
    joints: tuple[Joint | None, ...]

    @property
    def variables(self) -> tuple[str, ...]:
        return tuple(joint.variable for joint in self.joints if joint)

    @property
    def moving(self) -> Iterator[tuple[int, Joint]]:
        """(row, joint) of the rows that move, rows from 1."""
        return ((i, joint) for i, joint in enumerate(self.joints, 1) if joint)

    def axis(self, i: int) -> ScalarMatrix:
        """The axis of the joint of row i in the base frame (3 by 1)."""
        joint = self.joint(i)
        return rotation_part(self.T[i - 1]) @ rotation_part(joint.before) @ joint.axis

    def point(self, i: int) -> ScalarMatrix:
        """A point on the axis of the joint of row i in the base frame (3 by 1)."""
        return position_part(self.T[i - 1] @ self.joint(i).before)

    def joint(self, i: int) -> Joint:
        joint = self.joints[i - 1]
        if joint is None:
            raise ValueError(f"row {i} has no joint")
        return joint


def chain(robot: Robot, names: Names | None = None) -> Chain:
    """The robot in one ring: its angles are the sums over parallel axes, its symbols all those of the
    robot, bodies and gravity included, so that nothing has to change rings later."""
    rows = [moves(link, robot) for link in robot.links]
    joints = tuple(_joint(row, link, names) for row, link in zip(rows, robot.links, strict=True))
    local = [composed(row, names) for row in rows]
    base, tool = composed(robot.base, names), tool_pose(robot, names)
    home = _home([base, *local, tool], _sums(rows, joints, names), parameters(robot))
    T_local = tuple(T.into(home) for T in local)
    T = _products(base.into(home), T_local)
    return Chain(T_local, T, T[-1] @ tool.into(home), joints)


def tool_pose(robot: Robot, names: Names | None = None) -> ScalarMatrix:
    """T (4 by 4) of the end-effector in the last row's frame: the home pose of a chain of screws, and the
    tool."""
    tool = composed(robot.tool, names)
    return tool if robot.home is None else pose_of(robot.home, names) @ tool


def _products(base: ScalarMatrix, local: Sequence[ScalarMatrix]) -> tuple[ScalarMatrix, ...]:
    poses = [base]
    for T in local:
        poses.append(poses[-1] @ T)
    return tuple(poses)


def _home(matrices: Sequence[ScalarMatrix], sums: tuple[Form, ...], names: Iterable[str]) -> Ring:
    home = reduce(Ring.union, (matrix.ring for matrix in matrices), ring(angles=sums))
    return home.with_symbols(names)


def parameters(robot: Robot) -> tuple[str, ...]:
    """Every symbol of the bodies and of gravity, in order of first use."""
    trees = list(gravity_of(robot))
    for link in robot.links:
        if link.body:
            com = () if link.body.com == "center" else link.body.com
            trees += [link.body.mass, *com, *moments(link.body)]
        trees.append(reflected(link.motor))
    nodes = (node for tree in trees for node in walk(tree))
    return tuple(dict.fromkeys(node.name for node in nodes if isinstance(node, Symbol)))


def _joint(row: tuple[Move, ...], link: Link, names: Names | None) -> Joint | None:
    if link.variable is None:
        return None
    k = acting(row, link.variable)
    axis = ScalarMatrix.column(unit_vector(row[k].axis, names))
    pitch = normal(link.row.pitch, names) if isinstance(link.row, ScrewRow) else ZERO_PITCH
    return Joint(link.variable, link.joint, composed(row[:k], names), axis, pitch)


def acting(row: tuple[Move, ...], variable: str) -> int:
    """Which of the motions of a row the joint variable drives."""
    return next(k for k, move in enumerate(row) if Symbol(variable) in walk(move.by))


def _sums(
    rows: Sequence[tuple[Move, ...]], joints: Sequence[Joint | None], names: Names | None
) -> tuple[Form, ...]:
    """One form for each revolute joint: its angle, added to that before where the axes are parallel."""
    forms: list[Form] = []
    carried = ScalarMatrix.identity(3)  # fixed rotation since the last revolute axis
    axis: ScalarMatrix | None = None
    for row, joint in zip(rows, joints, strict=True):
        if joint is None or joint.type == "prismatic":
            carried = carried @ rotation_part(composed(row, names))
            continue
        k = acting(row, joint.variable)
        here = carried @ rotation_part(joint.before) @ joint.axis
        own = Form.of({joint.variable: 1})
        sign = 1 if axis == here else -1 if axis == -here else 0
        forms.append(forms[-1] + own.scaled(sign * _side(forms[-1])) if axis is not None and sign else own)
        carried, axis = rotation_part(composed(row[k + 1 :], names)), joint.axis
    return tuple(forms)


def _side(form: Form) -> Fraction:
    """The sign of the last angle of a sum, for antiparallel axes."""
    return Fraction(1) if form.parts[-1][1] > 0 else Fraction(-1)
