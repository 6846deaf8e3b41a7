"""Joints that follow a path by the inverse kinematics, in closed form."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain
from math import pi, remainder, tau
from typing import Any

from derive.algebra.numbers.compiled import Compiled, compiled
from derive.algebra.numbers.floats import completed
from derive.derivation import Derivation, Phrase, Step
from derive.errors import NotDerivable, NotReal
from derive.expression import Expr, Matrix, Symbol, column, walk
from derive.kinds.checks import random_points, route
from derive.kinds.path._timing import T
from derive.kinds.robot._carried.checks import carries, goes_through, rows_follow
from derive.kinds.robot._carried.facts import Facts
from derive.kinds.robot._carried.followed import MANY, Followed, entries, followed
from derive.kinds.robot._carried.in_time import in_time, lines
from derive.kinds.robot._carried.limits import holds, leaves, ranges_of, said_of_ranges
from derive.kinds.robot._carried.rates import SINGULAR
from derive.kinds.robot._carried.sampled import Sampled, moments, rows_of
from derive.kinds.robot._carried.setting import Setting
from derive.kinds.robot._units import of_variables
from derive.kinds.units import in_degrees
from derive.kinds.values_at import Here, values_at

NO_FORMULA = (
    "the joint variables of this arm are no functions of t that can be written: they rest on the roots of a "
    "polynomial of the fourth degree; write method: inverse-velocity, by which the rates are integrated from "
    "a start"
)
NOT_NEAR = (
    "start chooses the solution that begins nearest to it, and where this path begins is not known in "
    "numbers; give the other names values, or leave start out"
)
TRIES, POINTS = 400, 2
SLACK = 1e-9
NOT_THERE = (ValueError, ZeroDivisionError, OverflowError)
PLAIN = 60  # nodes of a formula that stands on the page
STEEP = 1e7  # of rates over the whole time
Closed = tuple[Matrix, Matrix, Matrix]


def in_closed_form(given: Setting) -> Derivation:
    """By the branch that is wanted. Raises NotDerivable where none of them follows the path."""
    problem, where = given.problem, given.where
    if len(where.rows) != len(problem.subject.variables):
        raise NotDerivable(MANY, "path")
    inverse = problem.ask("inverse-kinematics", given=where.names)
    if "quartic" in inverse.results:
        raise NotDerivable(NO_FORMULA, "method")
    rates = problem.ask("inverse-velocity", rows=where.rows)
    changes = problem.ask("inverse-acceleration", rows=where.rows)
    for each in (inverse, rates, changes):
        given.both.require_own(each.definitions)  # names that are free for the arm may stand in the path
    branches = tuple(followed(inverse, rates, changes, where, given.moving))
    branch, found = _wanted(given, branches)
    steps = tuple(_lines(branch.q))
    board = given.moving.work
    coordinates = dict[Expr, Expr](
        zip(map(Symbol, where.names), entries(board.matrix(given.moving.names[0])), strict=True)
    )
    work = replace(board, aside={**board.aside, **coordinates}).resting_on(inverse, changes)
    closed = branch.closed()
    simple = None if given.driven is not None else in_time(given.both, branch.variables, closed)
    over_time = lines(branch.variables, simple) if simple else ()
    shown = (*steps, *chain(*over_time))
    work = work.showing(*shown).linked(but=[step.name for step in shown])
    told = replace(branch, q={**branch.q, **{_name(step): step.result for step in steps}})
    if over_time:
        q, qdot, qddot = (column(step.result for step in each) for each in over_time)
        closed = q, qdot, qddot
    work = work.claim(route("followed", _holds(given, told, closed)))
    table = None if found is None else found.table(rows_of(found.times))
    if found is not None and table is not None and given.driven is not None:
        work = work.claim(route("as-drawn", rows_follow(where, given.driven, found, given.point)))
        work = work.claim(route("as-tabled", (_is_row(row, told, given) for row in table.rows)))
        work = work.claim(route("as-tabled", goes_through(table, found)))
        work = work.claim(route("as-tabled", _begins_near(found, given)))
    ranges = ranges_of(given) if found is not None else {}
    said = said_of_ranges(found, ranges)
    if said is not None and found is not None:
        work = work.claim(route("ranges-said", holds(said, found, ranges, _placed(given, told, found))))
    facts = Facts(
        way=given.moving.way, place=given.moving.names[0], coordinates=tuple(map(Symbol, where.names)),
        chosen=_chosen(given, branches), when=branch.branch.when, joints=tuple(step.name for step in steps),
        in_time=tuple(tuple(step.name for step in each) for each in over_time),
        table=table, drawn=found is not None, ranges=said,
    )  # fmt: skip
    units: dict[Expr | Phrase, str] = {
        Symbol(name): in_degrees(unit, given.turned) for name, unit in of_variables(problem.subject).items()
    }
    plots = () if found is None else (found.panels(given.turned),)
    results = dict(zip(("q", "qdot", "qddot"), closed, strict=True))
    answer = work.answer(
        "joint-motion", results, facts, plots=plots, units={**units, T: "s"}, in_turn=_in_turn(branch, closed)
    )
    return _evaluated(answer, given, told)


def _in_turn(branch: Followed, closed: Closed) -> dict[str, Expr]:
    """The joint variables and their rates, which long results are written in."""
    columns = zip(("", "_dot"), closed[:2], strict=True)
    return {
        name + end: tree
        for end, column in columns
        for name, tree in zip(branch.variables, entries(column), strict=True)
    }


def _lines(q: Mapping[str, Expr]) -> Iterator[Step]:
    """The joint variables by the coordinates, where these are short; else the page has them already."""
    if all(sum(1 for _ in walk(tree)) <= PLAIN for tree in q.values()):
        for k, (name, tree) in enumerate(q.items(), 1):
            yield Step(f"q_{k}", (Symbol(name), tree), "branch")


def _name(step: Step) -> str:
    head = step.chain[0]
    return head.name if isinstance(head, Symbol) else ""


# -- which branch ------------------------------------------------------------------------------------


def _wanted(given: Setting, branches: Sequence[Followed]) -> tuple[Followed, Sampled | None]:
    """The branch nearest to the start, or the first that follows the path, and it over time."""
    if given.driven is None:
        if given.start:
            raise NotDerivable(NOT_NEAR, "start")
        return branches[0], None
    if (near := given.begun) is not None and given.driven.ends:
        here = {**given.point, T.name: given.driven.ends[0]}
        branch = min(branches, key=lambda each: _away(each, here, near))
        return branch, _over_time(given, branch)
    faults, followed_ones = [], []
    for branch in branches:
        try:
            followed_ones.append((branch, _over_time(given, branch)))
        except NotDerivable as fault:
            faults.append(fault)
    if not followed_ones:
        raise faults[0]
    ranges = ranges_of(given)
    return next((each for each in followed_ones if leaves(each[1], ranges) is None), followed_ones[0])


def _away(branch: Followed, at: Mapping[str, float], near: Mapping[str, float]) -> float:
    """How far the branch begins from the start, turns apart."""
    try:
        found = branch.numbers(at)
    except NOT_THERE:
        return float("inf")
    return sum(remainder(found[name] - value, tau) ** 2 for name, value in near.items())


def _over_time(given: Setting, branch: Followed) -> Sampled:
    """Raises NotDerivable where the branch ends on the way, or is without bound."""
    import numpy as np

    assert given.driven is not None
    times = moments(given.driven)
    names = [[name + end for name in branch.variables] for end in ("", "_dot", "_ddot")]
    found: list[list[list[float]]] = []
    for t in map(float, times):
        try:
            at = branch.numbers({**given.point, T.name: t})
        except ValueError:
            raise NotDerivable(f"the path is out of reach of the arm at t = {t:.3g} s", "path") from None
        except (ZeroDivisionError, OverflowError):
            raise NotDerivable(SINGULAR.format(f"{t:.3g}"), "path") from None
        if max(abs(at[name]) for name in names[1]) * float(times[-1] - times[0]) > STEEP:
            raise NotDerivable(SINGULAR.format(f"{t:.3g}"), "path")
        found.append([[at[name] for name in row] for row in names])
    q, qdot, qddot = (np.array([row[order] for row in found]) for order in range(3))
    for k, link in enumerate(link for link in given.problem.subject.links if link.variable):
        if link.joint == "revolute":
            q[:, k] = np.unwrap(q[:, k])
            near = (given.begun or {}).get(link.variable, 0.0)
            q[:, k] -= tau * round((q[0, k] - near) / tau)
    return Sampled(given.problem.subject, times, (q, qdot, qddot))


def _chosen(given: Setting, branches: Sequence[Followed]) -> Phrase:
    """Why this branch."""
    if len(branches) == 1:
        return Phrase("only-one")
    return Phrase("nearest" if given.start else "one-of", {"count": len(branches)})


# -- what holds it -----------------------------------------------------------------------------------


def _holds(given: Setting, told: Followed, closed: Closed) -> Any:
    """At points of the symbols where the arm reaches the path: in turn as the page tells it, and as the
    results say."""
    results = [[compiled(tree) for tree in entries(each)] for each in closed]
    if given.driven is not None:
        yield from _holds_at(given, told, results, given.point)
        return
    met = 0
    for drawn in random_points(given.names - given.point.keys(), TRIES):
        try:
            point = {**drawn, **given.point}
            truths = [*_holds_at(given, told, results, point)]
        except (*NOT_THERE, NotDerivable):
            continue
        yield from truths
        met += 1
        if met == POINTS:
            return
    if not met:
        raise NotReal("no values of the symbols were found for which the path is within reach")


def _holds_at(
    given: Setting, told: Followed, results: Sequence[Sequence[Compiled]], point: Mapping[str, float]
) -> Any:
    driven = given.moving.numbers(point)
    known = dict(completed(point, given.problem.where))

    def in_turn(t: float) -> list[list[float]]:
        found = told.numbers({**known, T.name: t})
        return [[found[name + end] for name in told.variables] for end in ("", "_dot", "_ddot")]

    def as_results(t: float) -> list[list[float]]:
        at = {**told.numbers({**known, T.name: t}), **known, T.name: t}
        return [[value(at) for value in each] for each in results]

    yield from carries(given.where, driven, in_turn, known)
    yield from carries(given.where, driven, as_results, known)


def _placed(given: Setting, told: Followed, found: Sampled) -> Callable[[float], dict[str, float]]:
    """The joint variables at a time as the lines say, with the whole turns of what was found."""
    rows = dict(zip(map(float, found.times), found.values[0], strict=True))

    def at(t: float) -> dict[str, float]:
        here = told.numbers({**given.point, T.name: t})
        near = rows[min(rows, key=lambda each: abs(each - t))]
        turns = zip(found.robot.variables, near, strict=True)
        return {name: q + remainder(here[name] - q, tau) for name, q in turns}

    return at


def _is_row(row: Any, told: Followed, given: Setting) -> bool:
    """Whether a row of the table is what the lines come to then."""
    t, *values = (float(cell.value) for cell in row)
    found = told.numbers({**given.point, T.name: t})
    ends = [name + end for end in ("", "_dot", "_ddot") for name in told.variables]
    gaps = [abs(remainder(found[name] - value, tau)) for name, value in zip(ends, values, strict=False)]
    return max(gaps) < 1e-6 * max(1.0, *map(abs, values))


def _begins_near(found: Sampled, given: Setting) -> Iterator[bool]:
    """Whether angles begin within half a turn of the start that was typed, or else of zero."""
    first = dict(zip(found.robot.variables, map(float, found.values[0][0]), strict=True))
    for link in found.robot.links:
        if link.variable and link.joint == "revolute":
            yield abs(first[link.variable] - (given.begun or {}).get(link.variable, 0.0)) < pi + SLACK


def _evaluated(answer: Derivation, given: Setting, told: Followed) -> Derivation:
    """At the author's point: numbers where that decides all, else what is left of the results."""
    if given.evaluate is None or (given.driven is not None and given.time is None):
        return answer
    if given.time is not None and given.driven is not None and given.driven.ends:
        begin, end = given.driven.ends
        if not begin <= given.time <= end:
            raise NotDerivable(f"the motion lasts from t = {begin:.3g} s to {end:.3g} s", "evaluate")
    if given.driven is not None:
        return replace(answer, evaluated=_numbers(given, told))
    here = Here.of(dict(given.evaluate), given.problem.where, given.problem.style)
    return replace(answer, evaluated=values_at(answer, here))


def _numbers(given: Setting, told: Followed) -> dict[str, list[float]]:
    """q, its rates and accelerations at the moment; angles in (-pi, pi]."""
    found = told.numbers(given.point)
    turns = [link.joint == "revolute" for link in given.problem.subject.links if link.variable]
    q = [
        remainder(found[name], tau) if turn else found[name]
        for name, turn in zip(told.variables, turns, strict=True)
    ]
    rates = ([found[name + end] for name in told.variables] for end in ("_dot", "_ddot"))
    return dict(zip(("q", "qdot", "qddot"), (q, *rates), strict=True))
