"""A polynomial in time with as many coefficients as there are conditions at its two ends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import factorial, perm
from typing import Any

from derive.algebra.numeric import number as value_of
from derive.derivation import Claim, Derivation, Figure, Step
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Degrees,
    Expr,
    Matrix,
    Power,
    Product,
    Quotient,
    Symbol,
    add,
    column,
    free_symbols,
    multiply,
    negate,
    number,
    sqrt,
    squared,
    subtract,
)
from derive.kinds.checks import SECOND_ROUTE, close, links, random_points
from derive.kinds.evaluation import Place
from derive.kinds.problem import Problem
from derive.kinds.profile._curves import panels
from derive.kinds.profile._limits import limits_drawn, limits_told
from derive.kinds.values_at import point_of
from derive.kinds.working import Working, named
from derive.mechanics.course import Course, Piece, at, extremes
from derive.mechanics.profile import Journey, Profile

t, q = Symbol("t"), Symbol("q")
RATES = ("q", "qdot", "qddot")


@dataclass(frozen=True, slots=True)
class Ends:
    """What is known at both ends by name, zero where it is zero: place, velocity, acceleration."""

    start: tuple[Expr, ...]
    end: tuple[Expr, ...]
    T: Symbol
    values: Mapping[Expr, Expr]
    rates: Mapping[Expr, int | None]  # how often a named value is differentiated; None for the time

    @property
    def order(self) -> int:
        """How many conditions hold at each end."""
        return len(self.start)

    @property
    def way(self) -> Expr:
        """From the start to the end."""
        return subtract(self.end[0], self.start[0])

    @property
    def at_rest(self) -> bool:
        return all(each == ZERO for each in (*self.start[1:], *self.end[1:]))


def polynomial(
    profile: Profile, kind: str, order: int, evaluate: Place | None, problem: Problem
) -> Derivation:
    """The polynomial with 2 `order` coefficients (Craig, section 7.3; Spong et al., section 5.5)."""
    journey = _journey(profile)
    if journey.via:
        raise NotDerivable("via points are for spline-trajectory; one polynomial goes from end to end")
    ends = _ends(journey, profile, order)
    working = Working(problem, ends.values, profile.sort == "angle" and problem.style.degrees)
    for k, start in enumerate(ends.start):
        formula = start if k < 2 else multiply(Quotient(ONE, number(factorial(k))), start)
        working = working.line(f"a_{k}", formula)
    for k, formula in enumerate(_upper(ends), order):
        working = working.line(f"a_{k}", formula)
    count = len(working.steps)
    terms = [working.values[Symbol(f"a_{k}")] for k in range(2 * order)]
    law = add(*(_term(term, k) for k, term in enumerate(terms)))
    extra, peaks = _peaks(working, ends, order)
    steps = (*_laws(order), _system(ends), *working.steps, Step("q_of_t", (q, law)), *extra.steps[count:])
    names = {**problem.names, **working.definitions, q: law}
    results = {**{f"a_{k}": working.final(f"a_{k}") for k in range(2 * order)}, "q": problem.final(law)}
    results |= {name: extra.final(name) for name in peaks}
    course = _course(results, profile, evaluate, problem, order)
    claims = (
        *links([step for step in steps if step.rule != "law"], {**names, **extra.definitions}),
        Claim(
            "the conditions at both ends, solved in numbers",
            SECOND_ROUTE,
            _solves(journey, profile, problem, results, order),
        ),
    )
    facts = {
        "given": tuple(
            (name, value, ends.rates[name]) for name, value in working.given if name in ends.rates
        ),
        "backwards": False,
        "units": profile.units,
        "order": order,
        "start": tuple(zip(RATES, ends.start, strict=False)),
        "end": tuple(zip(RATES, ends.end, strict=False)),
        "T": ends.T,
        "zero": ZERO,
        "t": t,
        "long": bool(free_symbols(law) - {"t"}) and not ends.at_rest,
        "lower": tuple(f"a_{k}" for k in range(order)),
        "upper": tuple(f"a_{k}" for k in range(order, 2 * order)),
        "at_rest": ends.at_rest,
        "peaks": peaks,
        "drawn": course is not None,
        **limits_told(profile, course, problem, evaluate),
    }
    return Derivation(
        kind, steps, results, claims, working.definitions, _evaluated(results, course, evaluate, problem),
        plots=_plots(course, profile, problem), facts=facts,
    )  # fmt: skip


def _journey(profile: Profile) -> Journey:
    if profile.journey is None or profile.time is None:
        raise NotDerivable("a start, an end and a time are needed")
    return profile.journey


def _ends(journey: Journey, profile: Profile, order: int) -> Ends:
    """Names for what is given; a zero stays a zero."""
    values: dict[Expr, Expr] = {}
    rates: dict[Expr, int | None] = {}

    def name(rate: int, where: str, value: Expr) -> Expr:
        if value == ZERO:
            return ZERO
        symbol = named(f"{('q', 'v', 'alpha')[rate]}_{where}", value)
        values[symbol], rates[symbol] = value, rate
        return symbol

    starts = (journey.start, journey.start_velocity, journey.start_acceleration)[:order]
    stops = (journey.end, journey.end_velocity, journey.end_acceleration)[:order]
    start = tuple(name(rate, "0", value) for rate, value in enumerate(starts))
    end = tuple(name(rate, "f", value) for rate, value in enumerate(stops))
    time = profile.time or ONE
    T = named("t_f", time)
    values[T], rates[T] = time, None
    return Ends(start, end, T, values, rates)


def _power(k: int) -> Expr:
    return ONE if k == 0 else t if k == 1 else Power(t, number(k))


def _term(coefficient: Expr, k: int) -> Expr:
    """a t^k, a minus sign in front of all."""
    if isinstance(coefficient, Degrees) and coefficient.value < 0:
        return multiply(number(-1), Degrees(-coefficient.value), _power(k))
    return multiply(coefficient, _power(k))


def _raised(base: Expr, k: int) -> Expr:
    return ONE if k == 0 else base if k == 1 else Power(base, number(k))


def _laws(order: int) -> Iterator[Step]:
    """q and its derivatives by the coefficients."""
    for rate in range(order):
        terms = [
            multiply(number(perm(k, rate)), Symbol(f"a_{k}"), _power(k - rate))
            for k in range(rate, 2 * order)
        ]
        yield Step(f"law_{rate}", (Symbol(RATES[rate]), add(*terms)), "law")


def _system(ends: Ends) -> Step:
    """The conditions at the end, for the coefficients that those at the start leave open."""
    order, T = ends.order, ends.T
    rows, right = [], []
    for rate in range(order):
        rows.append(
            tuple(multiply(number(perm(k, rate)), _raised(T, k - rate)) for k in range(order, 2 * order))
        )
        known = [
            multiply(number(Fraction(perm(k, rate), factorial(k))), ends.start[k], _raised(T, k - rate))
            for k in range(rate, order)
        ]
        right.append(add(ends.end[rate], *(negate(term) for term in known if term != ZERO)))
    unknown = column(Symbol(f"a_{k}") for k in range(order, 2 * order))
    return Step("system", (Product((Matrix(tuple(rows)), unknown)), column(right)))


def _upper(ends: Ends) -> tuple[Expr, ...]:
    """The coefficients the end decides, as books print them (Craig, eqs. 7.11 and 7.18)."""
    T, way = ends.T, ends.way
    v_0, v_f = ends.start[1], ends.end[1]
    if ends.order == 2:
        return (
            _over(T, 2, (3, way), (-2, v_0, T), (-1, v_f, T)),
            _over(T, 3, (-2, way), (1, v_0, T), (1, v_f, T)),
        )
    a_0, a_f = ends.start[2], ends.end[2]
    if ends.at_rest:
        return _over(T, 3, (10, way)), _over(T, 4, (-15, way)), _over(T, 5, (6, way))
    T2 = squared(T)
    return (
        _over(T, 3, (20, way), (-12, v_0, T), (-8, v_f, T), (-3, a_0, T2), (1, a_f, T2), half=True),
        _over(T, 4, (-30, way), (16, v_0, T), (14, v_f, T), (3, a_0, T2), (-2, a_f, T2), half=True),
        _over(T, 5, (12, way), (-6, v_0, T), (-6, v_f, T), (-1, a_0, T2), (1, a_f, T2), half=True),
    )


def _over(T: Symbol, k: int, *terms: tuple[Any, ...], half: bool = False) -> Expr:
    """A sum of multiples over (twice) a power of the time; zeros left out."""
    kept = [multiply(number(n), *factors) for n, *factors in terms if ZERO not in factors]
    top = add(*kept)
    if top == ZERO:
        return ZERO
    return Quotient(top, multiply(number(2), _raised(T, k)) if half else _raised(T, k))


# -- peaks --------------------------------------------------------------------------------------------


def _peaks(working: Working, ends: Ends, order: int) -> tuple[Working, tuple[str, ...]]:
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
    return working.line("v_peak", fast).line("a_peak", strong), ("v_peak", "a_peak")


# -- in numbers ---------------------------------------------------------------------------------------


def _course(
    results: Mapping[str, Expr], profile: Profile, evaluate: Place | None, problem: Problem, order: int
) -> Course | None:
    """In floats, where every value is known."""
    try:
        point = point_of({n: v for n, v in evaluate or () if n != "t"}, problem.where)
        end = value_of(profile.time or ONE, point)
        coefficients = tuple(value_of(results[f"a_{k}"], point) for k in range(2 * order))
    except KeyError as error:
        if evaluate is None:
            return None
        raise NotDerivable(f"no value is known for {error.args[0]}; give it one under evaluate:") from error
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
