"""One axis by its trapezoidal or triangular profile: every case that its numbers or symbols leave open."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from derive.derivation import Step
from derive.expression import Expr, Relation, Symbol, free_symbols, is_negative, sqrt, symbols
from derive.expression import replace as replaced
from derive.kinds.problem import Problem
from derive.kinds.profile._units import units_of
from derive.kinds.work import Work
from derive.mechanics.profile import Axis, Profile
from derive.names import named

T_1, T_2, T_M = symbols("t_1 t_2 t_m")
RENAMED = frozenset({"v", "a"})  # answers that make way for an author's own symbols
NAMES = ("t_1", "t_2", "t_3", "v", "a")


@dataclass(frozen=True, slots=True)
class Given:
    """The names of the distance, the limits (that of the acceleration may be none in a given time) and the
    time, and the working they begin."""

    d: Symbol
    fastest: Symbol
    strongest: Symbol
    t_3: Symbol
    working: Work
    backwards: bool = False


@dataclass(frozen=True, slots=True)
class Outcome:
    """A case with its working; `when` is the condition that symbols leave open."""

    case: str
    working: Work
    when: tuple[Relation, ...] = ()
    probe: Step | None = None  # the comparison that decided for it
    too_fast: bool = False  # infeasible because even the greatest velocity does not suffice
    plateau: bool = True
    just: bool = False  # a triangle whose peak is the greatest velocity

    @property
    def values(self) -> dict[str, Expr]:
        return {name: self.working.final(name) for name in NAMES}


def begun(problem: Problem, axis: Axis, time: Expr | None, profile: Profile) -> Given:
    """The given quantities under their names; a distance backwards is counted as its size."""
    angular = profile.sort == "angle" and problem.style.degrees
    bare = Work(problem, {}, angular)
    sign = bare.sign(axis.distance)
    backwards = sign == -1 or (sign is None and is_negative(axis.distance))
    size = bare.shown(-axis.distance) if backwards else axis.distance
    d = named("d", size, problem.taken)
    values: dict[Expr, Expr] = {d: size}
    v_M = named("v_M", axis.v_max, problem.taken)
    values[v_M] = axis.v_max
    a_M = Symbol("a_M")
    if axis.a_max is not None:
        a_M = named("a_M", axis.a_max, problem.taken)
        values[a_M] = axis.a_max
    t_3 = Symbol("t_3")
    if time is not None:
        t_3 = named("t_3", time, problem.taken)
        values[t_3] = time
    units = units_of(profile, {d: 0, v_M: 1, a_M: 2, t_3: None})
    working = Work(problem, values, angular, RENAMED & problem.symbols, units)
    return Given(d, v_M, a_M, t_3, working, backwards)


# -- in the shortest time -----------------------------------------------------------------------------


def shortest(given: Given) -> tuple[Outcome, ...]:
    """With a plateau where there is room for it, else a triangle; one that just reaches v_M has none."""
    d, v_M, a_M, working = given.d, given.fastest, given.strongest, given.working
    ramps = v_M**2 / a_M
    probe = working.worked("ramps", ramps).steps[-1]
    probe = replace(probe, chain=probe.chain[1:])
    room = working.sign(d - ramps)
    left, right = (_condition(working, side) for side in (ramps, d))
    with_plateau = Outcome("trapezoidal", _fast_trapezoid(given), (Relation(left, "<=", right),), probe)
    without = Outcome(
        "triangular", _fast_triangle(given), (Relation(left, ">", right),), probe, plateau=False
    )
    if room is None:
        return with_plateau, without
    return (replace(with_plateau if room > 0 else without, when=(), just=room == 0),)


def _fast_trapezoid(given: Given) -> Work:
    working = given.working.worked("t_1", given.fastest / given.strongest)
    working = working.worked("t_2", given.d / given.fastest)
    total = working.known[T_2] + working.known[T_1] if free_symbols(working.final("t_2")) else None
    working = working.worked("t_3", T_1 + T_2, total)
    return working.worked("v", given.fastest).worked("a", given.strongest)


def _fast_triangle(given: Given) -> Work:
    """d = a_M t_1^2; with symbols the roots are written as a person writes them."""
    d, a_M, working = given.d, given.strongest, given.working
    full, half, peak = (
        sqrt(4 * d / a_M),
        Symbol("t_3") / 2,
        a_M * T_1,
    )
    if not free_symbols(working.problem.final(working.shown(d / a_M))):
        working = working.worked("t_3", full).worked("t_1", half).worked("t_2", T_1)
        return working.worked("v", peak).worked("a", a_M)
    root = sqrt(working.shown(d / a_M))
    working = working.worked("t_3", full, 2 * root).worked("t_1", half, root).worked("t_2", T_1, root)
    # a sqrt(d/a) is sqrt(a d) for a > 0 only, which the normal form does not know: the search checks it
    working = working.worked("v", peak, sqrt(working.shown(a_M * d)), rule="in-numbers")
    return working.worked("a", a_M)


# -- in a given time ----------------------------------------------------------------------------------


def timed(given: Given) -> tuple[Outcome, ...]:
    """With the least acceleration: a triangle unless its peak is too fast, then a plateau at v_M."""
    d, v_M, t_3, working = given.d, given.fastest, given.t_3, given.working
    peak = 2 * d / t_3
    probe = working.worked("peak", peak).steps[-1]
    probe = replace(probe, chain=probe.chain[1:])
    triangle, trapezoid = _slow_triangle(given), _slow_trapezoid(given)
    left, right = (_condition(working, side) for side in (peak, v_M))
    found = {1: (trapezoid,), 0: (triangle,), -1: (triangle,)}.get(
        2 if (s := working.sign(peak - v_M)) is None else s, (triangle, trapezoid)
    )
    relation = {"triangular": "<=", "trapezoidal": ">"}
    outcomes = []
    for outcome in found:
        own = (Relation(left, relation[outcome.case], right),) if len(found) > 1 else ()
        when = (*own, *outcome.when)
        outcomes.append(_checked(replace(outcome, when=when, probe=probe), given))
    return tuple(outcomes)


def _slow_triangle(given: Given) -> Outcome:
    working = given.working.worked("t_1", given.t_3 / 2).worked("t_2", T_1)
    working = _keep_time(working, given.t_3)
    working = working.worked("v", given.d / T_1).worked("a", working.symbol("v") / T_1)
    return Outcome("triangular", working, plateau=False)


def _slow_trapezoid(given: Given) -> Outcome:
    """The plateau follows from the area, d = v (t_3 + t_m)/2."""
    d, v_M, t_3 = given.d, given.fastest, given.t_3
    working = given.working.worked("v", v_M)
    working = working.worked("t_m", 2 * d / working.symbol("v") - t_3)
    working = working.worked("t_1", (t_3 - T_M) / 2)
    room = working.sign(T_1)
    if room is not None and room <= 0:
        return Outcome("infeasible", working, too_fast=True)
    working = _keep_time(working.worked("t_2", t_3 - T_1), t_3).worked("a", working.symbol("v") / T_1)
    limit = _condition(working, d / v_M)
    when = () if room else (Relation(_condition(working, t_3), ">", limit),)
    return Outcome("trapezoidal", working, when)


def _keep_time(working: Work, t_3: Symbol) -> Work:
    """t_3 is a result under its own name too."""
    values: Mapping[Expr, Expr] = {**working.known, Symbol("t_3"): working.known[t_3]}
    return replace(working, known=values)


def _checked(outcome: Outcome, given: Given) -> Outcome:
    """Infeasible where the acceleration is beyond its limit; a condition where symbols leave that open."""
    if outcome.case == "infeasible" or given.strongest not in given.working.known:
        return outcome
    beyond = outcome.working.sign(outcome.working.symbol("a") - given.strongest)
    if beyond is None:
        limit = Relation(
            _condition(outcome.working, outcome.working.symbol("a")),
            "<=",
            _condition(outcome.working, given.strongest),
        )
        return replace(outcome, when=(*outcome.when, limit))
    return replace(outcome, case="infeasible") if beyond > 0 else outcome


def _condition(working: Work, expr: Expr) -> Expr:
    """A side of a condition, in the symbols of the sheet."""
    shown = replaced(expr, {name: value for name, value in working.known.items() if name != value})
    return working.shown(shown)
