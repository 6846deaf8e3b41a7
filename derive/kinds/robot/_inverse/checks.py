"""Every branch put back through the forward kinematics in numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from derive.algebra.compiled import compiled
from derive.derivation import Claim
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

    solutions: Solutions
    reached: tuple[bool, ...]
    found: bool
    spare: bool

    @property
    def partial(self) -> bool:
        """Whether some branches are solutions at some poses only."""
        return self.spare and not all(self.reached)

    def claims(self, point: Mapping[str, float]) -> Iterator[Claim]:
        """What has to hold; of a branch nothing where it need not reach."""
        for branch, holds in zip(self.solutions.branches, self.reached, strict=True):
            name = f" '{branch.when}'" if branch.when else ""
            if holds or not self.spare:
                yield Claim(f"the branch{name} reaches its target", SECOND_ROUTE, holds)
        claim = "the joint values a pose came from are among the solutions"
        yield Claim(claim, SECOND_ROUTE, self.found)
        same = _as_printed(self.solutions, point)
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
    return Tried(solutions, tuple(reached), found, len(solutions.joints) < goal.size)


def reaches(
    oracle: Oracle,
    goal: Goal,
    point: Mapping[str, float],
    values: Mapping[str, float],
    tolerance: float = TOLERANCE,
) -> bool:
    """Whether the arm stands where it should, by the forward kinematics in NumPy."""
    given = goal.numbers(oracle.tool({**point, **values}))
    wanted = {name: point[name] for name in given}
    return close(_plain(goal, given), _plain(goal, wanted), tolerance)


def matches(values: Mapping[str, float], point: Mapping[str, float], solutions: Solutions) -> bool:
    """Whether these are the joint values of the point, angles up to whole turns."""
    for name in solutions.joints:
        gap = values[name] - point[name]
        if name not in solutions.slides:
            gap = math.remainder(gap, 2 * math.pi)
        if abs(gap) > SAME:
            return False
    return True


def _plain(goal: Goal, given: Mapping[str, float]) -> list[float]:
    """Numbers to compare; an angle by its cosine and sine."""
    found = [value for name, value in given.items() if name != goal.angle]
    return found + [f(given[goal.angle]) for f in (math.cos, math.sin)] if goal.angle else found


def _as_printed(solutions: Solutions, point: Mapping[str, float]) -> bool:
    branches = solutions.at(point)
    given = {name: value for name, value in point.items() if name not in solutions.joints}
    for branch, values in zip(solutions.branches, branches, strict=True):
        known = dict(given)
        if values is None:
            continue
        for name in solutions.order:
            known[name] = compiled(branch.values[name])(known)
            if abs(known[name] - values[name]) > SAME * max(1.0, abs(values[name])):
                return False
    return True
