"""One axis solved: its cases, how they are told, and what they are held to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import inf
from typing import TypeAlias

from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Claim, Phrase, Record, Step
from derive.expression import Expr, Relation, Symbol, symbols
from derive.kinds.checks import SECOND_ROUTE, close, random_points
from derive.kinds.problem import Problem
from derive.kinds.profile._trapezoid import Given, Outcome, begun, shortest, timed
from derive.mechanics import trapezoid
from derive.mechanics.profile import Axis, Profile

TRIES = 60
Equation: TypeAlias = tuple[Expr, Expr]


@dataclass(frozen=True, slots=True)
class Solved:
    """What was given, and every case that is left open; `fastest` where a time was given."""

    axis: Axis
    time: Expr | None
    given: Given
    outcomes: tuple[Outcome, ...]
    fastest: tuple[Outcome, ...] = ()

    @property
    def problem(self) -> Problem:
        return self.given.working.problem

    @property
    def open(self) -> bool:
        """Whether symbols leave the case open, or whether it can be kept at all."""
        return any(outcome.when for outcome in self.outcomes)

    @property
    def infeasible(self) -> bool:
        return any(outcome.case == "infeasible" for outcome in self.outcomes)

    @property
    def least(self) -> Expr:
        """The shortest time that is possible; where the acceleration has no limit, what it stays above."""
        if self.axis.a_max is None:
            working = self.given.working
            return self.problem.final(working.shown(self.given.d / self.given.fastest))
        return (self.fastest or self.outcomes)[0].working.final("t_3")


def solved(axis: Axis, time: Expr | None, profile: Profile, problem: Problem) -> Solved:
    """The fastest way, or the one in a given time."""
    angular = profile.sort == "angle" and problem.style.degrees
    fast = begun(problem, axis, None, angular)
    if time is None:
        return Solved(axis, None, fast, shortest(fast))
    given = begun(problem, axis, time, angular)
    return Solved(axis, time, given, timed(given), () if axis.a_max is None else shortest(fast))


def steps_of(each: Solved, prefix: str = "") -> Iterator[Step]:
    """The comparison that decides, then the lines of each case."""
    if (probe := each.outcomes[0].probe) is not None:
        yield replace(probe, name=f"{prefix}{probe.name}")
    for outcome in each.outcomes:
        for step in outcome.working.steps:
            yield replace(step, name=_name(each, outcome, step, prefix))


class CaseTold(Record):
    case: str
    when: tuple[Relation, ...]
    conditions: tuple[Relation, ...]  # those that do not decide between the cases
    too_fast: bool
    plateau: bool
    lines: tuple[str, ...]  # steps


class AxisTold(Record):
    timed: bool
    given: tuple[tuple[Expr, Expr, int | None], ...]  # each with how often it is differentiated
    backwards: bool
    d: Symbol
    fastest: Symbol
    strongest: Symbol
    t_3: Symbol
    to_fastest: Equation
    area: Equation
    half: Equation
    peak: Equation
    plateau_area: Equation
    open: bool
    infeasible: bool
    least: Equation
    probe: str  # a step
    cases: tuple[CaseTold, ...]


def told(each: Solved, prefix: str = "") -> AxisTold:
    """What the words read of an axis, with the areas under its velocity as they are quoted."""
    given, probe, timed = each.given, each.outcomes[0].probe, each.time is not None
    d, v_M, a_M, t_3 = given.d, given.fastest, given.strongest, given.t_3
    v, (t_1, t_2, t_m) = given.working.symbol("v"), symbols("t_1 t_2 t_m")
    last = t_3 if timed else Symbol("t_3")
    cases = (
        CaseTold(
            case=outcome.case,
            when=outcome.when,
            conditions=outcome.when[1 if len(each.outcomes) > 1 else 0 :],
            too_fast=outcome.too_fast,
            plateau=outcome.plateau,
            lines=tuple(_name(each, outcome, step, prefix) for step in outcome.working.steps),
        )
        for outcome in each.outcomes
    )
    return AxisTold(
        timed=timed,
        given=tuple((name, value, _rate(given, name)) for name, value in given.working.typed),
        backwards=given.backwards,
        d=d,
        fastest=v_M,
        strongest=a_M,
        t_3=t_3,
        to_fastest=(t_1, v_M / a_M),
        area=(d, v_M * t_2),
        half=(d / 2, a_M * t_1**2 / 2),
        peak=(v, 2 * d / last),
        plateau_area=(d, v * (last + t_m) / 2),
        open=each.open,
        infeasible=each.infeasible,
        least=(Symbol("t_min"), each.least),
        probe=f"{prefix}{probe.name}" if probe else "",
        cases=tuple(cases),
    )


def _rate(given: Given, name: Expr) -> int | None:
    """0 for the distance, 1 for the velocity, 2 for the acceleration; None for the time."""
    return {given.d: 0, given.fastest: 1, given.strongest: 2}.get(name) if isinstance(name, Symbol) else None


def _name(each: Solved, outcome: Outcome, step: Step, prefix: str) -> str:
    case = f"{outcome.case}_" if len(each.outcomes) > 1 else ""
    return f"{prefix}{case}{step.name}"


# -- what it is held to -------------------------------------------------------------------------------


def claims_about(each: Solved) -> Iterator[Claim]:
    """The lines by normal form; the answer against a search that knows no formula."""
    for outcome in each.outcomes:
        for claim in outcome.working.linked().claims:
            yield claim.within("in-case", case=Phrase(outcome.case))
    key = "no-time-is-shorter" if each.time is None else "no-acceleration-is-smaller"
    yield Claim("too-short" if each.infeasible else key, SECOND_ROUTE, _found_by_search(each))


def _found_by_search(each: Solved) -> bool:
    """At the numbers given, or at random ones; symbols that leave a case open are tried in every case."""
    symbols = sorted(each.problem.symbols)
    points = random_points(symbols, TRIES)
    return all(_agrees(each, point) for point in points)


def _agrees(each: Solved, point: Mapping[str, float]) -> bool:
    def at(expr: Expr) -> float:
        return value_of(each.problem.final(expr), point)

    axis = each.axis
    way, v_max, a_max = at(axis.distance), at(axis.v_max), inf if axis.a_max is None else at(axis.a_max)
    d = -way if each.given.backwards else way
    if min(d, v_max, a_max) <= 0:
        return True
    least = trapezoid.searched_time(d, v_max, a_max)
    t_3 = None if each.time is None else at(each.time)
    if t_3 is not None and t_3 < least * (1 - 1e-9):
        return each.infeasible or each.open
    case = trapezoid.shortest(d, v_max, a_max) if t_3 is None else trapezoid.timed(d, v_max, a_max, t_3)
    outcome = next((one for one in each.outcomes if one.case == case.case), None)
    if outcome is None:
        return False
    values = {name: value_of(tree, point) for name, tree in outcome.values.items()}
    found = trapezoid.Switching(case.case, **values)
    best = (found.t_3, least) if t_3 is None else (found.a, trapezoid.searched_acceleration(d, v_max, t_3))
    return _moves(found, d, v_max, a_max) and close(*best, tolerance=1e-6)


def _moves(found: trapezoid.Switching, d: float, v_max: float, a_max: float) -> bool:
    """Over the distance, from rest to rest, within both limits."""
    course = trapezoid.course(found)
    ends = course[-1].at(course[-1].end), course[-1].at(course[-1].end, 1)
    within = found.v <= v_max * (1 + 1e-9) and found.a <= a_max * (1 + 1e-9)
    return within and close(list(ends), [d, 0.0]) and close(found.a * found.t_1, found.v)
