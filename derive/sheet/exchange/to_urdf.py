"""A robot as URDF: a joint for each row, its body in the frame of its link, the end-effector on a fixed one.

Sheets know no effort and no speed limit, and URDF asks for both: generous ones are written.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, hypot, pi
from xml.sax.saxutils import quoteattr

import numpy as np

from derive.algebra.numbers.floats import Point, number
from derive.errors import SheetError
from derive.expression import ZERO, free_symbols
from derive.kinds.problem import expressions
from derive.mechanics.bodies import Body
from derive.mechanics.oracle.arm import Oracle
from derive.mechanics.oracle.bodies import inertia_of
from derive.mechanics.robot import Link, Robot
from derive.sheet.exchange.frames_out import Array, Placed, numbers_of, placed
from derive.sheet.source import At

EFFORT = 'effort="1000" velocity="100"'
REACH = 10.0  # m either way: of a joint that slides and has no range
ZERO_BELOW = 1e-15
TURN = "put a turn before the arm: base: [{rotate: x, by: 90 deg}] lets -y point down"


def urdf(robot: Robot, at: At, values: Point) -> tuple[str, list[SheetError]]:
    """The text of the file, and what of the robot does not stand in it. Raises SheetErrors."""
    trees = [tree for tree in expressions(robot) if tree is not None]
    in_gravity = {id(tree) for tree in robot.gravity or ()}
    needed = {name for tree in trees if id(tree) not in in_gravity for name in free_symbols(tree)}
    point = numbers_of(robot, values, needed, at)
    rows = list(placed(robot, point, at))
    lines = [f"<robot name={quoteattr(robot.name or 'robot')}>", '  <link name="base"/>']
    for index, row in enumerate(rows, 1):
        lines += _link(f"link{index}", row, point, before=rows[index - 2].within if index > 1 else None)
        lines += _joint(index, row, point)
    end = rows[-1].within @ Oracle(robot, {}).in_hand(point)
    if not np.allclose(end, np.eye(4), atol=ZERO_BELOW):
        lines += ['  <link name="tool"/>', '  <joint name="to_tool" type="fixed">']
        lines += [*_ends(f"link{len(rows)}", "tool"), f"    {_origin(end)}", "  </joint>"]
    lines.append("</robot>")
    return '<?xml version="1.0"?>\n' + "\n".join(lines) + "\n", list(_left_out(robot, at))


def _joint(index: int, row: Placed, point: Point) -> Iterator[str]:
    kind, limit = _kind(row, point)
    name = row.link.variable or (f"follower{index}" if row.follows else f"fixed{index}")
    yield f"  <joint name={quoteattr(name)} type={quoteattr(kind)}>"
    yield from _ends(f"link{index - 1}" if index > 1 else "base", f"link{index}")
    yield f"    {_origin(row.place)}"
    if row.axis is not None:
        yield f'    <axis xyz="{_three(row.axis)}"/>'
    if limit:
        yield f"    {limit}"
    if friction := row.link.friction:
        damping, coulomb = number(friction.viscous, point), number(friction.coulomb, point)
        yield f'    <dynamics damping="{_digits(damping)}" friction="{_digits(coulomb)}"/>'
    if follows := row.follows:
        of = f'multiplier="{_digits(follows.ratio)}" offset="{_digits(follows.offset)}"'
        yield f"    <mimic joint={quoteattr(follows.variable)} {of}/>"
    yield "  </joint>"


def _kind(row: Placed, point: Point) -> tuple[str, str]:
    """The type of a joint, and its limits."""
    if row.axis is None:
        return "fixed", ""
    if row.link.range:
        low, high = (number(each, point) for each in row.link.range)
    elif row.turns:
        return "continuous", f"<limit {EFFORT}/>"
    else:
        low, high = -REACH, REACH
    kind = "revolute" if row.turns else "prismatic"
    return kind, f'<limit lower="{_digits(low)}" upper="{_digits(high)}" {EFFORT}/>'


def _link(name: str, row: Placed, point: Point, before: Array | None) -> Iterator[str]:
    if (body := row.link.body) is None:
        yield f'  <link name="{name}"/>'
        return
    R = row.within[:3, :3]
    com = row.within @ np.array([*_com(body, row, point, before), 1.0])
    I = R @ inertia_of(body, point) @ R.T
    entries = zip(("xx", "xy", "xz", "yy", "yz", "zz"), I[np.triu_indices(3)], strict=True)
    yield f'  <link name="{name}">'
    yield "    <inertial>"
    yield f'      <origin xyz="{_three(com[:3])}"/>'
    yield f'      <mass value="{_digits(number(body.mass, point))}"/>'
    yield "      <inertia " + " ".join(f'i{axes}="{_digits(each)}"' for axes, each in entries) + "/>"
    yield "    </inertial>"
    yield "  </link>"


def _com(body: Body, row: Placed, point: Point, before: Array | None) -> Array:
    """In the frame of the row."""
    if body.com != "center":
        return np.array([number(each, point) for each in body.com])
    place = row.place if before is None else np.linalg.inv(before) @ row.place
    back = np.linalg.inv(place @ row.within)  # the joint moves no middle that may be asked for
    return np.array(back[:3, 3] / 2)


def _left_out(robot: Robot, at: At) -> Iterator[SheetError]:
    if robot.gravity and (robot.gravity[0], robot.gravity[1]) != (ZERO, ZERO):
        yield at.fault("URDF has no gravity, and simulators let it act along -z", ("gravity",), TURN)
    for index, link in enumerate(robot.links):
        yield from _left_out_of(link, at / "links" / index, robot)


def _left_out_of(link: Link, at: At, robot: Robot) -> Iterator[SheetError]:
    if link.motor:
        yield at.fault("URDF has no rotor: that of this row is left out", ("motor",))
    if link.joint == "prismatic" and link.range is None:
        message = f"{link.variable} has no range, and URDF asks for one: 10 m either way is written"
        yield at.fault(message, (), "give it one: range: [0, 0.5 m]")


def _ends(parent: str, child: str) -> tuple[str, str]:
    return f"    <parent link={quoteattr(parent)}/>", f"    <child link={quoteattr(child)}/>"


def _origin(T: Array) -> str:
    return f'<origin xyz="{_three(T[:3, 3])}" rpy="{_three(roll_pitch_yaw(T[:3, :3]))}"/>'


def roll_pitch_yaw(R: Array) -> Array:
    """The angles (rad) with R = R_z(yaw) R_y(pitch) R_x(roll); no yaw where the pitch is a quarter turn."""
    across = hypot(R[0, 0], R[1, 0])
    pitch = atan2(-R[2, 0], across)
    if across > 1e-12:
        angles = atan2(R[2, 1], R[2, 2]), pitch, atan2(R[1, 0], R[0, 0])
    else:
        angles = atan2(-R[1, 2], R[1, 1]), pitch, 0.0
    return np.array([_quarter(angle) for angle in angles])


def _quarter(angle: float) -> float:
    """An angle, exactly a quarter turn or more of them where it is within rounding."""
    exact = round(angle / (pi / 2)) * (pi / 2)
    return exact if abs(exact - angle) < 1e-14 else angle


def _three(vector: Array) -> str:
    return " ".join(_digits(float(each)) for each in vector)


def _digits(value: float) -> str:
    value = float(value)
    return "0" if abs(value) < ZERO_BELOW else repr(int(value)) if value == int(value) else repr(value)
