"""Whether a course keeps its limits, and where it does not."""

from __future__ import annotations

from fractions import Fraction
from math import degrees

from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Record
from derive.expression import Approximate, Degrees, Expr
from derive.kinds.evaluation import Place
from derive.kinds.problem import Problem
from derive.kinds.values_at import point_of
from derive.mechanics.course import Course, extremes, sampled
from derive.mechanics.profile import Profile

SLACK = 1e-9


class LimitTold(Record):
    name: str
    limit: Expr
    rate: int  # 1 for a velocity, 2 for an acceleration
    reached: Expr
    kept: bool
    first: Expr | None  # when it is not kept any more


def limits_told(
    profile: Profile, course: Course | None, problem: Problem, evaluate: Place | None
) -> tuple[LimitTold, ...]:
    """Each limit that is given, what is reached, whether that is kept, and when it is not."""
    journey = profile.journey
    if journey is None or course is None:
        return ()
    given = (("velocity", journey.v_max, 1), ("acceleration", journey.a_max, 2))
    turned = profile.sort == "angle" and problem.style.degrees
    point = () if evaluate is None else evaluate
    found = [
        _limit(name, limit, order, course, _size(problem.final(limit), point), turned)
        for name, limit, order in given
        if limit is not None
    ]
    return tuple(each for each in found if each)


def limits_drawn(profile: Profile, problem: Problem) -> tuple[float | None, float | None]:
    """The limits of velocity and acceleration as numbers, where they are."""
    journey = profile.journey
    given = (None, None) if journey is None else (journey.v_max, journey.a_max)
    fast, strong = (None if limit is None else _size(problem.final(limit)) for limit in given)
    return fast, strong


def _size(limit: Expr, point: Place = ()) -> float | None:
    try:
        return value_of(limit, point_of(dict(point), {}))
    except KeyError:
        return None


def _shown(value: float, in_degrees: bool) -> Expr:
    """To the digits of a page; an angle in degrees where the author typed such."""
    return Degrees(Fraction(f"{degrees(value):.4g}")) if in_degrees else Approximate(value)


def _limit(
    name: str, limit: Expr, order: int, course: Course, most: float | None, turned: bool
) -> LimitTold | None:
    if most is None:
        return None
    reached = max(map(abs, extremes(course, order)))
    times, values = sampled(course, order)
    beyond = [t for t, value in zip(times, values, strict=True) if abs(value) > most * (1 + SLACK)]
    return LimitTold(
        name=name,
        limit=limit,
        rate=order,
        reached=_shown(reached, turned),
        kept=reached <= most * (1 + SLACK),
        first=Approximate(beyond[0]) if beyond else None,
    )
