"""A polynomial in time with as many coefficients as there are conditions at its two ends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import factorial

from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Derivation, PageFacts, Phrase, Step
from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Expr, Symbol, add, free_symbols, multiply, number, sqrt
from derive.kinds.fields import TREES, Place
from derive.kinds.meanings import as_told
from derive.kinds.problem import Problem
from derive.kinds.profile._drawn import Drawn, LimitTold
from derive.kinds.profile._ends import Ends, ends_of, laws, system, t, term, upper
from derive.kinds.profile._polynomial_checks import BothEnds
from derive.kinds.profile._units import DEGREES, units_of
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.course import Course, Piece
from derive.mechanics.profile import Journey, Profile, Units

q = Symbol("q")


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr, int | None], ...]  # each with how often it is differentiated
    units: Units
    ends: Phrase  # what is given there
    first: tuple[str, ...]  # steps: the polynomial and its derivatives
    T: Symbol
    t: Symbol = t
    zero: Expr = ZERO
    sum: tuple[str, ...]  # the step with all of it, where it is short
    lower: tuple[str, ...]  # steps
    upper: tuple[str, ...]  # steps
    greatest: Phrase | None  # where the velocity and the acceleration are
    peaks: tuple[str, ...]  # steps
    drawn: bool
    limits: tuple[LimitTold, ...]


def _from_to(ends: Ends, journey: Journey) -> Iterator[bool]:
    """Whether what is named at each end is what is given there."""
    first = journey.start, journey.start_velocity, journey.start_acceleration
    last = journey.end, journey.end_velocity, journey.end_acceleration
    for named, given in ((ends.start, first), (ends.end, last)):
        yield [ends.values.get(name, name) for name in named] == [*given[: ends.order]]


def polynomial(
    profile: Profile, kind: str, order: int, evaluate: Place | None, problem: Problem
) -> Derivation:
    """The polynomial with 2 `order` coefficients (Craig, section 7.3; Spong et al., section 5.5)."""
    journey = _journey(profile)
    ends = ends_of(journey, profile, order, problem)
    orders: dict[Expr, int | None] = {Symbol(f"a_{k}"): k for k in range(2 * order)}
    units = units_of(profile, {**ends.rates, **orders})
    work = Work(problem, ends.values, profile.sort == "angle" and problem.style.degrees, units=units)
    names = [f"a_{k}" for k in range(2 * order)]
    lower = (s if k < 2 else multiply(ONE / number(factorial(k)), s) for k, s in enumerate(ends.start))
    for name, formula in zip(names, (*lower, *upper(ends)), strict=True):
        work = work.worked(name, formula)
    law = add(*(term(work[name], k) for k, name in enumerate(names)))
    work = replace(work, steps=(*laws(order), *work.steps[:order], system(ends), *work.steps[order:]))
    typed, work = work.typed, work.showing(Step("q_of_t", (q, law)))
    work, peaks = _peaks(replace(work, aside={q: law}), ends, order)
    results = {**{name: work.final(name) for name in names}, "q": problem.final(law)}
    results |= {name: work.final(name) for name in peaks}
    course = _course(results, profile, evaluate, problem, order)
    drawn = Drawn(profile, problem, evaluate, course)
    facts = Facts(
        given=tuple((name, value, ends.rates[name]) for name, value in typed if name in ends.rates),
        units=profile.units,
        ends=_ends_told(ends),
        first=tuple(step.name for step in work.steps[:order]),
        T=ends.T,
        sum=() if bool(free_symbols(law) - {"t"}) and not ends.at_rest else ("q_of_t",),
        lower=tuple(names[:order]),
        upper=tuple(names[order:]),
        greatest=_greatest(order) if peaks else None,
        peaks=peaks,
        drawn=course is not None,
        limits=drawn.limits(),
    )
    means = BothEnds(journey, profile.time or ONE, ends)
    printed = ((Symbol(name), tree) for name, tree in results.items())
    told_too = (*printed, *((name, value) for name, value, _ in facts.given), (ends.T, facts.T))
    rates = {name: rate for places in (ends.start, ends.end) for rate, name in enumerate(places)}
    told_rates = [rate == (None if name == ends.T else rates[name]) for name, _, rate in facts.given]
    work = work.law("said", (*told_rates, *_said(facts, len(names), journey), *_from_to(ends, journey)))
    work = as_told(work, means.names, told_too, "both-ends", symbols=problem.symbols | {t.name})
    moments: dict[Expr, Expr] = {ends.T: profile.time or ONE}
    work = work.claim(*drawn.claims(((results["q"], None),), facts.limits, facts.drawn, moments=moments))
    evaluated = drawn.evaluated({name: tree for name, tree in results.items() if name != "q"})
    plots = drawn.plots("trajectory", moments)
    if drawn.in_degrees and not profile.sort:
        units = units_of(replace(profile, units=DEGREES), {**ends.rates, **orders})
    return work.answer(kind, results, facts, evaluated=evaluated, plots=plots, units=units)


def _ends_told(ends: Ends) -> Phrase:
    """What is known there; that there is no acceleration need not be given."""
    if ends.order == 2:
        return Phrase("cubic-ends")
    still = ends.start[2] == ends.end[2] == ZERO
    return Phrase("quintic-ends-unaccelerated" if still else "quintic-ends")


def _greatest(order: int) -> Phrase:
    """Where velocity and acceleration are greatest from rest to rest; shares of the whole time."""
    if order == 2:
        return Phrase("cubic-peaks")
    half, apart = ONE / number(2), sqrt(number(3)) / number(6)
    return Phrase("quintic-peaks", {"early": half - apart, "late": half + apart})


def _said(facts: Facts, coefficients: int, journey: Journey) -> Iterator[bool]:
    """The sentences are those for so many coefficients; the jerk vanishes where it is said."""
    name = {4: "cubic", 6: "quintic"}[coefficients]
    pushed = any(each != ZERO for each in (journey.start_acceleration, journey.end_acceleration))
    known = f"{name}-ends" if coefficients == 4 or pushed else f"{name}-ends-unaccelerated"
    yield facts.ends.key == known and (facts.greatest is not None) == bool(facts.peaks)
    if facts.greatest is not None:
        yield facts.greatest.key == f"{name}-peaks"
        shares = [value_of(share, {}) for share in facts.greatest.about.values() if isinstance(share, TREES)]
        yield len(shares) == (0 if coefficients == 4 else 2)
        yield all(abs(1 - 6 * x + 6 * x**2) < 1e-9 for x in shares) and shares == sorted({*shares})


def _journey(profile: Profile) -> Journey:
    if profile.journey is None or profile.time is None:
        raise NotDerivable("a start, an end and a time are needed")
    return profile.journey


# -- peaks --------------------------------------------------------------------------------------------


def _peaks(work: Work, ends: Ends, order: int) -> tuple[Work, tuple[str, ...]]:
    """From rest to rest: the velocity in the middle, and the greatest acceleration."""
    if not ends.at_rest:
        return work, ()
    way, T = ends.way, ends.T
    if order == 2:
        fast = multiply(number(3), way) / multiply(number(2), T)
        strong = multiply(number(6), way) / T**2
    else:
        fast = multiply(number(15), way) / multiply(number(8), T)
        strong = multiply(number(10), way) / multiply(sqrt(number(3)), T**2)
    return work.worked("v_peak", fast).worked("a_peak", strong), ("v_peak", "a_peak")


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
