"""The table of link parameters after Denavit and Hartenberg: as given, found from the axes, or restated."""

from __future__ import annotations

from typing import Literal

from derive.derivation import Claim, Derivation, PageFacts, Phrase, Record, Result, Step, Table
from derive.expression import ZERO
from derive.kinds.checks import route
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._rows.dh_axes import axes_seen, axes_told
from derive.kinds.robot._rows.dh_checks import as_seen, measures_of, moves_of, products_of, shifted
from derive.kinds.robot._rows.dh_found import found_rows, frame_lines
from derive.kinds.robot._rows.dh_rows import Rows
from derive.kinds.robot._rows.dh_told import (
    Found,
    Given,
    Restated,
    found_told,
    given_told,
    restated_told,
)
from derive.kinds.work import Work
from derive.mechanics.motion import Move
from derive.mechanics.poses import composed
from derive.mechanics.robot import Convention, DHRow, Robot

CLAIMED = {"DH": "table"}

CLAIMS = ("table", "each-row|pose", "each-row|arm-composed", "as-measured")


class Options(OptionsModel):
    """Which rows are wanted."""

    convention: Literal["standard", "modified"] | None = None
    """Where the frames stand on the links; that of the robot if left out."""


class End(Record):
    """What stands before the rows or after them."""

    why: Phrase
    step: str


class Facts(PageFacts):
    table: Table
    given: Given | None = None
    axes: tuple[Phrase, ...] = ()  # how each lies to the one before
    restated: Restated | None = None
    found: Found | None = None
    anew: bool = False  # the arm has other frames, by which it is given
    ends: tuple[End, ...]
    proof: Phrase | None


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """The rows as given, each joint variable marked; in the modified convention a and alpha are those of
    the axis before (a_{i-1}, alpha_{i-1}). Rows of the other convention are shifted by one; an arm without
    rows has its frames assigned (Spong et al., section 3.2.2; Craig, section 3.4).

    Raises NotDerivable where frames are to be assigned to a helical joint.
    """
    convention = options.convention or robot.convention
    given, work = _given(robot), Work(problem)
    moves, products, found, claims = None, None, None, tuple[Claim, ...]()
    axes: tuple[Phrase, ...] = ()
    if given is None:
        rows, assignment = found_rows(robot, convention, problem)
        work, found = frame_lines(work, assignment, convention), found_told(assignment, convention)
        claims = (measures_of(found, convention), as_seen(work, found.frames))
    elif convention == robot.convention:
        rows, moves = given, given_told(convention)
        claims = (moves_of(moves, convention),)
        if axes := axes_told(given.rows, convention, problem.where):
            claims = (*claims, route("axes-seen", axes_seen(axes, convention, problem)))
    else:
        rows, products = restated(robot, given, convention), restated_told(robot.convention, convention)
        claims = (
            *products_of(products, robot.convention, convention),
            shifted(products, rows.rows, given.rows),
        )
    results: dict[str, Result] = {"DH": rows.matrix(problem)}
    work = rows.lines(work.step(Step("DH", (), "dh-parameters")))
    if rows is not given:
        results |= {name: work.final(name) for name in rows.ends}
    work = work.linked(but=rows.ends)
    work = rows.each_pose(work) if rows is given else work
    work = rows.proved(work) if rows is not given or rows.ends else work
    table = rows.table()
    work = work.claim(rows.as_listed(table), *claims)
    if given is None:
        work = rows.frames_seen(work, robot.base if robot.by_screws else ())
    facts = Facts(
        table=table,
        given=moves,
        axes=axes,
        restated=products,
        found=found,
        anew=not robot.by_screws,
        ends=tuple(End(why=Phrase(name), step=name) for name in rows.ends),
        proof=None if rows is given else Phrase("same-pose"),
    )
    return work.answer("dh-table", results, facts)


def _given(robot: Robot) -> Rows | None:
    """The rows of the robot; None where some are of another form."""
    rows = tuple(link.row for link in robot.links if isinstance(link.row, DHRow))
    if len(rows) < len(robot.links):
        return None
    variables, joints = zip(*((link.variable, link.joint) for link in robot.links), strict=True)
    base, tool = composed(robot.base), composed(robot.tool)
    return Rows(robot.convention, rows, variables, joints, base, tool)


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
