"""Every branch put back through the forward kinematics in numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import Point
from derive.derivation import Claim
from derive.expression import Expr
from derive.kinds.checks import SECOND_ROUTE, TOLERANCE, close
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._inverse.branches import Solutions
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.oracle import Oracle

SAME = 1e-6  # radians or metres: two joint values this close are one


@dataclass(frozen=True, slots=True)
class Tried:
    """What came of putting branches back at poses the arm reaches: whether each always reached them, and
    whether the joint values they came from were always found. `spare` says that the arm has fewer joints than
    what is given has coordinates, so that a branch has to fulfil more equations than it is made from."""

    reached: tuple[bool, ...]
    found: bool
    spare: bool

    @property
    def partial(self) -> bool:
        """Whether some branches are solutions at some poses only."""
        return self.spare and not all(self.reached)

    def claims(self, solutions: Solutions, point: Mapping[str, float]) -> Iterator[Claim]:
        """What has to hold; of a branch nothing where it need not reach."""
        for branch, holds in zip(solutions.branches, self.reached, strict=True):
            name = f" '{branch.when}'" if branch.when else ""
            if holds or not self.spare:
                yield Claim(f"the branch{name} reaches its target", SECOND_ROUTE, holds)
        claim = "the joint values a pose came from are among the solutions"
        yield Claim(claim, SECOND_ROUTE, self.found)
        same = _as_printed(solutions, point)
        yield Claim("the solutions as printed have the values found step by step", SECOND_ROUTE, same)


def tried(solutions: Solutions, goal: Goal, problem: Problem, points: Sequence[Mapping[str, float]]) -> Tried:
    """Every branch at every point."""
    oracle = oracle_of(problem)
    reached = [True] * len(solutions.chosen)
    found = True
    for point in points:
        branches = solutions.at(point)
        there = [values is None or reaches(oracle, goal, point, values) for values in branches]
        reached = [before and now for before, now in zip(reached, there, strict=True)]
        found &= any(values is not None and matches(values, point, solutions) for values in branches)
    return Tried(tuple(reached), found, len(solutions.joints) < goal.size)


def reaches(oracle: Oracle, goal: Goal, point: Mapping[str, float], values: Mapping[str, float]) -> bool:
    """Whether the arm stands where it should, by the forward kinematics in NumPy."""
    given = goal.numbers(oracle.tool({**point, **values}))
    wanted = {name: point[name] for name in given}
    return close(plain(goal, given), plain(goal, wanted), TOLERANCE)


def matches(values: Mapping[str, float], point: Mapping[str, float], solutions: Solutions) -> bool:
    """Whether these are the joint values of the point, angles up to whole turns."""
    return all(
        abs(gap(values[name], point[name], name in solutions.slides)) <= SAME for name in solutions.joints
    )


def gap(one: float, other: float, slide: bool) -> float:
    """The difference of two joint values, of angles up to whole turns."""
    return one - other if slide else math.remainder(one - other, 2 * math.pi)


def plain(goal: Goal, given: Mapping[str, float]) -> list[float]:
    """Numbers to compare; an angle by its cosine and sine."""
    found = [value for name, value in given.items() if name != goal.angle]
    return found + [f(given[goal.angle]) for f in (math.cos, math.sin)] if goal.angle else found


def _as_printed(solutions: Solutions, point: Mapping[str, float]) -> bool:
    """Both with everything put in and in short formulas."""
    given = {name: value for name, value in point.items() if name not in solutions.joints}
    for branch, values in zip(solutions.branches, solutions.at(point), strict=True):
        if values is None:
            continue
        turn = [name for name in branch.short if name in values]
        for formulas, names in ((branch.values, turn or list(values)), (branch.short, list(branch.short))):
            found = in_turn(formulas, names, given)
            if names and any(abs(found[n] - v) > SAME * max(1.0, abs(v)) for n, v in values.items()):
                return False
    return True


def in_turn(formulas: Mapping[str, Expr], names: Sequence[str], given: Point) -> dict[str, float]:
    """The values of formulas, each put into those after it. Raises as `compiled` does."""
    known = dict(given)
    for name in names:
        known[name] = compiled(formulas[name])(known)
    return known
