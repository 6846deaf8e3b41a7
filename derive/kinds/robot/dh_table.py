"""The table of link parameters after Denavit and Hartenberg: as given, found from the axes, or restated."""

from __future__ import annotations

from typing import Literal, TypeAlias

from derive.derivation import Claim, Derivation, PageFacts, Result, Step, Table
from derive.expression import ZERO
from derive.kinds.checks import links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._rows.dh_found import FrameSteps, FrameTold, found_rows
from derive.kinds.robot._rows.dh_rows import IDENTITY, Rows
from derive.mechanics.motion import Move
from derive.mechanics.poses import composed
from derive.mechanics.robot import Convention, DHRow, Robot

RESULTS = {
    "DH": "one row a link: theta, d, a, alpha; the joint variable unstarred",
    "T_base": "frame 0 in the base (4 by 4), where rows were found or restated and it is not the same",
    "T_tool": "the end-effector in frame n (4 by 4), where it is not the same",
}
EXAMPLE = """\
title: Link parameters
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  questions:
  - {find: dh-table}
  - {find: dh-table, convention: modified}
"""
Mode: TypeAlias = Literal["given", "found", "restated"]
TABLE = Step("DH", (), "dh-parameters")


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
    rows has its frames assigned (Spong et al., section 3.2.2; Craig, section 3.4)."""
    convention = options.convention or robot.convention
    given = _given(robot)
    if given is None:
        return _found(robot, convention, problem)
    if convention == robot.convention:
        return _derivation(given, problem, "given", (TABLE,), (given.each_pose(problem),))
    rows = restated(robot, given, convention)
    steps = (*rows.ends(problem), TABLE)
    return _derivation(rows, problem, "restated", steps, rows.claims(problem))


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


def _found(robot: Robot, convention: Convention, problem: Problem) -> Derivation:
    rows, found = found_rows(robot, convention, problem)
    frames = FrameSteps(problem, found, convention)
    steps = (*frames.steps(), *rows.ends(problem), TABLE)
    claims = (
        *links(steps, {**problem.names, **frames.definitions()}),
        *rows.claims(problem),
    )
    return _derivation(rows, problem, "found", steps, claims, frames.told())


def _derivation(
    rows: Rows,
    problem: Problem,
    mode: Mode,
    steps: tuple[Step, ...],
    claims: tuple[Claim, ...],
    frames: tuple[FrameTold, ...] = (),
) -> Derivation:
    results: dict[str, Result] = {"DH": rows.matrix(problem)}
    results |= {step.name: problem.final(step.result) for step in rows.ends(problem)}
    facts = Facts(
        mode=mode,
        convention=rows.convention,
        table=rows.table(),
        frames=frames,
        base=rows.base != IDENTITY,
        tool=rows.tool != IDENTITY,
    )
    return Derivation("dh-table", steps, results, claims, facts=facts)
