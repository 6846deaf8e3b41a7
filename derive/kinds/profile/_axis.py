"""One axis solved: its cases, and how they are told."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TypeAlias

from derive.derivation import Record, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Relation, Symbol, symbols
from derive.kinds.problem import Problem
from derive.kinds.profile._trapezoid import Given, Outcome, begun, shortest, timed
from derive.mechanics.profile import Axis, Profile

SHORTEST = (
    "the time is too short for some values of the symbols, and the shortest that is possible has not one "
    "formula for all of them; give values under where:"
)
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
    """The fastest way, or the one in a given time. Raises NotDerivable where that is too short, and symbols
    leave open which time would do."""
    angular = profile.sort == "angle" and problem.style.degrees
    fast = begun(problem, axis, None, angular)
    if time is None:
        return Solved(axis, None, fast, shortest(fast))
    given = begun(problem, axis, time, angular)
    found = Solved(axis, time, given, timed(given), () if axis.a_max is None else shortest(fast))
    if found.infeasible and len(found.fastest) > 1:
        raise NotDerivable(SHORTEST)
    return found


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
