"""Six revolute joints that no formula inverts: all solutions at one pose, in numbers.

The elimination of Raghavan and Roth leaves a polynomial of the sixteenth degree in the tangent of half an
angle; its real roots are isolated, and the other angles follow from each.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point
from derive.derivation import Branch, Derivation, Phrase, Result, Step
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Approximate,
    Call,
    Expr,
    Matrix,
    Number,
    Product,
    Relation,
    Symbol,
    add,
    cross,
    multiply,
    transpose,
)
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import TOOL
from derive.kinds.robot._inverse.elimination_checks import Checks
from derive.kinds.robot._inverse.evaluated import Evaluated, Numbers, in_degrees, with_rotation
from derive.kinds.robot._inverse.facts import AtPlace, Eliminated, Facts
from derive.kinds.robot._inverse.ranges import Ranges
from derive.kinds.robot._inverse.target import Target
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.closed_loop import closed
from derive.mechanics.inverse.every_solution import EverySolution, Undecided
from derive.mechanics.inverse.nearby import BESIDE, beside, followed
from derive.mechanics.inverse.raghavan_roth import eliminations
from derive.mechanics.inverse.six_axes import SixAxes
from derive.names import free

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

JOINTS = 6
REACHED = 1e-6
LARGEST = 1e7  # of a tangent
SINGULAR = (
    "no formula was found, and at this pose the solutions cannot all be told apart in numbers: the arm is "
    "singular in one of them, or nearly so; numerical-inverse-kinematics finds one of them"
)
NO_FORMULA = (
    "no closed form found: no three neighboring axes of the arm are parallel or meet in one point, and its "
    "equations are too long to be searched further"
)


def fits(chain: Chain, target: Target) -> bool:
    """Whether it is six joints that turn, each its own row, and a whole pose is given."""
    turning = all(joint.type == "revolute" for _, joint in chain.moving)
    whole = target.goal.whole_position and target.goal.R is not None and target.goal.angle is None
    return turning and whole and len(chain.variables) == JOINTS and chain.coupling is None


def derive(chain: Chain, target: Target, place: Place, problem: Problem) -> Derivation:
    """All solutions there (Raghavan and Roth 1993). Raises NotDerivable where a name has no value, and where
    the arm is singular at the pose."""
    point = dict(point_of(dict(place), problem.where))
    of_arm = frozenset[str]().union(*(entry.letters() for entry in chain.T_tool.entries))
    if missing := sorted((of_arm | set(target.goal.names)) - point.keys() - set(chain.variables)):
        raise NotDerivable(
            "no formula was found, and for numbers every name needs a value under evaluate; "
            f"{', '.join(missing)} {'has' if len(missing) == 1 else 'have'} none",
            "evaluate",
        )
    found = _Solved(problem, chain, target, point)
    values, solutions = found.evaluated, found.solutions
    ranges = Ranges.of(problem, place)
    values = ranges.judged(values)
    roots = tuple(math.tan(each[found.unknown] / 2) for each in found.every.solutions)
    checks = Checks(problem, chain, target, found.told, found.branches, values, roots)
    work = Work(problem).showing(*found.told.steps)
    work = work.claim(*checks.claims()).claim(*ranges.claims(values))
    results: dict[str, Result] = {"solutions": found.branches}
    if not found.is_beside:
        results["polynomial"] = found.told.polynomial.result
    facts = Facts(
        eliminated=found.told,
        at_pose=(found.end, _pose_by_names(target)),
        feasible=ranges.said,
        turn_limits=ranges.of_angles,
        place=values.place.said,
        labels=tuple(str(k) for k, _ in enumerate(solutions, 1)),
        numbers=("solutions",) if solutions else (),
        remark=values.remark,
        angle_results=chain.variables,
        style=problem.style,
        in_degrees=in_degrees(problem, place),
    )
    return work.answer("inverse-kinematics", results, facts, evaluated=values.values)


@dataclass(frozen=True)
class _Solved:
    """An arm at the pose of a point."""

    problem: Problem
    chain: Chain
    target: Target
    asked: Point

    @cached_property
    def point(self) -> dict[str, float]:
        """With the nearest rotation to the one typed."""
        return with_rotation(dict(self.asked))[0]

    @cached_property
    def size(self) -> float:
        """A length of the arm."""
        return self.target.size(self.point)

    @cached_property
    def arm(self) -> SixAxes:
        """In numbers."""
        return SixAxes.of(self.chain, self.point, self.size)

    @cached_property
    def pose(self) -> Array:
        """4 by 4."""
        import numpy as np

        pose = np.eye(4)
        for name, (i, j) in self.target.goal.places.items():
            pose[i, j] = self.point[name]
        return pose

    def solved(self, pose: Array) -> EverySolution | None:
        """By the first elimination that decides, of full degree if there is one."""
        arm = self.arm
        loop = closed(arm.joints, arm.frames, arm.end, pose, self.size)
        others = []
        for elimination in eliminations(loop):
            every = EverySolution(elimination, arm.joints, partial(arm.sides, pose))
            if elimination.is_whole and every.decides:
                return every
            others.append(every)
        return next((each for each in others if each.decides), None)

    @cached_property
    def every(self) -> EverySolution:
        """At the pose, or beside it where that lies specially."""
        found = self.at_the_pose or self.solved(beside(self.pose, 1, self.size))
        if found is None:
            raise NotDerivable(SINGULAR)
        return found

    @cached_property
    def at_the_pose(self) -> EverySolution | None:
        """None where every elimination vanishes there, or leaves something open."""
        return self.solved(self.pose)

    @property
    def is_beside(self) -> bool:
        """Whether what is eliminated is not the pose itself."""
        return self.at_the_pose is None

    @cached_property
    def solutions(self) -> tuple[dict[str, float], ...]:
        """The joint angles of each. Raises NotDerivable where the arm is singular in one."""
        if not self.is_beside:
            return self.every.solutions
        try:
            return followed(self.arm, self.pose, self._solutions_at)
        except Undecided as error:
            raise NotDerivable(SINGULAR) from error

    def _solutions_at(self, pose: Array) -> tuple[dict[str, float], ...]:
        found = self.solved(pose)
        if found is None:
            raise Undecided
        return found.solutions

    @property
    def unknown(self) -> str:
        """The joint that the polynomial is in."""
        return self.every.elimination.unknown

    @cached_property
    def root(self) -> Symbol:
        """What the tangent of half the angle is called."""
        return Symbol(free(self.problem.taken | set(self.target.goal.names), "u"))

    @cached_property
    def line(self) -> tuple[Symbol, Symbol]:
        """What the direction of an axis and the position of a point on it are called."""
        taken = self.problem.taken | set(self.target.goal.names) | {self.root.name}
        return Symbol(free(taken, "l", "k", "e")), Symbol(free(taken, "p", "w"))

    @property
    def branches(self) -> tuple[Branch, ...]:
        """The numbers as results."""
        return tuple(
            Branch({name: Approximate(each[name]) for name in self.chain.variables}, ())
            for each in self.solutions
        )

    @cached_property
    def evaluated(self) -> Evaluated:
        """The same under `evaluated`, with the root of each."""
        root, roots = self.root.name, [math.tan(each[self.unknown] / 2) for each in self.solutions]
        finite = not self.is_beside and all(abs(x) < LARGEST for x in roots)  # half a turn has no number
        entries = [
            {**({root: x} if finite else {}), **{n: each[n] for n in self.chain.variables}, "when": ()}
            for x, each in zip(roots, self.solutions, strict=True)
        ]
        rounding = max(
            (abs(self.point[name] - self.asked[name]) for name in self.target.goal.names), default=0.0
        )
        there = self.target.completed(self.asked)
        off = max((self.target.deviation(there, each) for each in self.solutions), default=None)
        return Evaluated(
            {"solutions": entries},
            AtPlace(out_of_reach=not entries, rounded=rounding > REACHED),
            Numbers(self.asked, self.point, self.size, REACHED + 10 * rounding),
            tuple((k,) for k, _ in enumerate(entries)),
            off,
        )

    @cached_property
    def told(self) -> Eliminated:
        """For the words."""
        joints = self.every.elimination.loop.joints
        pair, triple, last = joints[:2], joints[2:5], joints[5]
        u, polynomial = self.root, self.every.elimination.polynomial
        monic = [
            float(int(each.p) / int(each.q))
            for each in (polynomial / polynomial[polynomial.degree()]).coeffs()
        ]
        powers: dict[int, Expr] = {0: ONE, 1: u}
        terms = [
            multiply(Approximate(each), powers.get(n, u**n)) if n < polynomial.degree() else u**n
            for n, each in reversed([*enumerate(monic)])
            if each
        ]
        half = Step("half", (u, Call("tan", (Symbol(triple[0]) / 2,))), "in-numbers")
        count = len(self.every.roots)
        return Eliminated(
            why=Phrase("no-formula" if not self.arm.has_formulas else "no-formula-found"),
            cut=self._cut(triple),
            triple=tuple(map(Symbol, self._ordered(triple))),
            pair=tuple(map(Symbol, self._ordered(pair))),
            last=Symbol(last),
            others=tuple(map(Symbol, self._ordered((*pair, last)))),
            line=self.line,
            equal=_followed_by(*self.line),
            unknown=Symbol(triple[0]),
            root=u,
            half=half,
            polynomial=Step("polynomial", (ZERO, add(*terms)), "in-numbers"),
            degree=polynomial.degree(),
            roots=Phrase({0: "no-real-root", 1: "one-real-root"}.get(count, "real-roots"), {"count": count}),
            shared=Phrase("shared-roots") if len(self.solutions) > count else None,
            beside=Phrase("beside", {"angle": Number(Fraction(str(BESIDE)), decimal=True)})
            if self.is_beside
            else None,
        )

    @property
    def _last(self) -> str:
        return TOOL if self.problem.subject.ends_in_tool else str(len(self.chain.joints))

    @property
    def end(self) -> Symbol:
        """The pose of the end-effector."""
        return Symbol(f"T_{self._last}^0")

    def _ordered(self, joints: Sequence[str]) -> list[str]:
        return sorted(joints, key=self.chain.variables.index)

    def _cut(self, triple: Sequence[str]) -> Relation:
        """T_b^a of three joints in a row as the others make it."""
        rows = {joint.variable: i for i, joint in self.chain.moving}
        names = self.chain.variables
        places = sorted(names.index(each) for each in triple)
        if places[-1] - places[0] > 2:  # the three others stand in a row
            places = sorted(set(range(JOINTS)) - set(places))
        first, last = rows[names[places[0]]] - 1, rows[names[places[-1]]]
        end = self._last
        whole: list[Expr] = [self.end]
        if first:
            whole.insert(0, Call("inverse", (Symbol(f"T_{first}^0"),)))
        if str(last) != end:
            whole.append(Call("inverse", (Symbol(f"T_{end}^{last}"),)))
        return Relation(Symbol(f"T_{last}^{first}"), "=", Product(tuple(whole)))


def _followed_by(l: Symbol, p: Symbol) -> tuple[Expr, ...]:
    """What holds the two angles of a pair in the same products as a direction and a position do."""
    both = transpose(p)
    return both * p, both * l, cross(p, l), l * both * p - 2 * p * both * l


def _pose_by_names(target: Target) -> Matrix:
    """4 by 4: what is given of the end-effector."""
    names = {place: Symbol(name) for name, place in target.goal.places.items()}
    last: tuple[Expr, ...] = (ZERO, ZERO, ZERO, ONE)
    return Matrix((*(tuple(names[i, j] for j in range(4)) for i in range(3)), last))


def offered(chain: Chain, target: Target) -> str:
    """What is said where no place was asked for."""
    if not fits(chain, target):
        return ""
    return "; with a pose under evaluate all solutions there are found in numbers"
