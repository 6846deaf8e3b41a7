"""The inverse of the planar arm of two revolute joints, by the triangle its links form with the target."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from derive.algebra.normal import normal
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.scalar import Scalar
from derive.derivation import Branch, Cell, Claim, Condition, Derivation, Drawing, Phrase, Said, Step
from derive.expression import (
    ONE,
    PI,
    Expr,
    Number,
    Relation,
    Symbol,
    add,
    atan2,
    cos,
    multiply,
    number,
    sin,
    sqrt,
    terms_of,
)
from derive.figures.arm_values import values_of
from derive.figures.elbows import TwoLinks, drawn
from derive.figures.typical import completed
from derive.kinds.checks import close, route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.at_pose import Configuration
from derive.kinds.robot._inverse.checks import Tried, as_printed
from derive.kinds.robot._inverse.evaluated import SMALL, Evaluated, at_point, evaluated, in_degrees
from derive.kinds.robot._inverse.facts import ElbowTold, Facts, Triangle
from derive.kinds.robot._inverse.given import refuse_namesakes
from derive.kinds.robot._inverse.lines import equal
from derive.kinds.robot._inverse.one_equation import of_sign
from derive.kinds.robot._inverse.placed import Placed
from derive.kinds.robot._inverse.ranges import Ranges
from derive.kinds.robot._inverse.sampled import sample_points
from derive.kinds.robot._inverse.signs import opposite, over, signed, square, total
from derive.kinds.robot._inverse.target import SAME, Target, Values
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import of_coordinates
from derive.mechanics.inverse.two_link import TwoLink

ELBOWS = {"elbow-down": 1, "elbow-up": -1}  # the sign of theta_2
POINTS = 5


def has_triangle(arm: TwoLink, problem: Problem) -> bool:
    """Whether both lengths are, as far as they are known; a typed one may be negative."""
    point = completed(values_of(problem.subject, problem.where)[0], problem.where)
    return all(scalar_number(length, point) > 0 for length in (arm.a_1, arm.a_2))


def derive(
    arm: TwoLink, chain: Chain, given: tuple[str, ...], place: Place | None, problem: Problem
) -> Derivation:
    """By the triangle of the two links and the law of cosines (Spong et al., section 1.4.2; Craig, 4.4)."""
    refuse_namesakes(given, chain.variables)
    x, y = map(Symbol, given)
    writing = _Writing(problem, arm, x, y)
    steps = writing.steps()
    conditions: list[tuple[Condition, ...]] = [
        (Phrase(elbow), of_sign(writing.theta_2, sign)) for elbow, sign in ELBOWS.items()
    ]
    branches = [
        Branch(writing.values(sign), when) for sign, when in zip(ELBOWS.values(), conditions, strict=True)
    ]
    target = Target.of(problem, chain, of_coordinates(chain.T_tool, given, chain.variables))
    values = evaluated(branches, place, problem, partial(_in_numbers, branches, conditions, arm, target))
    ranges = Ranges.of(problem, place)
    values = ranges.judged(values)
    work = Work(problem, uses=(problem.ask("forward-kinematics"),), aside=writing.position())
    work = work.showing(*steps).linked(
        but=[step.name for step in steps if step.rule in ("branch", "difference")]
    )
    tried = _tried(branches, target, sample_points(chain, target.goal, problem, POINTS))
    work = work.claim(*tried.claims(), as_printed(tried, branches, ()))
    placed = Placed(target, branches, (), values, dict)
    work = work.claim(*placed.claims(place, problem))
    triangle = writing.triangle(conditions)
    work = work.claim(*Seen(tried, steps, writing.lengths, triangle).claims())
    work = work.claim(*ranges.claims(values))
    facts = Facts(
        triangle=triangle,
        feasible=ranges.said,
        turn_limits=ranges.of_angles,
        place=values.place.said,
        labels=_labels(conditions, values),
        remark=values.remark,
        angle_results=chain.variables,
        style=problem.style,
        in_degrees=in_degrees(problem, place),
    )
    results = {"solutions": tuple(branches)}
    plots = (writing.elbows(triangle),)
    return work.answer("inverse-kinematics", results, facts, evaluated=values.values, plots=plots)


def _labels(conditions: Sequence[tuple[Condition, ...]], values: Evaluated) -> tuple[Cell, ...]:
    """What each solution at a point is called: by its elbow, where that is not stretched or folded."""
    return tuple(conditions[k[0]][:1] if len(k) == 1 else Phrase("both") for k in values.branches)


class _Writing:
    """The formulas of one arm in its own names."""

    def __init__(self, problem: Problem, arm: TwoLink, x: Symbol, y: Symbol) -> None:
        self.problem, self.arm, self.x, self.y = problem, arm, x, y
        self.theta_1, self.theta_2 = Symbol(arm.theta_1), Symbol(arm.theta_2)
        self.a_1, self.a_2 = problem.readable(arm.a_1), problem.readable(arm.a_2)
        self.lengths = self.a_1, self.a_2
        self.square = x**2 + y**2

    def position(self) -> dict[Expr, Expr]:
        """x and y by forward kinematics."""
        elbow = self.theta_1 + self.theta_2
        parts = zip((self.x, self.y), (cos, sin), strict=True)
        return {name: multiply(self.a_1, f(self.theta_1)) + multiply(self.a_2, f(elbow)) for name, f in parts}

    def steps(self) -> tuple[Step, ...]:
        """The position, the triangle, c_2, and for each elbow theta_2; then theta_1."""
        position = [
            Step(str(name.name), (name, value), "position")
            for name, value in self.position().items()
            if isinstance(name, Symbol)
        ]
        cosine, length = cos(self.theta_2), multiply(number(2), self.a_1, self.a_2)
        sides = add(*terms_of(total(map(square, self.lengths))), -(self.x**2), -(self.y**2))
        inside = cos(PI - self.theta_2)
        triangle = Step("triangle", (inside, sides / length), "law-of-cosines")
        solved = Step("c_2", (cosine, self.told_cosine()), "law-of-cosines")
        elbows = [
            Step(elbow.replace("-", "_"), (self.theta_2, atan2(self.sine(sign, cosine), cosine)), "branch")
            for elbow, sign in ELBOWS.items()
        ]
        shoulder = self.shoulder(cosine, sin(self.theta_2))
        return (*position, triangle, solved, *elbows, Step("theta_1", (self.theta_1, shoulder), "difference"))

    def cosine(self) -> Expr:
        """cos theta_2 in the given coordinates."""
        x, y = Scalar.symbol(self.x.name), Scalar.symbol(self.y.name)
        a_1, a_2 = self.arm.a_1, self.arm.a_2
        top, bottom = x * x + y * y - a_1 * a_1 - a_2 * a_2, 2 * a_1 * a_2
        if bottom.constant is not None:
            return self.problem.readable(top / bottom)
        return self.problem.readable(top) / self.problem.readable(bottom)

    def told_cosine(self) -> Expr:
        """The same as the page has it, over what stood in the line before where that is a whole number."""
        bottom = multiply(number(2), *self.lengths)
        if not isinstance(bottom, Number) or bottom.value.denominator > 1 or bottom.decimal:
            return self.cosine()
        return over(
            add(self.x**2, self.y**2, *map(opposite, terms_of(total(map(square, self.lengths))))), bottom
        )

    @staticmethod
    def sine(sign: int, cosine: Expr) -> Expr:
        return signed(sign, sqrt(ONE - cosine**2))

    def shoulder(self, c_2: Expr, s_2: Expr) -> Expr:
        """atan2(y, x) - atan2(a_2 s_2, a_1 + a_2 c_2)."""
        inner = atan2(multiply(self.a_2, s_2), self.a_1 + multiply(self.a_2, c_2))
        return atan2(self.y, self.x) - inner

    def values(self, sign: int) -> dict[str, Expr]:
        """Both angles in the given coordinates alone."""
        u = self.problem.final(self.cosine())
        along = self.a_1 + multiply(self.a_2, self.cosine())  # a_1 + a_2 c_2
        along = self.problem.readable(normal(along, self.problem.names))
        across = signed(sign, multiply(self.problem.final(self.a_2), self.sine(1, u)))
        return {
            self.arm.theta_1: atan2(self.y, self.x) - atan2(across, along),
            self.arm.theta_2: atan2(self.sine(sign, u), u),
        }

    def triangle(self, conditions: Sequence[tuple[Condition, ...]]) -> Triangle:
        """For the words."""
        return Triangle(
            r=sqrt(self.square),
            elbow=PI - self.theta_2,
            mirrored=Relation(cos(PI - self.theta_2), "=", -cos(self.theta_2)),
            theta_1=self.theta_1,
            elbows=tuple(
                ElbowTold(when=when, step=elbow.replace("-", "_"))
                for elbow, when in zip(ELBOWS, conditions, strict=True)
            ),
            folded=self._folded(),
        )

    def _folded(self) -> Phrase | None:
        """That the end-effector may come to lie on the first axis, where the lengths are or can be equal."""
        one, other = self.lengths
        about: dict[str, Said] = {"theta_1": self.theta_1}
        if self.a_1 == self.a_2:
            return Phrase("folded", about)
        can_be = Work(self.problem).sign(one - other) is None
        return Phrase("folded-if-equal", {**about, "equal": Relation(one, "=", other)}) if can_be else None

    def elbows(self, told: Triangle) -> Drawing:
        """Both solutions in one picture, with the triangle."""
        robot, where = self.problem.subject, self.problem.where
        point = completed(values_of(robot, where)[0], where)
        lengths = tuple(abs(scalar_number(length, point)) for length in (self.arm.a_1, self.arm.a_2))
        names = (self.arm.theta_1, self.arm.theta_2), (self.x.name, self.y.name)
        unit = unit_of_lengths(self.problem)
        first, second = (
            replace(length, unit=unit) if isinstance(length, Number) else length for length in self.lengths
        )
        return drawn(TwoLinks((lengths[0], lengths[1]), (first, second), *names, told.r, told.elbow))


def _tried(branches: Sequence[Branch], target: Target, points: Sequence[Values]) -> Tried:
    """Both branches at poses that the arm reaches."""
    functions = [{name: compiled(tree) for name, tree in each.values.items()} for each in branches]
    met = [
        [{**point, **{name: value(point) for name, value in each.items()}} for each in functions]
        for point in points
    ]
    return Tried(target, points, [each.when for each in branches], met, dict)


@dataclass(frozen=True, slots=True)
class Seen:
    """The arm as it stands in numbers, against the lines and the words of the triangle."""

    tried: Tried
    steps: Sequence[Step]
    lengths: tuple[Expr, Expr]
    told: Triangle

    def claims(self) -> Iterator[Claim]:
        """Of every line, and of the triangle and its elbow."""
        solved = [*self.tried.solved]
        yield route("lines", (each for k, _, known in solved for each in self._lines(k, known)))
        yield route("elbow-seen", (each for k, _, known in solved for each in self._elbow(k, known)))

    def _lines(self, k: int, known: Values) -> Iterator[bool]:
        """Those of the other elbow left out."""
        other = [*ELBOWS][1 - k].replace("-", "_")
        for step in self.steps:
            if step.name != other:
                yield equal(step.chain, known, step.rule in ("branch", "difference"))

    def _elbow(self, k: int, known: Values) -> Iterator[bool]:
        """Whether the triangle is this one, and the elbow lies to the right of the line from the base to the
        end-effector where it is down, to its left where it is up."""
        import numpy as np

        told, joints = self.told, self.tried.target.joints
        base, elbow = (self._pivot(name, known) for name in joints)
        tip = self.tried.target.oracle.tool(known)[:2, 3]
        (x, y), (u, v) = tip - base, elbow - base
        yield (x * v - y * u > 0) == (self.tried.conditions[k][0] == Phrase("elbow-up"))
        yield close(arrays(told.r, known), math.hypot(x, y), SAME)
        sides = [float(np.linalg.norm(each)) for each in (elbow - base, tip - elbow)]
        yield close([arrays(each, known) for each in self.lengths], sides, SAME)
        yield close(
            math.cos(arrays(told.elbow, known)), (base - elbow) @ (tip - elbow) / math.prod(sides), SAME
        )
        assert not isinstance(told.mirrored.left, Relation)
        yield close(arrays(told.mirrored.left, known), arrays(told.mirrored.right, known), SAME)
        yield (told.folded is not None and told.folded.key == "folded") == close(sides[0], sides[1], SAME)
        if told.folded is not None:
            yield told.folded.about["theta_1"] == Symbol(joints[0])
            yield told.folded.key == "folded" or self._can_be_equal(told.folded.about["equal"], sides, known)

    def _can_be_equal(self, told: Said, sides: Sequence[float], known: Values) -> bool:
        """Whether what is told to be equal are the two links."""
        if not isinstance(told, Relation) or told.sign != "=" or isinstance(told.left, Relation):
            return False
        return close([arrays(told.left, known), arrays(told.right, known)], sides, SAME)

    def _pivot(self, name: str, at: Values) -> Any:
        """The point (2) about which a joint turns the end-effector."""
        import numpy as np

        tool = self.tried.target.oracle.tool
        D = tool({**at, name: at[name] + 1.0}) @ np.linalg.inv(tool(at))
        return np.linalg.solve(np.eye(2) - D[:2, :2], D[:2, 3])


def _in_numbers(
    branches: Sequence[Branch],
    conditions: Sequence[Sequence[Condition]],
    arm: TwoLink,
    target: Target,
    point: Values,
) -> Evaluated:
    """The branches at a point; folded back on its base, the arm may point anywhere."""
    functions = [{name: compiled(value) for name, value in each.values.items()} for each in branches]
    a_1, a_2 = (scalar_number(length, point) for length in (arm.a_1, arm.a_2))
    x, y = (point[name] for name in target.goal.names)
    folded = max(math.hypot(x, y), abs(a_1 - a_2)) < SMALL * (a_1 + a_2)

    def configurations(
        k: int, pins: Mapping[int, float], usual: float, exact: bool
    ) -> Iterator[Configuration]:
        if folded:
            theta_1 = pins.get(0, usual)
            yield Configuration({arm.theta_1: theta_1, arm.theta_2: math.pi}, {0: theta_1})
            return
        try:
            yield Configuration({name: value(point) for name, value in functions[k].items()}, {})
        except (ValueError, ZeroDivisionError):
            yield Configuration({}, {})

    return at_point(configurations, conditions, target, point)
