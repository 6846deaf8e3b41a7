"""Shortest times: every limit needs one, by the peaks of a motion of unit distance in unit time."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias

import mpmath

from derive.audit.asked import EVALUATED, Asked, Holds, Same, Test
from derive.audit.conditions import holds
from derive.audit.points import NEAR, Point, floating
from derive.audit.putting_back import put_back
from derive.audit.subjects.profile.along import fastest
from derive.audit.subjects.profile.trapezoid import trapezoid
from derive.expression import Expr

Typed = tuple[Expr, Expr | None, Expr | None]  # a distance and both limits
Sizes = tuple[mpmath.mpf, mpmath.mpf, mpmath.mpf]  # of a distance and both limits
CASES = re.compile(r"([a-z ]+) if ([^;]+)")
PLACES = 6  # where the cases of symbols are told apart
Route: TypeAlias = "Callable[[Asked, Point], tuple[str, Mapping[str, object]]]"


def unit_peaks(law: str) -> tuple[mpmath.mpf, mpmath.mpf]:
    """The greatest velocity and acceleration from 0 to 1 in the time 1: the velocity is t (1 - t) to a power,
    or 1 - cos(2 pi t), made to cover the distance 1."""
    powers = {"cubic": 1, "quintic": 2}

    def rate(t: mpmath.mpf) -> mpmath.mpf:
        if law in powers:
            return (t * (1 - t)) ** powers[law]
        return 1 - mpmath.cos(2 * mpmath.pi * t)

    whole = mpmath.quad(rate, [0, 0.5, 1])
    slope = {"cubic": lambda: rate_slope(1, mpmath.mpf(0)), "quintic": lambda: rate_slope(2, _flat())}
    strongest = slope[law]() if law in slope else 2 * mpmath.pi
    return rate(mpmath.mpf("0.5")) / whole, strongest / whole


def rate_slope(power: int, t: mpmath.mpf) -> mpmath.mpf:
    """The derivative of (t (1 - t))^power."""
    return power * (t * (1 - t)) ** (power - 1) * (1 - 2 * t)


def _flat() -> mpmath.mpf:
    """Where the slope of (t (1 - t))^2 is greatest: 1 - 6 t + 6 t^2 vanishes."""
    return (3 - mpmath.sqrt(3)) / 6


def minimum_time(asked: Asked, point: Point) -> Iterator[Test]:
    """The longest of the times that the limits of all axes need."""
    if asked.subject.path is not None:
        yield from fastest(asked, point)
        return
    moving = asked.subject.journey and not _at_rest(asked)
    if moving or (asked.options.law == "bang-bang" and not asked.subject.axes):
        yield from _held(asked, point, _switched)
    else:
        yield from _held(asked, point, _found)


def _at_rest(asked: Asked) -> bool:
    journey = asked.subject.journey
    return bool(journey.begins_at_rest and journey.ends_at_rest)


def _switched(asked: Asked, point: Point) -> tuple[str, Mapping[str, object]]:
    """Of all velocities in between that can be the best, the fastest: those that leave no way for a stretch
    between both ramps, and the greatest ones."""
    journey = asked.subject.journey
    typed = (journey.end - journey.start, journey.start_velocity, journey.end_velocity, journey.a_max)
    d, v_0, v_f, a = (floating(point.at(asked.formula(tree))) for tree in typed)
    most = mpmath.inf if journey.v_max is None else floating(point.at(asked.formula(journey.v_max)))
    squares = [(sign, sign * a * d + (v_0**2 + v_f**2) / 2) for sign in (1, -1)]
    exact = [sign * mpmath.sqrt(square) for sign, square in squares if square >= 0]
    found = []
    for v in (*(v for v in exact if abs(v) <= most), *((most, -most) if most < mpmath.inf else ())):
        ramps = [(v_0, v), (v, v_f)]
        rest = d - sum((u + w) / 2 * abs(w - u) / a for u, w in ramps)
        t_1, t_3 = (abs(w - u) / a for u, w in ramps)
        if abs(rest) < NEAR * (abs(d) + v**2 / a) or rest * v > 0:
            coast = rest / v if abs(rest) >= NEAR * (abs(d) + v**2 / a) else mpmath.mpf(0)
            found.append({"time": t_1 + coast + t_3, "t_1": t_1, "t_2": t_1 + coast, "v": v})
    best = min(found, key=lambda each: each["time"])
    held = best["t_2"] > best["t_1"] * (1 + NEAR)
    return "velocity and acceleration" if held else "acceleration", best


def time_scaling(asked: Asked, point: Point) -> Iterator[Test]:
    """That time over the one that was given."""
    yield from _held(asked, point, _scaled)


def _held(asked: Asked, point: Point, found: Route) -> Iterator[Test]:
    """All results and numbers; those of several axes have no symbols."""
    ahead = [
        each for each in (_positive(asked, point, place) for place in range(PLACES)) if _is_ahead(asked, each)
    ]
    if "solutions" in asked.results:
        for there in ahead:
            yield from _by_cases(asked, there, found)  # backwards it is told otherwise
    else:
        there = ahead[0] if ahead else point
        active, values = found(asked, there)
        yield Holds("active", asked.results["active"] == active, active)
        for name in values.keys() & asked.results.keys():
            if isinstance(asked.results[name], list):
                yield Same(name, values[name])
            else:
                yield put_back(name, there, asked.result(name), values[name], "it is another")
    if asked.evaluated:
        _, values = found(asked, asked.here)
        for name in values.keys() & asked.evaluated.keys():
            yield Same(EVALUATED + name, values[name])


def _by_cases(asked: Asked, point: Point, found: Route) -> Iterator[Test]:
    """The case whose condition holds is the right one, and told as such."""
    active, values = found(asked, point)
    met = []
    for branch in asked.objects("solutions"):
        case, _, condition = branch["when"].partition(": ")
        if holds(condition, asked, point):
            met.append(case)
            names = [name for name in values if name in branch]
            told = [point.at(asked.read(branch[name])) for name in names]
            expected = [values[name] for name in names]
            yield put_back("solutions", point, told, expected, f"not the least if {condition}")
    said = CASES.findall(str(asked.results["active"]))
    told_cases = [case.strip() for case, condition in said if holds(condition, asked, point)]
    yield Holds("solutions", met == [active], f"{met or 'no case'} is met where it is {active}")
    yield Holds("active", told_cases == [active], f"it is {active}")
    branches = asked.objects("solutions")
    here = (each for each in branches if asked.evaluated and _is_here(asked, each["when"]))
    first = next(here, branches[0])
    for name in values.keys() & first.keys():
        yield put_back(name, point, asked.result(name), asked.read(first[name]), "none of the solutions")


def _is_ahead(asked: Asked, point: Point) -> bool:
    """Whether every axis goes forward, as far as symbols decide that."""
    ways = [asked.formula(way) for way, *_ in _typed(asked)]
    return all(not way.free_symbols or floating(point.at(way)) > 0 for way in ways)


def _is_here(asked: Asked, when: str) -> bool:
    return bool(holds(when.partition(": ")[2], asked, asked.here))


def _found(asked: Asked, point: Point) -> tuple[str, Mapping[str, object]]:
    """Which limits are active, the time and the peaks."""
    axes = [_sizes(asked, point, each) for each in _typed(asked)]
    several, law = len(axes) > 1, asked.options.law
    if law in ("trapezoidal", "bang-bang"):
        alone = [trapezoid(*each, None) for each in axes]
        longest = max(each.t_3 for each in alone)
        needs = {
            (k, rate): each.t_3
            for k, each in enumerate(alone, 1)
            for rate in ((1, 2) if each.case == "trapezoidal" else (2,))
        }
        if several:
            alone = [trapezoid(*each, longest) for each in axes]
        peaks = [(each.v, each.a) for each in alone]
    else:
        fast, strong = unit_peaks(law)
        needs = {}
        for k, (d, v, a) in enumerate(axes, 1):
            needs |= {(k, 1): fast * d / v, (k, 2): mpmath.sqrt(strong * d / a)}
        longest = max(needs.values())
        peaks = [(fast * d / longest, strong * d / longest**2) for d, _, _ in axes]
    active = [key for key, time in needs.items() if time >= longest * (1 - NEAR)]
    texts = [
        ("velocity", "acceleration")[rate - 1] + (f" of axis {k}" if several else "") for k, rate in active
    ]
    speeds, pushes = ([pair[k] for pair in peaks] for k in (0, 1))
    values = {
        "time": longest,
        "v_peak": speeds if several else speeds[0],
        "a_peak": pushes if several else pushes[0],
    }
    return _listed(texts), values


def _scaled(asked: Asked, point: Point) -> tuple[str, Mapping[str, object]]:
    """Which limits are active, the factor, the new time, and the peaks before and after."""
    active, values = _found(asked, point)
    longest: Any = values["time"]
    time = floating(point.at(asked.formula(asked.subject.time)))
    fast, strong = unit_peaks(asked.options.law)
    found = {"k": longest / time, "time": longest, "v_k": values["v_peak"], "a_k": values["a_peak"]}
    if len(_typed(asked)) == 1:
        d, *_ = _sizes(asked, point, _typed(asked)[0])
        found |= {"v_peak": fast * d / time, "a_peak": strong * d / time**2}
    return active, found


def _listed(texts: list[str]) -> str:
    *most, last = texts
    return f"{', '.join(most)} and {last}" if most else last


def _typed(asked: Asked) -> list[Typed]:
    profile = asked.subject
    if profile.axes:
        return [(axis.distance, axis.v_max, axis.a_max) for axis in profile.axes]
    journey = profile.journey
    return [(journey.end - journey.start, journey.v_max, journey.a_max)]


def _sizes(asked: Asked, point: Point, typed: Typed) -> Sizes:
    d, v, a = (mpmath.inf if tree is None else abs(floating(point.at(asked.formula(tree)))) for tree in typed)
    return d, v, a


def _positive(asked: Asked, point: Point, place: int = 0) -> Point:
    """Near the point, with every size positive."""
    trees = [tree for typed in _typed(asked) for tree in (*typed, asked.subject.time) if tree is not None]
    formulas = [asked.formula(tree) for tree in trees]
    names = {symbol.name for formula in formulas for symbol in formula.free_symbols}
    assumptions = {**point.assumptions, **dict.fromkeys(names, "positive")}
    return Point(point.seed + 100 * place, point.exact, point.angles, assumptions, point.fixed)
