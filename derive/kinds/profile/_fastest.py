"""The shortest time of all: that of the trapezoidal or triangular profile, and the limits it meets."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, isclose

from derive.algebra.numbers.floats import completed
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Branch, Derivation, Phrase, Result, Step
from derive.errors import NotDerivable
from derive.expression import Relation, Symbol
from derive.kinds.checks import random_points, route
from derive.kinds.fields import TREES, Place
from derive.kinds.problem import Problem
from derive.kinds.profile._minimum_told import (
    NUMBERS,
    Bound,
    CaseTold,
    Facts,
    Outcome,
    at_point,
    begins,
    evaluated_of,
    met_of,
    results_of,
)
from derive.kinds.profile._shapes import TIME
from derive.kinds.profile._units import units_of
from derive.kinds.work import Work
from derive.mechanics import trapezoid
from derive.mechanics.profile import Profile

T_3 = Symbol("t_3")
NAMES = ("t_3", "v", "a")  # of the profile
REACHED = {"trapezoidal": (1, 2), "triangular": (2,)}  # what reaches its limit in each case
WIDER = 1.01  # than a limit
LOOSE = 1e-6
POINTS = 20
Sizes = tuple[float, float, float]  # of the distance and of both limits


def fastest(profile: Profile, evaluate: Place | None, problem: Problem) -> Derivation:
    """What is asked of the profile, as a time (Siciliano et al., section 4.2.1). Raises NotDerivable without
    both limits."""
    if not profile.axes:
        raise NotDerivable("a distance and both limits are needed: v_max: ..., a_max: ...")
    base = problem.ask("trapezoidal-profile", evaluate=evaluate)
    outcomes = tuple(_outcomes(base, profile, problem))
    met = met_of(outcomes, evaluate, problem)
    work = Work(problem, uses=(base,), units=units_of(profile, {TIME: None}))
    cases = []
    for each in outcomes:
        label, time = f"T_{len(each.active)}" if each.when else "T", each.values["time"]
        if each.when:
            work = work.showing(Step(label, (TIME, time)))
        else:
            work = work.knowing({T_3: time}).line(TIME, T_3, value=time, label=label)
        cases.append(CaseTold(begins=begins(each, "profile"), lines=(label,)))
    open_ = evaluate and len(outcomes) > 1
    facts = Facts(
        cases=tuple(cases),
        numbers=NUMBERS,
        page_names={"time": TIME},
        at_point=at_point(outcomes[met]) if open_ else None,
    )
    work = work.claim(
        route("no-time-is-shorter", _no_shorter(profile, outcomes, problem)),
        route("binding-limits", _binding(profile, outcomes, problem)),
    )
    evaluated = evaluated_of(outcomes[met], evaluate, problem)
    return work.answer("minimum-time", results_of(outcomes, met), facts, evaluated=evaluated)


def _outcomes(base: Derivation, profile: Profile, problem: Problem) -> Iterator[Outcome]:
    """The cases of the profile, one for several axes."""
    found, solutions = base.results, base.results.get("solutions", ())
    for case, branch in zip(REACHED, solutions if isinstance(solutions, tuple) else (), strict=False):
        if isinstance(branch, Branch):
            values = {ours: branch.values[name] for ours, name in zip(NUMBERS, NAMES, strict=True)}
            yield Outcome(tuple((0, rate) for rate in REACHED[case]), values, _when(branch))
    if solutions:
        return
    values = {
        ours: tree
        for ours, name in zip(NUMBERS, NAMES, strict=True)
        if isinstance(tree := found[name], TREES)
    }
    yield Outcome(tuple(_active(profile, found["case"], problem)), values)


def _when(branch: Branch) -> tuple[Relation, ...]:
    """The comparisons in what is said of a case."""
    said = [condition.about["when"] for condition in branch.when if isinstance(condition, Phrase)]
    return tuple(
        each for parts in said if isinstance(parts, tuple) for each in parts if isinstance(each, Relation)
    )


def _active(profile: Profile, case: Result, problem: Problem) -> Iterator[Bound]:
    """Of several axes those of the slowest."""
    if isinstance(case, str):
        yield from ((0, rate) for rate in REACHED[case])
        return
    cases = case if isinstance(case, tuple) else ()
    alone = [trapezoid.shortest(*sizes) for sizes in _sizes(profile, problem, {})]
    longest = max(each.t_3 for each in alone)
    for k, (each, own) in enumerate(zip(alone, cases, strict=True), 1):
        if isclose(each.t_3, longest, rel_tol=1e-9):
            yield from ((k, rate) for rate in REACHED[str(own)])


# -- by search ----------------------------------------------------------------------------------------


def _sizes(profile: Profile, problem: Problem, at: dict[str, float]) -> list[Sizes]:
    """Distance and limits of every axis in numbers."""
    point = completed(at, problem.where)
    return [
        (
            abs(value_of(axis.distance, point)),
            value_of(axis.v_max, point),
            inf if axis.a_max is None else value_of(axis.a_max, point),
        )
        for axis in profile.axes
    ]


def _tried(
    profile: Profile, outcomes: tuple[Outcome, ...], problem: Problem
) -> Iterator[tuple[list[Sizes], list[Outcome], dict[str, float]]]:
    """Points where every size is positive, and the cases that are said to be met there."""
    for at in random_points(problem.symbols, POINTS):
        known = dict(completed(at, problem.where))
        sizes = _sizes(profile, problem, known)
        if all(min(each) > 0 for each in sizes):
            yield sizes, [each for each in outcomes if each.is_met(known)], known


def _no_shorter(profile: Profile, outcomes: tuple[Outcome, ...], problem: Problem) -> Iterator[bool]:
    """Whether the time that is told is the least that a search over all peak velocities finds."""
    for sizes, met, known in _tried(profile, outcomes, problem):
        least = max(trapezoid.searched_time(*each) for each in sizes)
        times = [value_of(each.values["time"], known) for each in met]
        yield len(times) == 1 and isclose(times[0], least, rel_tol=LOOSE)


def _binding(profile: Profile, outcomes: tuple[Outcome, ...], problem: Problem) -> Iterator[bool]:
    """Whether just the limits are told which, were they wider, would let the slowest axes be faster."""
    for sizes, met, _ in _tried(profile, outcomes, problem):
        times = [trapezoid.searched_time(*each) for each in sizes]
        binding = {
            (k if len(sizes) > 1 else 0, rate)
            for k, (d, v, a) in enumerate(sizes, 1)
            if isclose(times[k - 1], max(times), rel_tol=LOOSE)
            for rate, wider in ((1, (d, WIDER * v, a)), (2, (d, v, WIDER * a)))
            if trapezoid.searched_time(*wider) < times[k - 1] * (1 - LOOSE)
        }
        yield len(met) == 1 and {*met[0].active} == binding
