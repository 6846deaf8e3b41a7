"""An open chain in normal form: its local poses, its joint axes, and the poses of its frames."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import TypeVar

from derive.algebra.angles import Form
from derive.algebra.exact_values import with_offset
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal
from derive.algebra.ring import Ring, ring
from derive.algebra.scalar import Scalar
from derive.algebra.trigonometry import linear_form
from derive.expression import Symbol, walk
from derive.mechanics.bodies import coordinates
from derive.mechanics.coupling import Coupling, angle_sums, coupling
from derive.mechanics.dh import moves
from derive.mechanics.dynamics import gravity_of
from derive.mechanics.frame_tree import pose_of
from derive.mechanics.joint_loads import reflected
from derive.mechanics.lines import Line
from derive.mechanics.moments import moments
from derive.mechanics.motion import Move
from derive.mechanics.poses import composed, position_part, rotation_part, unit_vector
from derive.mechanics.robot import JointType, Link, Robot, ScrewRow

Part = TypeVar("Part")
ZERO_PITCH = Scalar.of(0)
NOTHING = Form(())


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
    motion included. T_tool is the pose of the end-effector. joints[i] and lines[i], its axis
    in the base frame, belong to row i+1; where there is a `coupling` they tell of the row with the star, and
    not all that its variable moves."""

    T_local: tuple[ScalarMatrix, ...]
    T: tuple[ScalarMatrix, ...]
    T_tool: ScalarMatrix
    joints: tuple[Joint | None, ...]
    lines: tuple[Line | None, ...]
    coupling: Coupling | None = None

    @property
    def variables(self) -> tuple[str, ...]:
        """The joint variables, in the order of the rows."""
        return tuple(joint.variable for joint in self.joints if joint)

    @property
    def moving(self) -> Iterator[tuple[int, Joint]]:
        """(row, joint) of the rows that move, rows from 1."""
        return ((i, joint) for i, joint in enumerate(self.joints, 1) if joint)

    def axis(self, i: int) -> ScalarMatrix:
        """The axis of the joint of row i in the base frame (3 by 1)."""
        return self._line(i).direction

    def point(self, i: int) -> ScalarMatrix:
        """A point on the axis of the joint of row i in the base frame (3 by 1)."""
        return self._line(i).point

    def joint(self, i: int) -> Joint:
        """The joint of row i, counted from 1. Raises ValueError for a fixed row."""
        return _existing(self.joints[i - 1], i)

    def _line(self, i: int) -> Line:
        return _existing(self.lines[i - 1], i)


def _existing(part: Part | None, i: int) -> Part:
    if part is None:
        raise ValueError(f"row {i} has no joint")
    return part


@dataclass(frozen=True, slots=True)
class _Row:
    """The motions of a row in three parts (4 by 4): before its joint's, that one, and after it. `turned` is
    what stands in the angle of a revolute joint beside its variable, about its axis."""

    parts: tuple[ScalarMatrix, ScalarMatrix, ScalarMatrix]
    joint: Joint | None
    turned: Form = NOTHING

    def local(self, home: Ring) -> ScalarMatrix:
        """Frame i-1 to frame i."""
        before, own, after = (part.into(home) for part in self.parts)
        return before @ own @ after


def chain(robot: Robot, names: Names | None = None) -> Chain:
    """The robot in one ring: its angles are the sums over parallel axes, its symbols all those of the
    robot, bodies and gravity included, so that nothing has to change rings later."""
    rows = [_row(moves(link, robot), link, names) for link in robot.links]
    base, tool = composed(robot.base, names), tool_pose(robot, names)
    parts = [base, *(part for row in rows for part in row.parts), tool]
    sums = angle_sums(robot, names) if robot.coupled else _sums(rows)
    home = _home(parts, sums, parameters(robot))
    T_local = tuple(row.local(home) for row in rows)
    T = _products(base.into(home), T_local)
    joints = tuple(row.joint for row in rows)
    end = T[-1] if robot.home is None else T[-1] @ pose_of(robot.home, names)
    return Chain(
        T_local, T, T[-1] @ tool.into(home), joints, tuple(map(_line, T, joints)),
        coupling(robot, T, end, names),
    )  # fmt: skip


def _line(T: ScalarMatrix, joint: Joint | None) -> Line | None:
    """The axis of the joint that follows the frame of pose T."""
    if joint is None:
        return None
    before = joint.before.into(T.ring)
    direction = rotation_part(T) @ (rotation_part(before) @ joint.axis)
    return Line(direction, rotation_part(T) @ position_part(before) + position_part(T))


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
    """All symbols at once, so that few rings are made on the way."""
    rings = list(dict.fromkeys(matrix.ring for matrix in matrices))
    symbols = [name for each in rings for name in each.symbols]
    angles = reduce(lambda home, form: home if home.trig(form) else home.with_angle(form), sums, ring())
    return reduce(Ring.union, rings, angles.with_symbols([*symbols, *names]))


def parameters(robot: Robot) -> tuple[str, ...]:
    """Every symbol of the bodies and of gravity, in order of first use."""
    trees = list(gravity_of(robot))
    for link in robot.links:
        if link.body:
            trees += [link.body.mass, *coordinates(link.body), *moments(link.body)]
        trees.append(reflected(link.motor))
    nodes = (node for tree in trees for node in walk(tree))
    return tuple(dict.fromkeys(node.name for node in nodes if isinstance(node, Symbol)))


def _row(row: tuple[Move, ...], link: Link, names: Names | None) -> _Row:
    nothing = ScalarMatrix.identity(4)
    if link.variable is None:
        return _Row((composed(row, names), nothing, nothing), None)
    k = acting(row, link.variable)
    before, own, after = (composed(part, names) for part in (row[:k], row[k : k + 1], row[k + 1 :]))
    axis = ScalarMatrix.column(unit_vector(row[k].axis, names))
    by = normal(row[k].by)
    if by.diff(link.variable) == -1:
        axis, by = -axis, -by  # to turn about z by -q is to turn about -z by q
    pitch = normal(link.row.pitch, names) if isinstance(link.row, ScrewRow) else ZERO_PITCH
    turned = with_offset(linear_form(by)).fixed if link.joint == "revolute" else NOTHING
    return _Row((before, own, after), Joint(link.variable, link.joint, before, axis, pitch), turned)


def acting(row: tuple[Move, ...], variable: str) -> int:
    """Which of the motions of a row the joint variable drives."""
    return next(k for k, move in enumerate(row) if Symbol(variable) in walk(move.by))


def _sums(rows: Sequence[_Row]) -> tuple[Form, ...]:
    """One form for each revolute joint: its angle, added to that before where the axes are parallel."""
    forms: list[Form] = []
    carried = ScalarMatrix.identity(3)  # fixed rotation since the last revolute axis
    axis: ScalarMatrix | None = None
    for row in rows:
        before, own, after = map(rotation_part, row.parts)
        joint = row.joint
        if joint is None or joint.type == "prismatic":
            carried = carried @ before @ own @ after
            continue
        here = carried @ before @ joint.axis
        angle = Form.of({joint.variable: 1}) + row.turned
        sign = 1 if axis == here else -1 if axis == -here else 0
        forms.append(
            forms[-1] + angle.scaled(sign * _side(forms[-1])) if axis is not None and sign else angle
        )
        carried, axis = after, joint.axis
    return tuple(forms)


def _side(form: Form) -> Fraction:
    """The sign of the last angle of a sum, for antiparallel axes."""
    return Fraction(1) if form.moving.parts[-1][1] > 0 else Fraction(-1)
