"""The branches at the point an author gives: in numbers, or in the letters that are left."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import product
from typing import Any

from derive.algebra.numbers.floats import Point, number
from derive.derivation import Branch, Condition, Phrase
from derive.errors import NotDerivable
from derive.expression import PI, Approximate, Expr, Number, Symbol, free_symbols, rebuild, walk
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.at_pose import AtPose, InNumbers
from derive.kinds.robot._inverse.branches import Solutions, plain
from derive.kinds.robot._inverse.distinct import Configurations, Distinct, in_order, listed
from derive.kinds.robot._inverse.facts import AtPlace
from derive.kinds.robot._inverse.target import Target
from derive.kinds.values_at import point_of
from derive.mechanics.inverse.plan import Plan

REACHED = 1e-6  # in lengths of the arm
ROUNDED = 5e-3  # how far R^T R of a rotation typed with three digits may be from one
EXACT = 5e-9  # of what is given
SMALL = 1e-7  # of a coefficient, which rounding may leave
FEWEST_PLACES, MOST_PLACES = 3, 8  # of numbers that are taken as rounded
NOWHERE = AtPlace()
ROTATION = tuple(f"r{i}{j}" for i, j in product((1, 2, 3), repeat=2))


@dataclass(frozen=True, slots=True)
class Numbers:
    """A place as it was `typed`, and as the branches were evaluated there: with the nearest rotation. `size`
    is a length of the arm, `tolerance` how far off an end-effector may stand, in it."""

    typed: Point
    point: Point
    size: float
    tolerance: float

    @property
    def near(self) -> float:
        """Radians or metres: where two solutions meet, they are off by the root of what the pose is."""
        return 3 * math.sqrt(self.tolerance)


@dataclass(frozen=True, slots=True)
class Evaluated:
    """What the JSON says under `evaluated`, and what the words say of it; `numbers` where no
    letter is left, and then of each entry its `branches`, from 0, and how far they are `off` the place at
    most; its `parts`, where a polynomial is solved first."""

    values: Mapping[str, Any]
    place: AtPlace = NOWHERE
    numbers: Numbers | None = None
    branches: tuple[tuple[int, ...], ...] = ()
    off: float | None = None
    parts: tuple[Evaluated, ...] | None = None
    said: tuple[Phrase, ...] = ()  # of that polynomial

    @property
    def each(self) -> tuple[Evaluated, ...]:
        """For every root of a polynomial its own; itself where there is none."""
        return (self,) if self.parts is None else self.parts

    @property
    def remark(self) -> Phrase | None:
        """How well the solutions reach the place."""
        if self.off is None:
            return None
        if self.off < EXACT:
            return Phrase("put-back-exactly")
        return Phrase("put-back", {"off": Approximate(float(f"{self.off:.1g}"))})


def in_degrees(problem: Problem, place: Place | None) -> bool:
    """Whether neither the arm nor the place has angles in radians."""
    typed = [*problem.subject.motions(), *(value for _, value in place or ())]
    return not any(node == PI for tree in typed for node in walk(tree))


def evaluated(
    branches: Sequence[Branch],
    place: Place | None,
    problem: Problem,
    in_numbers: Callable[[dict[str, float]], Evaluated],
    found: frozenset[str] = frozenset(),
) -> Evaluated:
    """The branches at a place by the values of all names, or in the letters that have none; those that are
    `found` in numbers are none. Empty without a place."""
    if place is None:
        return Evaluated({})
    point = dict(point_of(dict(place), problem.where))
    formulas = [branch.short or branch.values for branch in branches]
    rest_on = frozenset[str]().union(*(free_symbols(tree) for each in formulas for tree in each.values()))
    if rest_on - found - point.keys() - formulas[0].keys():
        return Evaluated({"solutions": [_in_letters(each, dict(place), problem) for each in branches]})
    return in_numbers(point)


def by_plan(
    solutions: Solutions, plan: Plan, target: Target, place: Place, point: dict[str, float]
) -> Evaluated:
    """By the formulas of the sub-problems, and by other equations where these fail. Raises NotDerivable where
    what is typed as a rotation is none."""
    asked = point
    point, rounding = with_rotation(asked)
    size = target.size(point)
    typed = _last_digit({name: value for name, value in place if name in target.goal.names}) / size
    in_numbers = tuple(InNumbers(planned, size) for planned in plan.steps)
    at = AtPose(solutions, in_numbers, point, max(SMALL, 4 * rounding))
    found = Evaluated({})
    for here, off in ((at, rounding), (replace(at, meeting=8 * typed), max(rounding, typed))):
        found = at_point(here.configurations, solutions.conditions, target, point, off)
        if not found.place.out_of_reach or not typed:  # stretched, it may be out of reach by what was rounded
            break
    if found.numbers is None:
        return found
    numbers = replace(found.numbers, typed=asked)
    return replace(found, numbers=numbers, off=_off(target, asked, found.values["solutions"]))


def _off(target: Target, point: Point, entries: Sequence[Mapping[str, Any]]) -> float | None:
    """The most that a solution is off the place; None where there is none."""
    real = [{name: each[name] for name in target.joints} for each in entries if each.get("real", True)]
    there = target.completed(point)
    return max((target.deviation(there, values) for values in real), default=None)


def at_point(
    configurations: Configurations, conditions: Sequence[Sequence[Condition]], target: Target, point: Point,
    rounding: float = 0.0,
) -> Evaluated:  # fmt: skip
    """The solutions at a point, from the configurations of each branch; `rounding` is how far what is typed
    may be off, in lengths of the arm and in elements of R."""
    tolerance, size = REACHED + 10 * rounding, target.size(point)
    distinct = Distinct(target, configurations, target.completed(point), size, tolerance)
    found = distinct.solutions(len(conditions))
    real = [any(each.values for each in configurations(k, {}, 0.0, False)) for k in range(len(conditions))]
    entries = listed(found, conditions, real, target.spare)
    had = {k for each in found for k in each.branches}
    unreal = len(conditions) - len(had) if found and not target.spare else 0
    return Evaluated(
        {"solutions": entries},
        AtPlace(
            out_of_reach=not any(real),
            missed=any(real) and not found,
            free=any(each.self_motion for each in found),
            rounded=rounding > REACHED,
            unreal=unreal,
            of=len(conditions),
        ),
        Numbers(point, point, size, tolerance),
        tuple(each.branches for each in in_order(found, len(conditions))),
        _off(target, point, entries),
    )


def _last_digit(place: Mapping[str, Expr]) -> float:
    """Half a unit of the last decimal place of what is typed, where it has some digits and not all that a
    program prints; else 0."""
    places = [
        next((k for k in range(MOST_PLACES + 1) if (value.value * 10**k).denominator == 1), 0)
        for value in place.values()
        if isinstance(value, Number)
    ]
    most = max(places, default=0)
    return 0.5 * 10.0**-most if most >= FEWEST_PLACES else 0.0


def with_rotation(point: dict[str, float]) -> tuple[dict[str, float], float]:
    """The point with the rotation that is nearest to the one typed, and how far that is from one."""
    import numpy as np

    if not point.keys() >= set(ROTATION):
        return point, 0.0
    R = np.array([point[name] for name in ROTATION]).reshape(3, 3)
    off = float(np.abs(R @ R.T - np.eye(3)).max())
    if off > ROUNDED or np.linalg.det(R) < 0:
        why = "it is left-handed" if off <= ROUNDED else f"R R^T differs from one by {off:.2g}"
        raise NotDerivable(f"r11 ... r33 are no rotation matrix at the place asked for: {why}", "evaluate")
    U, _, V = np.linalg.svd(R)
    nearest = dict(zip(ROTATION, map(float, (U @ V).flat), strict=True))
    return ({**point, **nearest}, off) if off > 1e-12 else (point, 0.0)


def _in_letters(branch: Branch, place: Mapping[str, Expr], problem: Problem) -> dict[str, Any]:
    """What has all its values as numbers, the rest as trees in the letters left."""
    known: dict[Expr, Expr] = {Symbol(name): value for name, value in place.items()}
    found: dict[str, Any] = {}
    for name, formula in (branch.short or branch.values).items():
        value = _put(formula, known, problem)
        if free_symbols(value):
            found[name] = value
            continue
        try:
            found[name] = number(value, {})
        except (ValueError, ZeroDivisionError):
            return {"when": branch.when, "real": False}
        known[Symbol(name)] = Number(Fraction(f"{found[name]:.12g}"), decimal=True)
    return {**found, "when": branch.when}


def _put(tree: Expr, known: Mapping[Expr, Expr], problem: Problem) -> Expr:
    """With the values put in; inside functions nothing is expanded that they do not hold."""
    if plain(tree):
        return problem.final(tree, known)
    return rebuild(tree, lambda part: _put(part, known, problem))
