"""The branches in numbers at the point an author gives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from derive.algebra.numeric import number
from derive.derivation import Branch
from derive.errors import NotDerivable
from derive.kinds.evaluation import Place
from derive.kinds.pose._numbers import completed
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._inverse_branches import Solutions
from derive.kinds.robot._inverse_checks import reaches
from derive.mechanics.inverse.goal import Goal

REACHED = 1e-6  # relative: a pose is typed with rounded numbers


def evaluated(solutions: Solutions, goal: Goal, problem: Problem, place: Place | None) -> dict[str, Any]:
    """`solutions` with floats; a branch that does not reach the pose is not real. Empty without a point.

    Raises NotDerivable where a name has no value.
    """
    if place is None:
        return {}
    point = point_of(place, problem)
    oracle = oracle_of(problem)
    try:
        found = [
            values if values and reaches(oracle, goal, point, values, REACHED) else None
            for values in solutions.at(point)
        ]
    except KeyError as error:
        raise unknown(error) from error
    return {"solutions": told(solutions.branches, found)}


def point_of(place: Place, problem: Problem) -> dict[str, float]:
    """Every name that has a value."""
    return dict(completed({name: number(value, {}) for name, value in place}, problem.where))


def told(branches: Sequence[Branch], found: Sequence[dict[str, float] | None]) -> list[dict[str, Any]]:
    """As the JSON says it: `real` is false where a branch does not reach."""
    return [
        {**values, "when": branch.when} if values else {"when": branch.when, "real": False}
        for branch, values in zip(branches, found, strict=True)
    ]


def unknown(error: KeyError) -> NotDerivable:
    name = error.args[0]
    return NotDerivable(f"no value is known for {name}; give it one under evaluate: or where:")
