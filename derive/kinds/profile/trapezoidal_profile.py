"""The trapezoidal or triangular velocity profile over a distance, the fastest one or in a given time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import inf, isclose
from typing import Any

from derive.algebra.infix import text
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Branch, Claim, Derivation, Figure, Label, PageFacts, Phrase, Result
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, is_negative
from derive.figures.courses import panels
from derive.kinds.checks import close, law, route
from derive.kinds.fields import TREES, Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.profile._axis import AxisTold, Solved, rates_of, solved, steps_of, told
from derive.kinds.profile._axis_checks import claims_about
from derive.kinds.profile._together import TogetherTold, together
from derive.kinds.profile._trapezoid import NAMES, Outcome
from derive.kinds.profile._units import units_of
from derive.kinds.sure import place
from derive.kinds.values_at import point_of
from derive.mechanics import trapezoid
from derive.mechanics.course import Course, at
from derive.mechanics.profile import Axis, Profile, Units

CLAIMED = dict.fromkeys(("a", "solutions", "t_1", "t_2", "t_3", "t_min", "v"), "as-told|on-axis|too-short")

NEEDS = ("limits",)
NEARLY = 1e-6  # of times that are searched for
Found = tuple[trapezoid.Switching, ...]


class Options(OptionsModel):
    """Where symbols stand for the distance and the limits, `evaluate` draws the profile at a point."""

    evaluate: Evaluation = None


class Facts(PageFacts):
    units: Units
    axis: AxisTold | None = None
    together: TogetherTold | None = None
    drawn: bool
    at_point: Phrase | None  # the case there


def claims_of(profile: Profile, options: Options) -> tuple[str, ...]:
    """The keys of what is claimed; of several axes for each of them."""
    if len(profile.axes) > 1:
        return ("axis-alone", "on-axis", "slowest")
    return ("in-case", "as-told", "no-time-is-shorter|no-acceleration-is-smaller|time-too-short")


def derive(profile: Profile, options: Options, problem: Problem) -> Derivation:
    """The switching times t_1, t_2, t_3 (Khatib's notes; Siciliano et al., section 4.2.1).

    Raises NotDerivable where the slowest of several axes cannot be told.
    """
    if len(profile.axes) > 1:
        return _several(profile, options, problem)
    each = solved(profile.axes[0], profile.time, profile, problem)
    found = _numbers(profile, profile.time, options, problem)
    facts = replace(_facts(profile, found, options), axis=told(each))
    case = found[0].case if found and options.evaluate else ""
    met = next((k for k, one in enumerate(each.outcomes) if one.case == case), 0)
    steps, results, axis = tuple(steps_of(each)), _results(each, met), facts.axis or told(each)
    by_name = {step.name: step for step in steps}
    told_again = {name: (tree,) for name, tree in results.items() if isinstance(tree, TREES)}
    claims = claims_about(each, by_name, axis, told_again, met)
    return Derivation(
        "trapezoidal-profile",
        steps,
        results,
        (*claims, *_drawn_again(profile, facts, options, problem, found)),
        each.outcomes[0].working.definitions,
        _evaluated(found, options),
        plots=_plots(profile, found, problem),
        facts=facts,
        units=units_of(profile, rates_of(each)),
    )


def _several(profile: Profile, options: Options, problem: Problem) -> Derivation:
    all_axes = together(profile, problem)
    found = _numbers(profile, all_axes.time, options, problem)
    facts = replace(_facts(profile, found, options), together=all_axes.told())
    return Derivation(
        "trapezoidal-profile",
        all_axes.steps,
        all_axes.results(),
        (
            *all_axes.claims(facts.together or all_axes.told()),
            *_drawn_again(profile, facts, options, problem, found),
        ),
        evaluated=_evaluated(found, options),
        plots=_plots(profile, found, problem),
        facts=facts,
        units=units_of(profile, rates_of(*all_axes.alone, *all_axes.axes)),
    )


def _results(each: Solved, met: int) -> dict[str, Result]:
    """The values are those of the case that is met at the point asked for, else of the first."""
    first = each.outcomes[met]
    if each.infeasible:
        return {"case": "infeasible", "t_min": each.least}
    if not each.open:
        return {"case": first.case, **first.values}
    case, *other = (_said("case-if", outcome) for outcome in each.outcomes)
    branches = tuple(Branch(outcome.values, (_said("case-when", outcome),)) for outcome in each.outcomes)
    case = Phrase("either", {"first": case, "other": other[0]}) if other else case
    return {"case": case, **first.values, "solutions": branches}


def _said(key: str, outcome: Outcome) -> Phrase:
    return Phrase(key, {"case": Phrase(outcome.case), "when": outcome.when})


# -- in numbers ---------------------------------------------------------------------------------------


def _numbers(profile: Profile, time: Expr | None, options: Options, problem: Problem) -> Found | None:
    """Every axis in floats; None where something is left open."""
    try:
        point = point_of(dict(options.evaluate or ()), problem.where)
        t_3 = None if time is None else value_of(time, point)
        return tuple(_switching(axis, t_3, point) for axis in profile.axes)
    except KeyError:
        return None


def _switching(axis: Axis, time: float | None, point: Mapping[str, float]) -> trapezoid.Switching:
    d, v = (value_of(expr, point) for expr in (axis.distance, axis.v_max))
    a = inf if axis.a_max is None else value_of(axis.a_max, point)
    if d == 0 or v <= 0 or a <= 0:
        raise NotDerivable(
            "a distance that is not zero and positive limits are needed at the point", "evaluate"
        )
    return trapezoid.shortest(abs(d), v, a) if time is None else trapezoid.timed(abs(d), v, a, time)


def _evaluated(found: Found | None, options: Options) -> dict[str, Any]:
    """Of several axes lists, but for the time they share."""
    if found is None or options.evaluate is None:
        return {}
    if any(each.case == "infeasible" for each in found):
        return {"case": "infeasible"}
    names = ("case", *NAMES)
    if len(found) == 1:
        return {name: getattr(found[0], name) for name in names}
    return {name: [getattr(each, name) for each in found] for name in names} | {"t_3": found[0].t_3}


def _drawn_again(
    profile: Profile, facts: Facts, options: Options, problem: Problem, drawn: Found | None
) -> Iterator[Claim]:
    """Whether there is a picture, what is marked on it, and the case at the point asked for, by search; where
    numbers say it."""
    point = place({**problem.where, **dict(options.evaluate or ())})
    try:
        time = None if profile.time is None else value_of(profile.time, point)
        found = [_searched(axis, time, point) for axis in profile.axes]
    except KeyError:
        yield law("drawn", (not facts.drawn, not facts.at_point))
        return
    feasible = all(each.case != "infeasible" for each in found)
    at_point = found[0].case if options.evaluate else ""
    case = facts.at_point.about["case"] if facts.at_point else None
    said = case.key if isinstance(case, Phrase) else ""
    border = found[0].t_2 - found[0].t_1 <= trapezoid.FLAT * found[0].t_3 and said != "infeasible"
    yield route("drawn", (facts.drawn == feasible, said == at_point or border))
    if feasible and drawn:
        whole = max(each.t_3 for each in found) if time is None else time
        together = found if len(found) == 1 else [_searched(axis, whole, point) for axis in profile.axes]
        yield route("marked", _switch_there(together, _moments(drawn)))
        sizes = [abs(value_of(axis.distance, point)) for axis in profile.axes]
        yield route("marked", _drawn_so(drawn, together, sizes))


def _switch_there(searched: Sequence[trapezoid.Switching], marked: Mapping[Expr, float]) -> Iterator[bool]:
    """Whether every axis switches at the times that are marked."""
    for name, time in marked.items():
        yield from (close(getattr(each, text(name)), time, NEARLY) for each in searched)


def _drawn_so(
    drawn: Found, searched: Sequence[trapezoid.Switching], sizes: Sequence[float]
) -> Iterator[bool]:
    """Whether what is drawn of every axis is as fast and as strong, and goes as far."""
    for each, other, size in zip(drawn, searched, sizes, strict=True):
        way = trapezoid.course(each)
        yield close([each.v, each.a, at(way, way[-1].end)], [other.v, other.a, size], NEARLY)


def _searched(axis: Axis, time: float | None, point: Mapping[str, float]) -> trapezoid.Switching:
    d, v = (value_of(expr, point) for expr in (axis.distance, axis.v_max))
    return trapezoid.searched(abs(d), v, inf if axis.a_max is None else value_of(axis.a_max, point), time)


def _facts(profile: Profile, found: Found | None, options: Options) -> Facts:
    """Whether there is a picture, and of which case at the point asked for."""
    feasible = found is not None and all(each.case != "infeasible" for each in found)
    asked = found is not None and options.evaluate is not None and len(found) == 1
    at_point = Phrase("at-point", {"case": Phrase(found[0].case)}) if found and asked else None
    return Facts(units=profile.units, drawn=feasible, at_point=at_point, numbers=NAMES)


def _plots(profile: Profile, found: Found | None, problem: Problem) -> tuple[Figure, ...]:
    if found is None or any(each.case == "infeasible" for each in found):
        return ()
    courses: dict[Label, Course] = {}
    for k, (axis, each) in enumerate(zip(profile.axes, found, strict=True), 1):
        courses[Phrase("axis-number", {"k": k})] = trapezoid.course(each, 0.0, _direction(axis, problem))
    return (panels("profile", courses, profile.sort, problem.style.degrees, _moments(found)),)


def _moments(found: Found) -> dict[Expr, float]:
    """Of several axes those that they share."""
    first, *others = found
    shared = (
        name
        for name in ("t_1", "t_2", "t_3")
        if all(isclose(getattr(each, name), getattr(first, name)) for each in others)
    )
    return {Symbol(name): getattr(first, name) for name in shared}


def _direction(axis: Axis, problem: Problem) -> float:
    try:
        return -1.0 if value_of(problem.final(axis.distance), {}) < 0 else 1.0
    except KeyError:
        return -1.0 if is_negative(axis.distance) else 1.0
