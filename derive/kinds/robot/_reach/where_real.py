"""Workspaces of arms with two slides and no simpler shape: where the root of their inverse is real."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import number
from derive.derivation import Derivation, Phrase, Result
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Relation, Symbol
from derive.expression import replace as put_in
from derive.kinds.checks import random_points, route
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._inverse.facts import Facts as Inverted
from derive.kinds.robot._inverse.facts import SolvedFacts
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.facts import Facts, WhereReal
from derive.kinds.robot._reach.section_checks import SectionSeen
from derive.kinds.robot._reach.sections import (
    orientations_held,
    orientations_in_space,
    seen_in_numbers,
)
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.poses import position_part
from derive.mechanics.reach import moving_joints
from derive.names import free

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

AXES = ("x", "y", "z")
SETS, PLACES, MET_ONES, ANGLES = 3, 12, 4, 2001
PLAIN = 1e-3  # of the largest, below which a value is too near to zero to say whether a position is reached


@dataclass(frozen=True)
class WhereItIsReal:
    """A point of an arm, and the inverse of its position."""

    problem: Problem
    chain: Chain
    point: Tracked
    inverse: Derivation

    def derivation(self) -> Derivation:
        """What stands under the root, and that it is not negative."""
        work = Work(self.problem, uses=(self.inverse,))
        results: dict[str, Result] = {}
        reached: Expr | None = None
        if (under := self.under) is not None:
            delta = Symbol(free(self.problem.taken, "Delta", "delta"))
            work = work.knowing(self.names).line(delta, under, label="reached")
            results["reached"] = reached = work.final(delta)
            description = Phrase("where-not-negative", {"condition": Relation(delta, ">=", ZERO)})
        else:
            description = Phrase("whole-space-but", {"zeros": self.zeros})
        results["description"] = description
        facts = Facts(
            kinds=Phrase("kinds"),
            orientations=orientations_in_space(self.problem, self.chain, self.point, self.rows),
            description=description,
            limits=Phrase("slides-without-limits"),
            numbers=(),
            real=WhereReal(root=under is not None),
        )
        work = work.claim(route("reached-there", self._reached(reached)))
        work = work.claim(orientations_held(self.problem, self.chain, self.point, facts.orientations))
        return work.answer("workspace", results, facts)

    @property
    def rows(self) -> tuple[int, ...]:
        return tuple(i for i, _ in self.chain.moving)

    @cached_property
    def names(self) -> dict[Expr, Expr]:
        """What the names in the inverse stand for."""
        found: dict[Expr, Expr] = {}
        for step in self.inverse.steps:
            if step.rule == "name":
                found[step.chain[0]] = put_in(step.chain[-1], found)
        return found

    @property
    def solved(self) -> tuple[SolvedFacts, ...]:
        return self.inverse.told(Inverted).arm

    @property
    def under(self) -> Expr | None:
        """What stands under its root."""
        bounds = (each.method.bound for each in self.solved)
        return next((each.left for each in bounds if each and not isinstance(each.left, Relation)), None)

    @property
    def zeros(self) -> tuple[Relation, ...]:
        """Where nothing is known of it."""
        return next(each.method.unless for each in self.solved if each.method.name == "quadratic")

    def _reached(self, under: Expr | None) -> Iterator[bool]:
        """Whether positions are come to just where this is positive."""
        import numpy as np

        for k, drawn in enumerate(random_points(self.problem.symbols, SETS)):
            at = dict(oracle_of(self.problem).at(drawn))
            seen = seen_in_numbers(self.problem, self.chain, self.point, self.rows, at)
            draw = np.random.default_rng(k)
            places = self._places(seen, draw)
            values = [self._value(under, at, each) for each in places]
            largest = max(map(abs, values))
            for place, value in zip(places, values, strict=True):
                if abs(value) > PLAIN * largest:
                    yield _comes_to(seen, place) == (value > 0)

    def _places(self, seen: SectionSeen, draw: Any) -> Array:
        """Some that the arm comes to, and some near to these."""
        q = {row: draw.uniform(-2, 2, PLACES) for row in self.rows}
        met = seen.arm.moved(q)
        met[MET_ONES:] += draw.normal(0, 1, (PLACES - MET_ONES, 3))
        return met

    def _value(self, under: Expr | None, at: dict[str, float], place: Array) -> float:
        if under is None:
            return 1.0
        return float(number(under, {**at, **dict(zip(AXES, map(float, place), strict=True))}))


def _comes_to(seen: SectionSeen, place: Array) -> bool:
    """With the joint that turns at one angle, those that slide carry the point over a plane: whether a place
    changes its side as it turns."""
    import numpy as np

    rows, moved = seen.arm.shape.rows, seen.arm.moved
    turn = seen.arm.first
    angles = np.linspace(-np.pi, np.pi, ANGLES)
    still = {row: angles if row == turn else np.zeros(ANGLES) for row in rows}
    at = moved(still)
    u, v = (moved({**still, row: np.ones(ANGLES)}) - at for row in rows if row != turn)
    side = np.einsum("ij,ij->i", place - at, np.cross(u, v))
    return bool(side.min() < 0 < side.max())


def where_real(problem: Problem, chain: Chain, point: Tracked) -> Derivation | None:
    """None unless one joint turns and two slide without ends, and where the inverse is not known or rests on
    more."""
    rows = moving_joints(chain, point.position, point.last)
    slides = sum(chain.joint(i).type == "prismatic" for i in rows)
    ranged = any(problem.subject.links[i - 1].range for i in rows)
    tip = position_part(chain.T_tool).entries
    if (
        ranged
        or (len(rows), slides) != (3, 2)
        or [i for i, _ in chain.moving] != rows
        or point.position.entries != tip
    ):
        return None
    try:
        inverse = problem.ask("inverse-kinematics", given=AXES)
    except NotDerivable:
        return None
    told = inverse.told(Inverted)
    methods = [each.method for each in told.arm]
    bounds = [each for each in methods if each.bound is not None or each.exists is not None]
    open_ = [each for each in methods if each.name == "quadratic" and each.unless]
    plain = not (told.wrist or told.conditions) and not any(each.resting for each in told.arm)
    if not (methods and plain) or len(bounds) + len(open_) != 1 or any(each.bound is None for each in bounds):
        return None
    return WhereItIsReal(problem, chain, point, inverse).derivation()
