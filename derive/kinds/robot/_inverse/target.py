"""Whether joint values bring the end-effector where it should be, by the forward kinematics in NumPy."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

from derive.kinds.checks import TOLERANCE, close
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import AXES, Goal
from derive.mechanics.oracle import Oracle

SAME = 1e-6  # radians or metres: two joint values this close are one
Values = dict[str, float]


@dataclass(frozen=True, slots=True)
class Target:
    """An arm in numbers, and what is known of its end-effector. A point holds a value for every name."""

    oracle: Oracle
    goal: Goal
    joints: tuple[str, ...]
    slides: frozenset[str]
    names: frozenset[str]

    @staticmethod
    def of(problem: Problem, chain: Chain, goal: Goal) -> Target:
        """What is known of the end-effector of a chain."""
        slides = frozenset(joint.variable for _, joint in chain.moving if joint.type == "prismatic")
        return Target(oracle_of(problem), goal, chain.variables, slides, frozenset(problem.symbols))

    @property
    def spare(self) -> bool:
        """Whether what is given has more coordinates than the arm joints."""
        return len(self.joints) < self.goal.size

    def completed(self, point: Mapping[str, float]) -> Values:
        """The point, with a value for what nothing rests on."""
        return {**dict.fromkeys(self.names, 1.0), **point}

    def size(self, point: Mapping[str, float]) -> float:
        """A length of the arm: what its links and the place it should reach measure together."""
        home = {**dict.fromkeys(self.oracle.robot.variables, 0.0), **self.completed(point)}
        places = [T[:3, 3].tolist() for T in (*self.oracle.poses(home), self.oracle.tool(home))]
        links = sum(math.dist(a, b) for a, b in pairwise(places))
        return links + sum(abs(point.get(axis, 0.0)) for axis in AXES) or 1.0

    def reached(self, point: Mapping[str, float], values: Mapping[str, float]) -> bool:
        """Whether the arm stands where the point says."""
        return close(self.there({**point, **values}), self._plain(point), TOLERANCE)

    def misses(self, point: Mapping[str, float], values: Mapping[str, float], size: float) -> float:
        """How far off the end-effector stands, in lengths of `size` and in elements of R."""
        scale = [size if place[1] == 3 else 1.0 for place in self.goal.places.values()] + [1.0, 1.0]
        pairs = zip(self.there({**point, **values}), self._plain(point), scale, strict=False)
        return max(abs(one - other) / unit for one, other, unit in pairs)

    def deviation(self, point: Mapping[str, float], values: Mapping[str, float]) -> float:
        """The most that a number which is given differs from what the joint values make of it."""
        return max(
            abs(one - other)
            for one, other in zip(self.there({**point, **values}), self._plain(point), strict=True)
        )

    def gaps(self, one: Mapping[str, float], other: Mapping[str, float]) -> Values:
        """The difference of each joint value, of angles up to whole turns."""
        return {name: gap(one[name], other[name], name in self.slides) for name in self.joints}

    def same(self, one: Mapping[str, float], other: Mapping[str, float]) -> bool:
        """Whether these are the same joint values, angles up to whole turns."""
        return all(abs(each) <= SAME for each in self.gaps(one, other).values())

    def there(self, at: Mapping[str, float]) -> list[float]:
        """What is given of the end-effector, where the arm stands at a point."""
        return self._plain(self.goal.numbers(self.oracle.tool(at)))

    def _plain(self, given: Mapping[str, float]) -> list[float]:
        """Numbers to compare; an angle by its cosine and sine."""
        found = [given[name] for name in self.goal.places]
        angle = self.goal.angle
        return [*found, *(f(given[angle]) for f in (math.cos, math.sin))] if angle else found


def gap(one: float, other: float, slide: bool = False) -> float:
    """The difference of two joint values, of angles up to whole turns."""
    return one - other if slide else math.remainder(one - other, 2 * math.pi)
