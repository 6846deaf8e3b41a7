"""A linear segment with parabolic blends: constant velocity between two ends that are smoothed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from derive.algebra.numeric import number as value_of
from derive.derivation import Claim, Derivation, Step
from derive.errors import NotDerivable
from derive.expression import (
    MINUS_ONE,
    ZERO,
    Expr,
    Product,
    Quotient,
    Symbol,
    add,
    free_symbols,
    is_negative,
    negate,
    number,
    replace,
    sqrt,
    squared,
    subtract,
    symbols,
)
from derive.kinds.checks import SECOND_ROUTE, close, law, links, random_points
from derive.kinds.evaluation import Evaluation, Place
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.profile._curves import panels
from derive.kinds.profile._limits import limits_drawn, limits_told
from derive.kinds.profile._pieces import Span, branch, in_floats, joined, q_at, term
from derive.kinds.working import Working, named
from derive.mechanics.course import Course
from derive.mechanics.profile import Journey, Profile

NEEDS = ("journey",)
RESULTS = {
    "t_b": "how long each blend lasts",
    "v": "the velocity between the blends",
    "a": "the acceleration in the first blend, its opposite in the second",
    "t_f": "the whole duration",
    "q": "the pieces of the trajectory as functions of t, and when",
}
EXAMPLE = """\
title: Linear segments with parabolic blends
problems:
- profile: {from: q_0, to: q_f, time: t_f, cruise: V}
  find: lspb-trajectory
- profile: {from: 0, to: 60 deg, time: 3 s, acceleration: 60 deg/s^2}
  find: lspb-trajectory
- profile: {from: 0.2 m, to: 1.2 m, v_max: 0.5 m/s, a_max: 1 m/s^2}
  find: lspb-trajectory
"""
t, q, T_B, V, A = symbols("t q t_b v a")
RATES = {"q_0": 0, "q_f": 0, "v": 1, "a": 2, "t_f": None, "t_b": None}


class Options(OptionsModel):
    """Where symbols stand for something, `evaluate` draws the trajectory at a point; with t also q there."""

    evaluate: Evaluation = None


@dataclass(frozen=True, slots=True)
class Blended:
    """The working up to t_b, v and a, the names of the ends and of the time, and what was given."""

    working: Working
    start: Expr
    end: Expr
    T: Symbol
    by: str
    rates: Mapping[Expr, int | None]
    uses: tuple[Derivation, ...] = ()
    given: Symbol | None = None  # the velocity, acceleration or duration that was given

    @property
    def way(self) -> Expr:
        return subtract(self.end, self.start)

    @property
    def open(self) -> bool:
        """Whether symbols are left in the duration of the blends."""
        return bool(free_symbols(self.working.problem.final(_value(T_B, self.working))))

    def laws(self) -> tuple[Expr, Expr, Expr]:
        """q as a function of t in the three pieces, as books print it (Spong et al., eq. 5.39)."""
        half = Quotient(T_B, number(2))
        return (
            add(self.start, Quotient(Product((A, squared(t))), number(2))),
            add(self.start, Product((V, add(t, _minus(half))))),
            add(self.end, _minus(Quotient(Product((A, squared(subtract(self.T, t)))), number(2)))),
        )

    def spans(self) -> tuple[Span, Span, Span]:
        """The same by the time since the beginning of each piece."""
        ramp = Quotient(Product((V, T_B)), number(2))
        push = Quotient(A, number(2))
        later = subtract(self.T, T_B)
        return (
            Span(ZERO, T_B, (self.start, ZERO, push)),
            Span(T_B, later, (add(self.start, ramp), V)),
            Span(later, self.T, (subtract(self.end, ramp), V, negate(push))),
        )


def derive(profile: Profile, options: Options, problem: Problem) -> Derivation:
    """Three pieces, symmetric in time (Craig, section 7.3; Spong et al., section 5.5.3).

    Raises NotDerivable where nothing says how fast it is, or it cannot be there in time.
    """
    journey = profile.journey
    if journey is None:
        raise NotDerivable("a start and an end are needed")
    found = _blended(journey, profile, problem)
    working = found.working
    spans = tuple(_filled(span, working) for span in found.spans())
    laws = _laws(found, working)
    course = in_floats(spans, options.evaluate, problem)
    results = {name: working.final(name) for name in ("t_b", "v", "a")}
    results["t_f"] = problem.final(working.values[found.T])
    bounds = found.spans() if found.open else spans
    pieces = tuple(branch(q_t, s.start, s.end, problem) for q_t, s in zip(laws, bounds, strict=True))
    steps = (*working.steps, *_piece_steps(found.laws(), laws, found.open))
    claims = (
        *links(steps, {**problem.names, **working.definitions}),
        *joined(found.spans(), working, 2),
        *_ends_of(found, working),
        Claim("the way is the area under the velocity", SECOND_ROUTE, _covers(results, journey, problem)),
    )
    return Derivation(
        "lspb-trajectory",
        steps,
        {**results, "q": pieces},
        claims,
        working.definitions,
        _evaluated(results, course, options.evaluate, problem),
        uses=found.uses,
        plots=_plots(course, profile, problem),
        facts=_facts(found, spans, profile, course, problem, options.evaluate),
    )


# -- how it is made -----------------------------------------------------------------------------------


def _blended(journey: Journey, profile: Profile, problem: Problem) -> Blended:
    values: dict[Expr, Expr] = {}
    rates: dict[Expr, int | None] = {}

    def name(standard: str, value: Expr) -> Symbol:
        symbol = named(standard, value)
        values[symbol], rates[symbol] = value, RATES[standard]
        return symbol

    start = ZERO if journey.start == ZERO else name("q_0", journey.start)
    end = ZERO if journey.end == ZERO else name("q_f", journey.end)
    angular = profile.sort == "angle" and problem.style.degrees
    chosen = (("v", journey.cruise), ("a", journey.acceleration), ("t_b", journey.blend))
    by = next((key for key, value in chosen if value is not None), "")
    if not by:
        return _by_limits(profile, problem, start, end, values, rates, angular)
    if profile.time is None:
        raise NotDerivable("no time is given: add time: t_f, or v_max: and a_max: for the shortest")
    T = name("t_f", profile.time)
    value = _same_way(dict(chosen)[by] or ZERO, by, subtract(end, start), Working(problem, values, angular))
    given = name(by, value)
    working = _solved(Working(problem, values, angular), by, given, subtract(end, start), T)
    return Blended(working, start, end, T, by, rates, given=given)


def _same_way(value: Expr, by: str, way: Expr, working: Working) -> Expr:
    """A velocity or an acceleration has the sign of the way; a duration has none."""
    signs = working.sign(value), working.sign(way)
    if signs[1] == 0:
        raise NotDerivable("start and end are the same: there is nowhere to go")
    return (
        working.value(negate(value)) if by != "t_b" and None not in signs and signs[0] != signs[1] else value
    )


def _solved(working: Working, by: str, given: Symbol, way: Expr, T: Symbol) -> Working:
    """The other two of t_b, v and a."""
    if by == "v":
        working = working.line("v", given).line("t_b", add(T, _minus(Quotient(way, given))))
        _need(working, T, "the velocity must lie between the way over the time and twice that")
        return working.line("a", Quotient(given, T_B))
    if by == "a":
        working = working.line("a", given)
        inside = add(Quotient(squared(T), number(4)), _minus(Quotient(way, given)))
        if working.sign(inside) == -1:
            raise NotDerivable("the acceleration must be at least four times the way over the time squared")
        working = working.line("t_b", subtract(Quotient(T, number(2)), sqrt(inside)))
        duration = working.values[T_B]
        return working.line(
            "v", Product((given, T_B)), Product((given, duration)) if free_symbols(duration) else None
        )
    working = working.line("t_b", given)
    _need(working, T, "the two blends cannot last longer than the whole")
    return working.line("v", Quotient(way, subtract(T, T_B))).line("a", Quotient(V, T_B))


def _minus(expr: Expr) -> Expr:
    """The opposite, its sign in front of the whole fraction."""
    return negate(expr) if is_negative(expr) else Product((MINUS_ONE, expr))


def _need(working: Working, T: Symbol, why: str) -> None:
    """0 < t_b <= t_f/2. Raises NotDerivable."""
    if working.sign(T_B) in (0, -1) or working.sign(subtract(Quotient(T, number(2)), T_B)) == -1:
        raise NotDerivable(f"this cannot be done in the time: {why}")


def _by_limits(
    profile: Profile, problem: Problem, start: Expr, end: Expr, values: dict[Expr, Expr],
    rates: dict[Expr, int | None], angular: bool,
) -> Blended:  # fmt: skip
    """Within v_max and a_max: by the switching times of the trapezoidal profile."""
    if len(profile.axes) != 1:
        raise NotDerivable(
            "nothing says how fast it is: add cruise:, acceleration: or blend:, or both limits"
        )
    base = problem.ask("trapezoidal-profile")
    if base.results["case"] not in ("trapezoidal", "triangular"):
        raise NotDerivable(f"the profile is {base.results['case']}: its pieces cannot be written down")
    sign = number(Working(problem, values).sign(subtract(end, start)) or 1)
    T = Symbol("t_f")
    found: dict[Symbol, Any] = {
        Symbol(key): base.results[name]
        for key, name in (("t_b", "t_1"), ("v", "v"), ("a", "a"), ("t_f", "t_3"))
    }
    working = Working(problem, values, angular)
    for symbol, value in found.items():
        signed = value if symbol in (T, T_B) or sign == number(1) else negate(value)
        working = working.given_too({symbol: working.value(signed)})
        rates[symbol] = RATES[symbol.name]
    return Blended(working, start, end, T, "limits", rates, (base,))


# -- the pieces ---------------------------------------------------------------------------------------


def _put_in(tree: Expr, working: Working) -> Expr:
    """With the values of all names."""
    return replace(tree, {name: value for name, value in working.values.items() if name != value})


def _filled(span: Span, working: Working) -> Span:
    values = tuple(_value(c, working) for c in span.coefficients)
    return Span(_value(span.start, working), _value(span.end, working), values)


def _laws(found: Blended, working: Working) -> tuple[Expr, ...]:
    """q of t in the three pieces, with numbers where there are."""
    if found.open:
        return tuple(_put_in(tree, working) for tree in found.laws())
    push = Quotient(A, number(2))
    through = subtract(found.start, Quotient(Product((V, T_B)), number(2)))
    left = subtract(_value(found.T, working), t)
    return (
        add(_value(found.start, working), term(_value(push, working), t, 2)),
        add(_value(through, working), term(_value(V, working), t, 1)),
        add(_value(found.end, working), term(_value(negate(push), working), left, 2)),
    )


def _value(tree: Expr, working: Working) -> Expr:
    """Worked out where it is a number, with all names put in where it is not."""
    put_in = _put_in(tree, working)
    return put_in if free_symbols(working.problem.final(put_in)) else working.value(tree)


def _piece_steps(named_laws: tuple[Expr, ...], laws: tuple[Expr, ...], open_: bool) -> tuple[Step, ...]:
    """Each law in names, and with numbers where there are."""
    steps = []
    for k, (tree, filled) in enumerate(zip(named_laws, laws, strict=True), 1):
        numbers = () if open_ else (filled,)
        steps.append(Step(f"piece_{k}", (q, tree, *numbers)))
    return tuple(steps)


def _ends_of(found: Blended, working: Working) -> tuple[Claim, Claim]:
    last = found.spans()[-1]
    length = working.scalar(T_B)
    there = last.derivative(working, length, 0) == working.scalar(found.end)
    return law("q ends at the end", there), law(
        "the velocity ends at zero", last.derivative(working, length, 1) == 0
    )


def _covers(results: Mapping[str, Expr], journey: Journey, problem: Problem) -> bool:
    """In floats: the trapezoid under the velocity, and its slope."""
    trees = [results[name] for name in ("t_b", "v", "a", "t_f")]
    trees += [problem.final(each) for each in (journey.start, journey.end)]
    names = sorted(frozenset().union(*map(free_symbols, trees)))
    for point in random_points(names, 5) if names else iter([{}]):
        try:
            t_b, v, a, t_f, start, end = (value_of(tree, point) for tree in trees)
        except ValueError:
            continue  # the time is too short at this random point
        if not close([v * (t_f - t_b), a * t_b], [end - start, v], 1e-7):
            return False
    return True


# -- what the page needs ------------------------------------------------------------------------------


def _evaluated(
    results: Mapping[str, Expr], course: Course | None, evaluate: Place | None, problem: Problem
) -> dict[str, Any]:
    if evaluate is None or course is None:
        return {}
    point = {name: value_of(value, {}) for name, value in evaluate}
    return {name: value_of(tree, point) for name, tree in results.items()} | q_at(course, evaluate)


def _plots(course: Course | None, profile: Profile, problem: Problem) -> tuple[Any, ...]:
    if course is None:
        return ()
    kept = tuple(piece for piece in course if piece.end > piece.start)
    limits = limits_drawn(profile, problem)
    return (panels("lspb", {"": kept}, profile.sort, problem.style.degrees, limits),)


def _facts(
    found: Blended,
    spans: tuple[Span, ...],
    profile: Profile,
    course: Course | None,
    problem: Problem,
    evaluate: Place | None,
) -> dict[str, Any]:
    working, way, T = found.working, found.way, found.T
    steps = tuple(step.name for step in working.steps)
    ratio = Quotient(way, T)
    return {
        "given": tuple((n, value, found.rates[n]) for n, value in working.given if n in found.rates),
        "backwards": False,
        "units": profile.units,
        "by": found.by,
        "lines": steps,
        "way": way, "T": T, "name": found.given, "V": V, "a": A, "t_b": T_B,
        "area": (way, Product((V, subtract(T, T_B)))),
        "between": (ratio, Quotient(Product((number(2), way)), T)),
        "least": Quotient(Product((number(4), way)), squared(T)),
        "half": Quotient(T, number(2)),
        "open": found.open,
        "bounds": tuple((each.start, each.end) for each in found.spans()),
        "plateau": working.sign(subtract(T, Product((number(2), T_B)))) != 0,
        "zero": number(0),
        "drawn": course is not None,
        **limits_told(profile, course, problem, evaluate),
    }  # fmt: skip
