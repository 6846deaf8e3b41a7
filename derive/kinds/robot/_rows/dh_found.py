"""Link parameters found from the joint axes: the frames of the convention, one after the other, as steps."""

from __future__ import annotations

from fractions import Fraction

from derive.algebra.normal import trig_of
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable
from derive.expression import Degrees, Expr, Sum, Symbol, add, atan2, cross
from derive.kinds.pose._numbers import fixed_angle, known_angle
from derive.kinds.problem import Problem
from derive.kinds.robot._rows.dh_rows import Rows
from derive.kinds.robot._rows.dh_told import joins
from derive.kinds.work import Work
from derive.mechanics.assignment import Assignment, Pair, Parameters, assigned
from derive.mechanics.lines import Line
from derive.mechanics.poses import composed
from derive.mechanics.robot import Convention, DHRow, Robot
from derive.mechanics.screws import home_of, screw_form, screws_of

QUARTERS = tuple(Fraction(n, 2) for n in (0, 1, 2, -1))


def found_rows(robot: Robot, convention: Convention, problem: Problem) -> tuple[Rows, Assignment]:
    """The rows of an arm and the frames they belong to. Raises NotDerivable for a helical joint."""
    arm = screw_form(robot, problem.readable)
    if helical := [link.variable or "" for link in arm.links if link.joint == "helical"]:
        raise NotDerivable(
            f"joint {helical[0]} turns and slides at once; no row of link parameters does that"
        )
    screws = screws_of(arm)
    found = assigned([Line(screw.w, screw.q) for screw in screws], home_of(arm), convention)
    rows = tuple(
        _row(parameters, screw.row.by, screw.row.slide, problem)
        for parameters, screw in zip(found.rows, screws, strict=True)
    )
    variables = tuple(link.variable for link in arm.links)
    joints = tuple(link.joint for link in arm.links)
    base = composed(robot.base) @ found.base if robot.by_screws else found.base
    return Rows(convention, rows, variables, joints, base, found.tool), found


def _row(at_zero: Parameters, by: Expr, slide: bool, problem: Problem) -> DHRow:
    """The row with the joint's variable in its column."""
    theta, d = angle_of(at_zero.theta, problem), problem.readable(at_zero.d)
    if slide:
        d = _together(by, d)
    else:
        theta = _together(by, theta)
    return DHRow(theta, d, problem.readable(at_zero.a), angle_of(at_zero.alpha, problem))


def _together(by: Expr, offset: Expr) -> Expr:
    """Their sum, the joint's variable first and the degrees of both added up last."""
    parts = [part for each in (by, offset) for part in (each.terms if isinstance(each, Sum) else (each,))]
    turn = sum((part.value for part in parts if isinstance(part, Degrees)), Fraction(0))
    fixed = (Degrees(turn),) if turn else ()
    return add(*(part for part in parts if not isinstance(part, Degrees)), *fixed)


def angle_of(pair: Pair, problem: Problem) -> Expr:
    """An angle by its cosine and sine: in degrees or by its name where it can be recognised."""
    c, s = pair
    if c.constant is not None and s.constant is not None:
        return known_angle(atan2(problem.readable(s), problem.readable(c)), problem)
    for form in c.ring.union(s.ring).angles:
        for sign in (1, -1):
            for quarter in QUARTERS:
                angle = sum((Scalar.symbol(a) * n * sign for a, n in form.parts), Scalar.of(0))
                if trig_of(angle + Scalar.symbol("pi") * quarter) == (c, s):
                    return problem.readable(angle) + fixed_angle(quarter, problem)
    return atan2(problem.readable(s), problem.readable(c))


def frame_lines(work: Work, found: Assignment, convention: Convention) -> Work:
    """z_i, x_i and o_i (3 by 1) of every frame of an assignment."""
    for i, frame in enumerate(found.frames):
        x, z, o = (Symbol(f"{letter}_{i}") for letter in "xzo")
        work = work.line(z, value=frame.z, rule="axis")
        work = work.line(x, *_reason(i, found, joins(i, convention)), value=frame.x, rule="normal")
        work = work.line(o, value=frame.o, rule="origin")
    return work


def _reason(i: int, found: Assignment, pair: tuple[int, int]) -> tuple[Expr, ...]:
    """z_a x z_b of axes that meet, where it has the length 1; the axis before of axes on one line."""
    frame, (a, b) = found.frames[i], pair
    if frame.kind == "intersecting":
        product = found.frames[a].z.cross(found.frames[b].z)
        if (-product if frame.turned else product) != frame.x:
            return ()
        formula = cross(Symbol(f"z_{a}"), Symbol(f"z_{b}"))
        return (-formula if frame.turned else formula,)
    if i and frame.x == found.frames[i - 1].x and frame.kind in ("coincident", "last"):
        return (Symbol(f"x_{i - 1}"),)
    return ()
