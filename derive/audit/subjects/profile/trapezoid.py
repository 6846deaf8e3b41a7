"""Trapezoidal profiles: the area under the velocity is the way, its slope the acceleration; the fastest, and
in a given time the gentlest, keeps the velocity as high as it may be."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import mpmath

from derive.audit.asked import EVALUATED, Asked, Holds, Same, Test
from derive.audit.conditions import holds
from derive.audit.points import NEAR, Point, floating
from derive.audit.putting_back import put_back
from derive.expression import Expr
from derive.mechanics.profile import Axis

NAMES = ("t_1", "t_2", "t_3", "v", "a")
CASES = re.compile(r"(\w+) if ([^;]+)")
PLACES = 8  # where the cases of symbols are told apart


@dataclass(frozen=True, slots=True)
class Trapezoid:
    """One axis in numbers; `case` says which it is."""

    case: str
    t_1: mpmath.mpf
    t_2: mpmath.mpf
    t_3: mpmath.mpf
    v: mpmath.mpf
    a: mpmath.mpf


def trapezoid(d: mpmath.mpf, v_max: mpmath.mpf, a_max: mpmath.mpf, time: mpmath.mpf | None) -> Trapezoid:
    """Over a distance d > 0: with the peak v the way takes d/v + t_1, and t_1 = v/a."""
    at_most = v_max * (1 + NEAR)
    if time is None:
        case = "trapezoidal" if d * a_max > v_max**2 * (1 + NEAR) else "triangular"
        v = min(v_max, mpmath.sqrt(d * a_max))
        t_1, a = v / a_max, a_max
        time = d / v + t_1
    else:
        case = "triangular" if 2 * d / time <= at_most else "trapezoidal"
        v = min(v_max, 2 * d / time)
        t_1 = time - d / v
        a = v / t_1 if t_1 > 0 else mpmath.inf
    if t_1 <= 0 or a > a_max * (1 + NEAR):
        case = "infeasible"
    return Trapezoid(case, t_1, time - t_1, time, v, a)


def trapezoidal_profile(asked: Asked, point: Point) -> Iterator[Test]:
    """One axis, several that arrive together, or one with symbols, where conditions tell the cases apart."""
    if len(asked.subject.axes) > 1:
        yield from _several(asked, point)
    elif "solutions" in asked.results:
        for place in range(PLACES):
            yield from _by_cases(asked, _positive(asked, point, place))
    else:
        yield from _one(asked, _positive(asked, point))
    if asked.evaluated:
        yield from _in_numbers(asked)


def _one(asked: Asked, point: Point) -> Iterator[Test]:
    (found,) = found_at(asked, point)
    yield Holds("case", asked.results["case"] == found.case, found.case)
    if found.case == "infeasible":
        axis = asked.subject.axes[0]
        yield Same("t_min", _axis(axis, None, asked, point).t_3)
        return
    for name in NAMES:
        yield put_back(name, point, asked.result(name), getattr(found, name), f"{name} is another")


def _several(asked: Asked, point: Point) -> Iterator[Test]:
    """In the time given, or that of the slowest."""
    found = found_at(asked, point)
    cases = [each.case for each in found]
    if "infeasible" in cases:
        alone = (_axis(axis, None, asked, point).t_3 for axis in asked.subject.axes)
        yield Same("t_min", max(alone))
        yield Holds("case", asked.results["case"] == cases, str(cases))
        return
    yield Holds("case", asked.results["case"] == cases, str(cases))
    for name in NAMES:
        each = found[0].t_3 if name == "t_3" else [getattr(one, name) for one in found]
        yield Same(name, each)


def _by_cases(asked: Asked, point: Point) -> Iterator[Test]:
    """Every branch covers the way; the one whose condition holds is the best, and told as such."""
    (found,) = found_at(asked, point)
    axis: Axis = asked.subject.axes[0]
    d = _size(axis.distance, asked, point)
    met = []
    for branch in asked.objects("solutions"):
        t_1, t_2, t_3, v, a = (point.at(asked.read(branch[name])) for name in NAMES)
        covers = [v * t_2, v, t_3 - t_1]
        yield put_back("solutions", point, covers, [d, a * t_1, t_2], "it does not cover the way")
        case, _, condition = branch["when"].partition(": ")
        if holds(condition, asked, point):
            met.append(case)
            values = [getattr(found, name) for name in NAMES]
            yield put_back("solutions", point, [t_1, t_2, t_3, v, a], values, f"not the best if {condition}")
    told = [
        case
        for case, condition in CASES.findall(str(asked.results["case"]))
        if holds(condition, asked, point)
    ]
    expected = [] if found.case == "infeasible" else [found.case]
    yield Holds("solutions", met == expected, f"{met or 'no case'} is met where it is {found.case}")
    yield Holds("case", told == expected, f"it is {found.case}")
    there = str(asked.evaluated.get("case", ""))  # what is told alone is the case there, else the first
    branches = asked.objects("solutions")
    first = next((each for each in branches if there and each["when"].startswith(there)), branches[0])
    for name in NAMES:
        yield put_back(name, point, asked.result(name), asked.read(first[name]), "none of the solutions")


def found_at(asked: Asked, point: Point) -> list[Trapezoid]:
    """Every axis in the time that is given, or that they share."""
    profile = asked.subject
    if profile.time is not None:
        time = floating(point.at(asked.formula(profile.time)))
    elif len(profile.axes) > 1:
        time = max(_axis(axis, None, asked, point).t_3 for axis in profile.axes)
    else:
        time = None
    return [_axis(axis, time, asked, point) for axis in profile.axes]


def _axis(axis: Axis, time: mpmath.mpf | None, asked: Asked, point: Point) -> Trapezoid:
    d, v_max = (_size(part, asked, point) for part in (axis.distance, axis.v_max))
    a_max = mpmath.inf if axis.a_max is None else _size(axis.a_max, asked, point)
    return trapezoid(d, v_max, a_max, time)


def _size(tree: Expr, asked: Asked, point: Point) -> mpmath.mpf:
    return abs(floating(point.at(asked.formula(tree))))


def _positive(asked: Asked, point: Point, place: int = 0) -> Point:
    """Near the point, with every size positive."""
    profile = asked.subject
    trees = [tree for axis in profile.axes for tree in (axis.distance, axis.v_max, axis.a_max)]
    formulas = [asked.formula(tree) for tree in (*trees, profile.time) if tree is not None]
    names = {symbol.name for formula in formulas for symbol in formula.free_symbols}
    assumptions = {**point.assumptions, **dict.fromkeys(names, "positive")}
    return Point(point.seed + 100 * place, point.exact, point.angles, assumptions, point.fixed)


def _in_numbers(asked: Asked) -> Iterator[Test]:
    """Where the author wants numbers."""
    found, told = found_at(asked, asked.here), asked.evaluated
    several = len(found) > 1
    cases: Any = [each.case for each in found] if several else found[0].case
    if "infeasible" in (cases if several else [cases]):
        cases = "infeasible"
    yield Holds(EVALUATED + "case", told["case"] == cases, str(cases))
    values: Mapping[str, Any] = {
        name: [getattr(one, name) for one in found] if several and name != "t_3" else getattr(found[0], name)
        for name in NAMES
    }
    for name in NAMES:
        if name in told:
            yield Same(EVALUATED + name, values[name])
