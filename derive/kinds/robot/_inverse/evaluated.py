"""The branches in numbers at the point an author gives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from derive.kinds.evaluation import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.checks import reaches
from derive.kinds.robot._inverse.freedom import Singularity
from derive.kinds.robot._inverse.told import point_of, told, unknown
from derive.mechanics.inverse.goal import Goal

REACHED = 1e-6  # relative


@dataclass(frozen=True, slots=True)
class Evaluated:
    """What the JSON says under `evaluated`, and about it: `out_of_reach` where no branch is real, `missed`
    where some are but do not bring the end-effector there, `free` where an angle was chosen at will."""

    values: Mapping[str, Any]
    out_of_reach: bool = False
    missed: bool = False
    free: bool = False

    @property
    def facts(self) -> dict[str, bool]:
        return {"out_of_reach": self.out_of_reach, "missed": self.missed, "free": self.free}


def evaluated(
    solutions: Solutions, singularity: Singularity, goal: Goal, problem: Problem, place: Place | None
) -> Evaluated:
    """`solutions` with floats; a branch that does not reach the pose is not real. Empty without a point.
    In a singular configuration an angle that can be chosen at will is zero.

    Raises NotDerivable where a name has no value.
    """
    if place is None:
        return Evaluated({})
    point = point_of(place, problem)
    oracle, tolerance = oracle_of(problem), REACHED + 10 * _rounding(goal, point)
    wanted = {**dict.fromkeys(problem.symbols, 1.0), **point}  # what no value rests on may be anything
    try:
        pairs = zip(solutions.at(point), solutions.chosen, strict=True)
        tries = [list(singularity.tries(values, taken, point)) for values, taken in pairs]
    except KeyError as error:
        raise unknown(error) from error
    arrived = [[reaches(oracle, goal, wanted, v, tolerance) for v in each] for each in tries]
    found = [
        each[there.index(True)] if any(there) else None for each, there in zip(tries, arrived, strict=True)
    ]
    free = any(any(there) and not there[0] for there in arrived)
    missed = any(tries) and not any(found)
    return Evaluated({"solutions": told(solutions.branches, found)}, not any(tries), missed, free)


def _rounding(goal: Goal, point: Mapping[str, float]) -> float:
    """How far the typed entries of a rotation are from one: they may be rounded to a few digits."""
    names = [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
    if not set(names) <= set(goal.names) & point.keys():
        return 0.0
    R = [[point[f"r{i}{j}"] for j in (1, 2, 3)] for i in (1, 2, 3)]
    products = [(sum(row[i] * row[j] for row in R), i == j) for i in range(3) for j in range(3)]
    return max(abs(value - same) for value, same in products)
