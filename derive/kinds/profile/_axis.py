"""One axis solved: its cases, and how they are told."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from derive.derivation import Phrase, Record, Said, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Relation, Symbol
from derive.kinds.problem import Problem
from derive.kinds.profile._trapezoid import T_1, T_2, T_M, Given, Outcome, begun, shortest, timed
from derive.mechanics.profile import Axis, Profile

SHORTEST = (
    "the time is too short for some values of the symbols, and the shortest that is possible has not one "
    "formula for all of them; give values under where:"
)


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
    fast = begun(problem, axis, None, profile)
    if time is None:
        return Solved(axis, None, fast, shortest(fast))
    given = begun(problem, axis, time, profile)
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
    """What is said before the lines of a case: how it is decided, what it is; and after them."""

    begins: Phrase
    what: Phrase
    lines: tuple[str, ...]  # steps
    ends: Phrase | None


class AxisTold(Record):
    given: tuple[tuple[Expr, Expr, int | None], ...]  # each with how often it is differentiated
    backwards: Phrase | None
    opening: Phrase
    letters: Phrase | None  # for the peak velocity and the acceleration
    probe: str  # a step
    cases: tuple[CaseTold, ...]
    least: Phrase | None  # the time, where that given is too short


def told(each: Solved, prefix: str = "", among: bool = False, again: bool = False) -> AxisTold:
    """What the words read of an axis, with the areas under its velocity as they are quoted; briefly `among`
    others, and without what is given where it comes `again`."""
    given, probe = each.given, each.outcomes[0].probe
    shown = () if again else tuple((name, value, _rate(given, name)) for name, value in given.working.typed)
    least = Phrase("too-short", {"least": Relation(Symbol("t_min"), "=", each.least)})
    return AxisTold(
        given=shown,
        backwards=Phrase("backwards") if given.backwards and not again else None,
        letters=None if again or among else Phrase("letters", _letters(given)),
        opening=_opening(each, among),
        probe=f"{prefix}{probe.name}" if probe else "",
        cases=tuple(_case(each, outcome, prefix, among) for outcome in each.outcomes),
        least=least if each.infeasible and not among else None,
    )


def _letters(given: Given) -> dict[str, Said]:
    return {"peak": given.working.symbol("v"), "slope": given.working.symbol("a")}


def _opening(each: Solved, among: bool) -> Phrase:
    given = each.given
    if each.time is not None:
        return Phrase("triangle-among" if among else "triangle-first", {} if among else {"time": given.t_3})
    if among:
        return Phrase("ramps-among", {"fastest": given.fastest})
    ramp = given.fastest / given.strongest
    names = {"until": T_1, "after": T_2, "rest": Symbol("t_3")}
    return Phrase("ramps", {**names, "strongest": given.strongest, "fastest": given.fastest, "ramp": ramp})


def _case(each: Solved, outcome: Outcome, prefix: str, among: bool) -> CaseTold:
    several, given = len(each.outcomes) > 1, each.given
    border = given.fastest if each.time is not None else given.d
    fits = outcome.plateau == (each.time is None)
    begins = Phrase("equal" if outcome.just else "at-most" if fits else "more-than", {"border": border})
    return CaseTold(
        begins=Phrase("if", {"when": outcome.when[0]}) if several else begins,
        what=_what(each, outcome),
        lines=tuple(_name(each, outcome, step, prefix) for step in outcome.working.steps),
        ends=_ends(each, outcome, outcome.when[1:] if several else outcome.when, among),
    )


def _what(each: Solved, outcome: Outcome) -> Phrase:
    """The profile of a case, and the area by which it is found."""
    given, v = each.given, each.given.working.symbol("v")
    about: dict[str, Said] = {"fastest": given.fastest}
    match each.time is None, outcome.plateau:
        case True, True:
            area = Relation(given.d, "=", given.fastest * T_2)
            return Phrase("room-or-none" if outcome.when else "room", {**about, "area": area, "after": T_2})
        case True, False:
            half = Relation(given.d / 2, "=", given.strongest * T_1**2 / 2)
            return Phrase("just-room" if outcome.just else "no-room", {**about, "area": half})
        case False, True:
            area = Relation(given.d, "=", v * (given.t_3 + T_M) / 2)
            return Phrase("plateau", {**about, "between": T_M, "area": area})
    return Phrase("triangle")


def _ends(each: Solved, outcome: Outcome, left: tuple[Relation, ...], among: bool) -> Phrase | None:
    """Why a case cannot be kept, or when it can."""
    if outcome.too_fast:
        return Phrase("too-fast", {"fastest": each.given.fastest})
    if outcome.case == "infeasible":
        return Phrase("too-strong", {"strongest": each.given.strongest})
    timed = each.time is not None and not among
    if timed and each.axis.a_max is not None and len(each.outcomes) == 1 and not left:
        return Phrase("within", {"strongest": each.given.strongest})
    return Phrase("kept-where", {"conditions": left}) if left else None


def _rate(given: Given, name: Expr) -> int | None:
    """0 for the distance, 1 for the velocity, 2 for the acceleration; None for the time."""
    return {given.d: 0, given.fastest: 1, given.strongest: 2}.get(name) if isinstance(name, Symbol) else None


def rates_of(*axes: Solved) -> dict[Expr, int | None]:
    """How often each given quantity is differentiated; None for a time."""
    return {name: _rate(each.given, name) for each in axes for name, _ in each.given.working.typed}


def _name(each: Solved, outcome: Outcome, step: Step, prefix: str) -> str:
    case = f"{outcome.case}_" if len(each.outcomes) > 1 else ""
    return f"{prefix}{case}{step.name}"
