"""What the kinds of a robot share: its chain, and the names its frames, axes and origins go by."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from derive.algebra.matrix import ScalarMatrix
from derive.expression import Symbol
from derive.kinds.problem import Problem
from derive.kinds.robot._couplings import drive_names
from derive.kinds.work import Work
from derive.mechanics.chain import Chain, Joint, chain
from derive.mechanics.oracle import Oracle
from derive.mechanics.poses import position_part, rotation_part
from derive.mechanics.robot import DHRow, Robot

TOOL = "e"  # the end-effector's frame where a tool follows the last row
LINKS_ALONE = frozenset({"forward-kinematics"})  # unread by what needs no more than the poses of the links
BODIES_ALONE = frozenset({"inertia-matrix"})  # unread by what needs no more than their part in the sums


def chain_of(problem: Problem) -> Chain:
    """The chain of the problem's robot, `where` names kept."""
    return chain(problem.subject)


def oracle_of(problem: Problem) -> Oracle:
    """The arm in numbers, one for all that is asked about it: it remembers the places where it has been."""
    found = problem.memo.seen.get(Oracle)
    if not isinstance(found, Oracle):
        found = problem.memo.seen[Oracle] = Oracle(problem.subject, problem.where)
    return found


def pose_name(i: int, reference: int = 0) -> Symbol:
    """T_2^0."""
    return Symbol(f"T_{i}^{reference}")


def end_frame(robot: Robot) -> str:
    """The index of the end-effector's frame: `e` where a tool follows the last row, or the home pose of a
    chain of screws, whose frames all stand in the base while its joints are at zero."""
    return TOOL if robot.ends_in_tool else str(len(robot.links))


def axis_names(found: Chain, robot: Robot, i: int) -> tuple[Symbol, Symbol]:
    """(axis, point) of joint i: z_{i-1}, o_{i-1} after Denavit and Hartenberg, z_i, o_i in the modified
    convention; k_i, p_i where a free row or the base puts its axis elsewhere."""
    joint = found.joint(i)
    upright = ScalarMatrix.column((0, 0, 1))
    along_z = joint.axis == upright
    if robot.convention == "modified" and isinstance(robot.links[i - 1].row, DHRow) and along_z:
        return Symbol(f"z_{i}"), Symbol(f"o_{i}")
    if i == 1 and robot.base:
        return Symbol("k_1"), Symbol("p_1")
    turned_about_z = rotation_part(joint.before).columns(2) == upright  # a slide with a fixed angle
    if along_z and turned_about_z and not any(position_part(joint.before).entries):
        return Symbol(f"z_{i - 1}"), Symbol(f"o_{i - 1}")
    return Symbol(f"k_{i}"), Symbol(f"p_{i}")


def axis_and_point(found: Chain, robot: Robot, i: int) -> tuple[ScalarMatrix, ScalarMatrix]:
    """The vectors those names stand for (3 by 1, base frame)."""
    _, point = axis_names(found, robot, i)
    if point.name == f"o_{i}":
        return rotation_part(found.T[i]).columns(2), position_part(found.T[i])
    return found.axis(i), found.point(i)


def axis_lines(work: Work, found: Chain, last: int | None = None) -> Work:
    """z and o of every joint up to row `last` as lines, each vector once."""
    done = set()
    for name, value in _vectors(found, work.problem.subject, last):
        if name not in done:
            work = work.line(name, value=value, rule="extract")
        done.add(name)
    return work


def _vectors(found: Chain, robot: Robot, last: int | None) -> Iterator[tuple[Symbol, ScalarMatrix]]:
    """(name, value) of each axis and each point on one."""
    if found.coupling is None:
        for i in joint_numbers(found, lambda _: True, last):
            yield from zip(axis_names(found, robot, i), axis_and_point(found, robot, i), strict=True)
        return
    for drive in found.coupling.drives:
        axis, point = drive_names(found, robot, drive)
        yield axis, drive.axis
        if not drive.slides:
            frame = point.name.removeprefix("o_")
            yield point, position_part(found.T[int(frame)]) if point.name.startswith("o_") else drive.point


def joint_numbers(found: Chain, which: Callable[[Joint], bool], last: int | None = None) -> tuple[int, ...]:
    """The numbers of the joints of a sort, up to row `last`."""
    return tuple(i for i, joint in found.moving if which(joint) and i <= (last or i))
