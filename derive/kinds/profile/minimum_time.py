"""The shortest time of a motion from rest to rest within its limits, and which of them determines it."""

from __future__ import annotations

from typing import Literal

from derive.derivation import Derivation, Figure
from derive.errors import NotDerivable
from derive.expression import ZERO, Degrees, walk
from derive.figures.courses import panels
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.profile._along.told import fastest_along
from derive.kinds.profile._fastest import fastest
from derive.kinds.profile._fixed_shape import shaped
from derive.kinds.profile._minimum_told import Facts as Facts
from derive.kinds.profile._minimum_told import at_point, evaluated_of, met_of, results_of
from derive.kinds.profile._shape_told import claims_of as claims_of_shape
from derive.kinds.profile._shape_told import courses_of, drawn, facts_of, steps_of
from derive.kinds.profile._shapes import TIME
from derive.kinds.profile._switched_told import fastest_between
from derive.kinds.profile._units import sort_at
from derive.kinds.values_at import point_of
from derive.mechanics.profile import Profile

USES = frozenset({"start_velocity", "end_velocity"})
NO_PATH = "no path is given: profile: {path: [..], a_max: [..]}"
ONLY_PATH = "along a path that is given the motion is found with law: path"
CLAIMED = dict.fromkeys(
    ("time", "v_peak", "a_peak", "solutions", "t_1", "t_2", "v"), "as-told|no-time-is-shorter"
)
CLAIMED |= dict.fromkeys(("t", "parameter"), "limits-kept")


class Options(OptionsModel):
    """Where symbols stand for the distance and the limits, `evaluate` gives the time at a point and draws the
    motion."""

    law: Literal["cubic", "quintic", "cycloidal", "trapezoidal", "bang-bang", "path"] = "trapezoidal"
    """How the distance is covered; trapezoidal is as fast as the limits allow and may begin and end with a
    velocity, bang-bang needs no limit of that, and path is as fast as the limits allow along a path."""
    evaluate: Evaluation = None


def claims_of(profile: Profile, options: Options) -> tuple[str, ...]:
    """The keys of what is claimed."""
    if profile.path is not None:
        return ("path-lines", "limits-kept", "no-time-is-shorter", "binding-limits")
    if options.law in ("trapezoidal", "bang-bang"):
        return ("no-time-is-shorter", "binding-limits")
    return ("as-told", "right-case", *(("on-axes",) if len(profile.axes) > 1 else ()))


def derive(profile: Profile, options: Options, problem: Problem) -> Derivation:
    """The longest of the times that the limits need (Biagiotti and Melchiorri, chapter 5; Siciliano et al.,
    section 4.2.1; Lynch and Park, section 9.2.2).

    Raises NotDerivable where a time is given, and where the slowest of several axes cannot be told.
    """
    if (profile.path is None) == (options.law == "path"):
        raise NotDerivable(NO_PATH if profile.path is None else ONLY_PATH, "law")
    if profile.path is not None:
        return fastest_along(profile.path, options.evaluate, problem)
    if profile.time is not None:
        raise NotDerivable("the time is what is looked for, and one is given; leave it out", "time")
    journey = profile.journey
    moving = journey is not None and not (journey.begins_at_rest and journey.ends_at_rest)
    if options.law == "trapezoidal" or options.law == "bang-bang":
        if moving or (options.law == "bang-bang" and not profile.axes):
            return fastest_between(profile, options.evaluate, problem)
        return fastest(profile, options.evaluate, problem)
    if moving or options.law == "path":
        raise NotDerivable("a motion by this law begins and ends at rest; law: bang-bang need not", "law")
    each = shaped(options.law, profile, problem)
    outcomes = tuple(case.outcome for case in each.cases)
    met = met_of(outcomes, options.evaluate, problem)
    point = point_of(dict(options.evaluate or ()), problem.where)
    start = profile.journey.start if profile.journey else ZERO
    known = options.evaluate or len(outcomes) == 1
    courses = courses_of(each, each.cases[met], point, start) if known else {}
    open_ = options.evaluate and len(outcomes) > 1
    facts = facts_of(each, profile, at_point(outcomes[met]) if open_ else None, bool(courses))
    steps = tuple(steps_of(each))
    plots: tuple[Figure, ...] = ()
    claims = [*claims_of_shape(each, facts, steps, profile), drawn(facts.drawn, courses, profile, point)]
    if courses:
        end = next(iter(courses.values()))[-1].end
        typed = any(isinstance(node, Degrees) for _, tree in options.evaluate or () for node in walk(tree))
        turned = problem.style.degrees or typed
        plots = (panels("motion", courses, sort_at(profile, options.evaluate), turned, {TIME: end}),)
    return Derivation(
        "minimum-time",
        steps,
        results_of(outcomes, met),
        tuple(claims),
        each.base.definitions,
        evaluated_of(outcomes[met], options.evaluate, problem),
        plots=plots,
        facts=facts,
        units=dict(each.base.units),
    )
