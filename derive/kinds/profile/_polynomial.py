"""A polynomial in time with as many coefficients as there are conditions at its two ends."""

from __future__ import annotations

from collections.abc import Mapping
from math import factorial, perm
from typing import Any

from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Claim, Derivation, Figure, PageFacts, Step
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Expr,
    Quotient,
    Symbol,
    add,
    free_symbols,
    multiply,
    number,
    sqrt,
    squared,
)
from derive.figures.courses import panels
from derive.kinds.checks import SECOND_ROUTE, close, links, random_points
from derive.kinds.evaluation import Place
from derive.kinds.problem import Problem
from derive.kinds.profile._ends import Ends, ends_of, laws, system, t, term, upper
from derive.kinds.profile._limits import LimitTold, limits_drawn, limits_told
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.course import Course, Piece, at, extremes
from derive.mechanics.profile import Journey, Profile, Units

q = Symbol("q")


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr, int | None], ...]  # each with how often it is differentiated
    backwards: bool = False
    units: Units
    order: int
    T: Symbol
    t: Symbol = t
    zero: Expr = ZERO
    long: bool
    lower: tuple[str, ...]  # steps
    upper: tuple[str, ...]  # steps
    peaks: tuple[str, ...]  # steps
    drawn: bool
    limits: tuple[LimitTold, ...]


def polynomial(
    profile: Profile, kind: str, order: int, evaluate: Place | None, problem: Problem
) -> Derivation:
    """The polynomial with 2 `order` coefficients (Craig, section 7.3; Spong et al., section 5.5)."""
    journey = _journey(profile)
    ends = ends_of(journey, profile, order, problem)
    working = Work(problem, ends.values, profile.sort == "angle" and problem.style.degrees)
    for k, start in enumerate(ends.start):
        formula = start if k < 2 else multiply(Quotient(ONE, number(factorial(k))), start)
        working = working.worked(f"a_{k}", formula)
    for k, formula in enumerate(upper(ends), order):
        working = working.worked(f"a_{k}", formula)
    count = len(working.steps)
    terms = [working.known[Symbol(f"a_{k}")] for k in range(2 * order)]
    law = add(*(term(each, k) for k, each in enumerate(terms)))
    extra, peaks = _peaks(working, ends, order)
    steps = (*laws(order), system(ends), *working.steps, Step("q_of_t", (q, law)), *extra.steps[count:])
    names = {**problem.names, **working.definitions, q: law}
    results = {**{f"a_{k}": working.final(f"a_{k}") for k in range(2 * order)}, "q": problem.final(law)}
    results |= {name: extra.final(name) for name in peaks}
    course = _course(results, profile, evaluate, problem, order)
    claims = (
        *links([step for step in steps if step.rule != "law"], {**names, **extra.definitions}),
        Claim(
            "both-ends",
            SECOND_ROUTE,
            _solves(journey, profile, problem, results, order),
        ),
    )
    facts = Facts(
        given=tuple((name, value, ends.rates[name]) for name, value in working.typed if name in ends.rates),
        units=profile.units,
        order=order,
        T=ends.T,
        long=bool(free_symbols(law) - {"t"}) and not ends.at_rest,
        lower=tuple(f"a_{k}" for k in range(order)),
        upper=tuple(f"a_{k}" for k in range(order, 2 * order)),
        peaks=peaks,
        drawn=course is not None,
        limits=limits_told(profile, course, problem, evaluate),
    )
    return Derivation(
        kind, steps, results, claims, working.definitions, _evaluated(results, course, evaluate, problem),
        plots=_plots(course, profile, problem), facts=facts,
    )  # fmt: skip


def _journey(profile: Profile) -> Journey:
    if profile.journey is None or profile.time is None:
        raise NotDerivable("a start, an end and a time are needed")
    return profile.journey


# -- peaks --------------------------------------------------------------------------------------------


def _peaks(working: Work, ends: Ends, order: int) -> tuple[Work, tuple[str, ...]]:
    """From rest to rest: the velocity in the middle, and the greatest acceleration."""
    if not ends.at_rest:
        return working, ()
    way, T = ends.way, ends.T
    if order == 2:
        fast = Quotient(multiply(number(3), way), multiply(number(2), T))
        strong = Quotient(multiply(number(6), way), squared(T))
    else:
        fast = Quotient(multiply(number(15), way), multiply(number(8), T))
        strong = Quotient(multiply(number(10), way), multiply(sqrt(number(3)), squared(T)))
    return working.worked("v_peak", fast).worked("a_peak", strong), ("v_peak", "a_peak")


# -- in numbers ---------------------------------------------------------------------------------------


def _course(
    results: Mapping[str, Expr], profile: Profile, evaluate: Place | None, problem: Problem, order: int
) -> Course | None:
    """In floats, where every value is known."""
    try:
        point = point_of({n: v for n, v in evaluate or () if n != "t"}, problem.where)
        end = value_of(profile.time or ONE, point)
        coefficients = tuple(value_of(results[f"a_{k}"], point) for k in range(2 * order))
    except KeyError:
        return None
    return (Piece(0.0, end, coefficients),)


def _evaluated(
    results: Mapping[str, Expr], course: Course | None, evaluate: Place | None, problem: Problem
) -> dict[str, Any]:
    """The coefficients, and q where a time is given."""
    if evaluate is None or course is None:
        return {}
    point = point_of(dict(evaluate), problem.where)
    found = {name: value_of(tree, point) for name, tree in results.items() if name != "q"}
    return {**found, "q": at(course, point["t"])} if "t" in point else found


def _plots(course: Course | None, profile: Profile, problem: Problem) -> tuple[Figure, ...]:
    return (
        (
            panels(
                "trajectory",
                {"": course},
                profile.sort,
                problem.style.degrees,
                limits_drawn(profile, problem),
            ),
        )
        if course
        else ()
    )


def _solves(
    journey: Journey, profile: Profile, problem: Problem, results: Mapping[str, Expr], order: int
) -> bool:
    """All conditions at once as one linear system in floats; the peaks against those of the course."""
    import numpy

    starts = (journey.start, journey.start_velocity, journey.start_acceleration)[:order]
    stops = (journey.end, journey.end_velocity, journey.end_acceleration)[:order]
    wanted = [problem.final(each) for each in (*starts, *stops, profile.time or ONE)]
    for point in random_points(sorted(problem.symbols), 3) if problem.symbols else iter([{}]):
        *right, T = (value_of(tree, point) for tree in wanted)
        rows = [
            [perm(k, rate) * moment ** (k - rate) if k >= rate else 0.0 for k in range(2 * order)]
            for moment in (0.0, T)
            for rate in range(order)
        ]
        found = [value_of(results[f"a_{k}"], point) for k in range(2 * order)]
        if not close(numpy.linalg.solve(rows, right).tolist(), found, 1e-8):
            return False
        course = (Piece(0.0, T, tuple(found)),)
        for rate, name in enumerate(("v_peak", "a_peak"), 1):
            if name in results:
                greatest = max(map(abs, extremes(course, rate)))
                if not close(greatest, abs(value_of(results[name], point)), 1e-8):
                    return False
    return True
