"""Link parameters found from the joint axes: the frames of the convention, one after the other, as steps."""

from __future__ import annotations

from fractions import Fraction

from derive.algebra.normal import trig_of
from derive.algebra.scalar import Scalar
from derive.derivation import Record, Step
from derive.errors import NotDerivable
from derive.expression import Degrees, Expr, Sum, Symbol, add, atan2, cross, negate
from derive.kinds.pose._angles import fixed_angle, known_angle
from derive.kinds.problem import Problem
from derive.kinds.robot._rows.dh_rows import Rows
from derive.mechanics.assignment import Assignment, Pair, Parameters, Placed, assigned
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
                    return add(problem.readable(angle), fixed_angle(quarter, problem))
    return atan2(problem.readable(s), problem.readable(c))


class FrameTold(Record):
    number: int
    kind: str
    pair: tuple[int, int]  # the two z axes that x joins
    turned: bool


class FrameSteps:
    """The frames of an assignment for the page."""

    def __init__(self, problem: Problem, found: Assignment, convention: Convention) -> None:
        self.problem, self.found, self.convention = problem, found, convention

    def steps(self) -> tuple[Step, ...]:
        """x_i, z_i and o_i of every frame."""
        return tuple(step for i, frame in enumerate(self.found.frames) for step in self._frame(i, frame))

    def _frame(self, i: int, frame: Placed) -> list[Step]:
        x, z, o = (Symbol(f"{letter}_{i}") for letter in "xzo")
        read = self.problem.readable_matrix
        return [
            Step(z.name, (z, read(frame.z)), "axis"),
            Step(x.name, (x, *self._reason(i, frame), read(frame.x)), "normal"),
            Step(o.name, (o, read(frame.o)), "origin"),
        ]

    def _reason(self, i: int, frame: Placed) -> tuple[Expr, ...]:
        """z_a x z_b of axes that meet; the axis before of axes on one line."""
        a, b = self.pair(i)
        if frame.kind == "intersecting":
            product = cross(Symbol(f"z_{a}"), Symbol(f"z_{b}"))
            sine = self._size(a, b, frame)
            return (negate(product) if frame.turned else product,) if sine else ()
        if i and frame.x == self.found.frames[i - 1].x and frame.kind in ("coincident", "last"):
            return (Symbol(f"x_{i - 1}"),)
        return ()

    def _size(self, a: int, b: int, frame: Placed) -> bool:
        """Whether the product of the axes has the length 1."""
        frames = self.found.frames
        product = frames[a].z.cross(frames[b].z)
        return (-product if frame.turned else product) == frame.x

    def pair(self, i: int) -> tuple[int, int]:
        """The two z axes that x_i joins."""
        return (i - 1, i) if self.convention == "standard" else (i, i + 1)

    def definitions(self) -> dict[Expr, Expr]:
        return {Symbol(step.name): step.result for step in self.steps()}

    def told(self) -> tuple[FrameTold, ...]:
        """How each frame came about."""
        return tuple(
            FrameTold(number=i, kind=frame.kind, pair=self.pair(i), turned=frame.turned)
            for i, frame in enumerate(self.found.frames)
        )
