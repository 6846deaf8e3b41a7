"""Shortest times: every limit needs one, by the peaks of a motion of unit distance in unit time."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

import mpmath

from derive.audit.asked import EVALUATED, Asked, Holds, Same, Test
from derive.audit.conditions import holds
from derive.audit.points import NEAR, Point, floating
from derive.audit.putting_back import put_back
from derive.audit.subjects.profile.trapezoid import trapezoid
from derive.expression import Expr

Typed = tuple[Expr, Expr | None, Expr | None]  # a distance and both limits
Sizes = tuple[mpmath.mpf, mpmath.mpf, mpmath.mpf]  # of a distance and both limits
CASES = re.compile(r"([a-z ]+) if ([^;]+)")
PLACES = 6  # where the cases of symbols are told apart
NAMES = ("time", "v_peak", "a_peak")


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
    if "solutions" in asked.results:
        for place in range(PLACES):
            there = _positive(asked, point, place)
            if all(floating(there.at(asked.formula(way))) > 0 for way, *_ in _typed(asked)):
                yield from _by_cases(asked, there)  # backwards it is told otherwise
    else:
        there = _positive(asked, point)
        active, values = _found(asked, there)
        yield Holds("active", asked.results["active"] == active, active)
        for name in NAMES:
            yield Same(name, values[name])
    if asked.evaluated:
        _, values = _found(asked, asked.here)
        for name in NAMES:
            if name in asked.evaluated:
                yield Same(EVALUATED + name, values[name])


def _by_cases(asked: Asked, point: Point) -> Iterator[Test]:
    """The case whose condition holds is the right one, and told as such."""
    active, values = _found(asked, point)
    expected = [values[name] for name in NAMES]
    met = []
    for branch in asked.objects("solutions"):
        case, _, condition = branch["when"].partition(": ")
        if holds(condition, asked, point):
            met.append(case)
            told = [point.at(asked.read(branch[name])) for name in NAMES]
            yield put_back("solutions", point, told, expected, f"not the least if {condition}")
    said = CASES.findall(str(asked.results["active"]))
    told_cases = [case.strip() for case, condition in said if holds(condition, asked, point)]
    yield Holds("solutions", met == [active], f"{met or 'no case'} is met where it is {active}")
    yield Holds("active", told_cases == [active], f"it is {active}")
    branches = asked.objects("solutions")
    first = next(
        (each for each in branches if asked.evaluated and _is_here(asked, each["when"])), branches[0]
    )
    for name in NAMES:
        yield put_back(name, point, asked.result(name), asked.read(first[name]), "none of the solutions")


def _is_here(asked: Asked, when: str) -> bool:
    return bool(holds(when.partition(": ")[2], asked, asked.here))


def _found(asked: Asked, point: Point) -> tuple[str, Mapping[str, object]]:
    """Which limits are active, the time and the peaks."""
    axes = [_sizes(asked, point, each) for each in _typed(asked)]
    several, law = len(axes) > 1, asked.options.law
    if law == "trapezoidal":
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
    formulas = [asked.formula(tree) for typed in _typed(asked) for tree in typed if tree is not None]
    names = {symbol.name for formula in formulas for symbol in formula.free_symbols}
    assumptions = {**point.assumptions, **dict.fromkeys(names, "positive")}
    return Point(point.seed + 100 * place, point.exact, point.angles, assumptions, point.fixed)
