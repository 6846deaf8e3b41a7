"""The inverse of the planar arm of two revolute joints, by the triangle its links form with the target."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from derive.algebra.normal import normal
from derive.algebra.numbers import floats as numeric
from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.scalar import Scalar
from derive.derivation import Branch, Claim, Derivation, Step
from derive.expression import (
    ONE,
    PI,
    Expr,
    Quotient,
    Sum,
    Symbol,
    add,
    atan2,
    cos,
    free_symbols,
    multiply,
    negate,
    number,
    sin,
    sqrt,
    squared,
    subtract,
)
from derive.kinds.checks import SECOND_ROUTE, close, links, random_points
from derive.kinds.evaluation import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._inverse.evaluated import SMALL, Evaluated, at_point, in_letters, known_at
from derive.kinds.robot._inverse.numbers import Leaf
from derive.kinds.robot._inverse.trees import times
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal, of_coordinates
from derive.mechanics.two_link import TwoLink

ELBOWS = (("down", number(1), ">"), ("up", number(-1), "<"))
POINTS = 5


def derive(
    arm: TwoLink, chain: Chain, given: tuple[str, ...], place: Place | None, problem: Problem
) -> Derivation:
    """By the triangle of the two links and the law of cosines (Spong et al., section 1.4.2; Craig, 4.4)."""
    x, y = map(Symbol, given)
    goal = of_coordinates(chain.T_tool, given, chain.variables)
    writing = _Writing(problem, arm, x, y)
    steps = writing.steps()
    branches = tuple(writing.branch(name, sign, relation) for name, sign, relation in ELBOWS)
    known = {**problem.names, **writing.position()}
    claims = (
        *links([step for step in steps if step.rule in ("position", "law-of-cosines")], known),
        *(_closes(problem, branch, given) for branch in branches),
    )
    values = _evaluated(branches, arm, chain, goal, problem, place)
    return Derivation(
        "inverse-kinematics",
        steps,
        {"solutions": branches},
        claims,
        evaluated=values.values,
        uses=(problem.ask("forward-kinematics"),),
        facts={**writing.facts(), **values.facts, **problem.angular(chain.variables)},
    )


class _Writing:
    """The formulas of one arm in its own names."""

    def __init__(self, problem: Problem, arm: TwoLink, x: Symbol, y: Symbol) -> None:
        self.problem, self.arm, self.x, self.y = problem, arm, x, y
        self.theta_1, self.theta_2 = Symbol(arm.theta_1), Symbol(arm.theta_2)
        self.a_1, self.a_2 = problem.readable(arm.a_1), problem.readable(arm.a_2)
        self.square = add(squared(x), squared(y))

    def position(self) -> dict[Expr, Expr]:
        """x and y by forward kinematics."""
        elbow = Sum((self.theta_1, self.theta_2))
        parts = zip((self.x, self.y), (cos, sin), strict=True)
        return {
            name: add(multiply(self.a_1, f(self.theta_1)), multiply(self.a_2, f(elbow))) for name, f in parts
        }

    def steps(self) -> tuple[Step, ...]:
        """The position, the triangle, c_2, and for each elbow theta_2; then theta_1."""
        position = [
            Step(str(name.name), (name, value), "position")
            for name, value in self.position().items()
            if isinstance(name, Symbol)
        ]
        cosine, length = cos(self.theta_2), multiply(number(2), self.a_1, self.a_2)
        sides = add(squared(self.a_1), squared(self.a_2), negate(squared(self.x)), negate(squared(self.y)))
        inside = cos(subtract(PI, self.theta_2))
        triangle = Step("triangle", (inside, Quotient(sides, length)), "law-of-cosines")
        solved = Step("c_2", (cosine, self.cosine()), "law-of-cosines")
        elbows = [
            Step(
                f"elbow_{name}",
                (self.theta_2, atan2(self.sine(sign, cosine), cosine)),
                "branch",
                {"sign": relation},
            )
            for name, sign, relation in ELBOWS
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
        return Quotient(self.problem.readable(top), self.problem.readable(bottom))

    @staticmethod
    def sine(sign: Expr, cosine: Expr) -> Expr:
        return times(sign, sqrt(subtract(ONE, squared(cosine))))

    def shoulder(self, c_2: Expr, s_2: Expr) -> Expr:
        """atan2(y, x) - atan2(a_2 s_2, a_1 + a_2 c_2)."""
        inner = atan2(multiply(self.a_2, s_2), add(self.a_1, multiply(self.a_2, c_2)))
        return subtract(atan2(self.y, self.x), inner)

    def branch(self, elbow: str, sign: Expr, relation: str) -> Branch:
        """Both angles in the given coordinates alone."""
        u = self.problem.final(self.cosine())
        s = self.sine(sign, u)
        along = add(self.a_1, multiply(self.a_2, self.cosine()))  # a_1 + a_2 c_2
        along = self.problem.readable(normal(along, self.problem.names))
        inner = atan2(times(sign, multiply(self.problem.final(self.a_2), self.sine(ONE, u))), along)
        values = {
            self.arm.theta_1: subtract(atan2(self.y, self.x), inner),
            self.arm.theta_2: atan2(s, u),
        }
        return Branch(values, f"elbow {elbow}, {self.arm.theta_2} {relation} 0")

    def facts(self) -> dict[str, object]:
        return {
            "triangle": True, "x": self.x, "y": self.y, "theta_1": self.theta_1, "theta_2": self.theta_2,
            "a_1": self.a_1, "a_2": self.a_2, "r": sqrt(self.square),
            "same": self.a_1 == self.a_2, "elbow": subtract(PI, self.theta_2),
        }  # fmt: skip


def _closes(problem: Problem, branch: Branch, given: tuple[str, ...]) -> Claim:
    """The branch at reachable points, put back through the poses in numbers."""
    oracle, names = oracle_of(problem), problem.subject.variables
    holds = True
    for point in random_points(sorted(problem.symbols), POINTS):
        at = oracle.at(point)
        target = dict(zip(given, oracle.tool(at)[:2, 3], strict=True))
        found = {name: numeric.number(branch.values[name], {**at, **target}) for name in names}
        reached = oracle.tool({**at, **found})[:2, 3]
        holds &= close(list(target.values()), reached)
    return Claim(f"the branch '{branch.when}' reaches its target", SECOND_ROUTE, holds)


def _evaluated(
    branches: tuple[Branch, ...],
    arm: TwoLink,
    chain: Chain,
    goal: Goal,
    problem: Problem,
    place: Place | None,
) -> Evaluated:
    """The branches in numbers, or in the letters that are left."""
    if place is None:
        return Evaluated({})
    point = known_at(place, problem)
    needed = frozenset().union(*(free_symbols(tree) for each in branches for tree in each.values.values()))
    if needed - point.keys():
        return Evaluated(in_letters(branches, place, problem))
    functions = [{name: compiled(value) for name, value in each.values.items()} for each in branches]
    a_1, a_2 = (scalar_number(length, point) for length in (arm.a_1, arm.a_2))
    x, y = (point[name] for name in goal.names)
    folded = max(math.hypot(x, y), abs(a_1 - a_2)) < SMALL * (a_1 + a_2)

    def leaves(k: int, pins: Mapping[int, float], usual: float, exact: bool) -> Iterator[Leaf]:
        """Folded back on its base, the arm may point anywhere."""
        if folded:
            theta_1 = pins.get(0, usual)
            yield Leaf({arm.theta_1: theta_1, arm.theta_2: math.pi}, {0: theta_1})
            return
        try:
            yield Leaf({name: value(point) for name, value in functions[k].items()}, {})
        except (ValueError, ZeroDivisionError):
            yield Leaf({}, {})

    conditions = [str(each.when).split(", ") for each in branches]
    return at_point(leaves, conditions, chain, goal, problem, point)
