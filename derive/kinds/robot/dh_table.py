"""The table of link parameters after Denavit and Hartenberg: as given, found from the axes, or restated."""

from __future__ import annotations

from typing import Literal, TypeAlias

from derive.derivation import Derivation, PageFacts, Result, Step, Table
from derive.expression import ZERO
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._rows.dh_found import FrameTold, found_rows, frame_lines, frames_told
from derive.kinds.robot._rows.dh_rows import Rows
from derive.kinds.work import Work
from derive.mechanics.motion import Move
from derive.mechanics.poses import composed
from derive.mechanics.robot import Convention, DHRow, Robot

CLAIMED = ("DH",)

CLAIMS = ("table", "each-row|pose", "each-row|arm-composed")
Mode: TypeAlias = Literal["given", "found", "restated"]


class Options(OptionsModel):
    """`convention`: standard or modified; that of the robot if left out."""

    convention: Literal["standard", "modified"] | None = None


class Facts(PageFacts):
    mode: Mode
    convention: Convention
    table: Table
    frames: tuple[FrameTold, ...]  # as they were found
    base: bool  # it is not frame 0
    tool: bool  # it is not frame n


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """The rows as given, each joint variable marked; in the modified convention a and alpha are those of
    the axis before (a_{i-1}, alpha_{i-1}). Rows of the other convention are shifted by one; an arm without
    rows has its frames assigned (Spong et al., section 3.2.2; Craig, section 3.4).

    Raises NotDerivable where frames are to be assigned to a helical joint.
    """
    convention = options.convention or robot.convention
    rows, work = _given(robot), Work(problem)
    frames: tuple[FrameTold, ...] = ()
    if rows is None:
        rows, found = found_rows(robot, convention, problem)
        work, frames = frame_lines(work, found, convention), frames_told(found, convention)
        mode: Mode = "found"
    elif convention == robot.convention:
        mode = "given"
    else:
        mode, rows = "restated", restated(robot, rows, convention)
    results: dict[str, Result] = {"DH": rows.matrix(problem)}
    work = rows.lines(work.step(Step("DH", (), "dh-parameters")))
    results |= {name: work.final(name) for name in rows.ends}
    work = work.linked(but=rows.ends)
    work = rows.each_pose(work) if mode == "given" else rows.proved(work)
    table = rows.table()
    work = work.claim(rows.as_listed(table))
    if frames:
        work = rows.frames_seen(work, robot.base if robot.by_screws else ())
    facts = Facts(
        mode=mode,
        convention=rows.convention,
        table=table,
        frames=frames,
        base="T_base" in rows.ends,
        tool="T_tool" in rows.ends,
    )
    return work.answer("dh-table", results, facts)


def _given(robot: Robot) -> Rows | None:
    """The rows of the robot; None where some are of another form."""
    rows = tuple(link.row for link in robot.links if isinstance(link.row, DHRow))
    if len(rows) < len(robot.links):
        return None
    variables, joints = zip(*((link.variable, link.joint) for link in robot.links), strict=True)
    return Rows(robot.convention, rows, variables, joints)


def restated(robot: Robot, given: Rows, convention: Convention) -> Rows:
    """The same arm in the other convention: theta and d stay in their rows, a and alpha go to the row after
    (to modified) or before (to standard), and what is left over to the tool or the base."""
    rows = given.rows
    if convention == "modified":
        last = (Move("translate", "x", rows[-1].a), Move("rotate", "x", rows[-1].alpha))
        lengths = ((ZERO, ZERO), *((row.a, row.alpha) for row in rows[:-1]))
        base, tool = composed(robot.base), composed((*last, *robot.tool))
    else:
        first = (Move("rotate", "x", rows[0].alpha), Move("translate", "x", rows[0].a))
        lengths = (*((row.a, row.alpha) for row in rows[1:]), (ZERO, ZERO))
        base, tool = composed((*robot.base, *first)), composed(robot.tool)
    shifted = tuple(DHRow(row.theta, row.d, *pair) for row, pair in zip(rows, lengths, strict=True))
    return Rows(convention, shifted, given.variables, given.joints, base, tool)
