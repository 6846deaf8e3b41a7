"""Joints that follow a path by their rates: a table and a picture, from a start."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any

from derive.algebra.numbers.floats import numbers
from derive.derivation import Derivation, Phrase, Result, Step
from derive.errors import NotDerivable
from derive.expression import Approximate, Expr, Measured, Symbol, column
from derive.kinds.checks import close, route
from derive.kinds.path._timing import T
from derive.kinds.robot._carried.checks import goes_through, on_path, rows_follow
from derive.kinds.robot._carried.facts import Facts, Integrated
from derive.kinds.robot._carried.limits import holds, ranges_of, said_of_ranges
from derive.kinds.robot._carried.rates import SUBSTEPS, Rates
from derive.kinds.robot._carried.returning import is_so, returns
from derive.kinds.robot._carried.sampled import Sampled, cleared, rows_of
from derive.kinds.robot._carried.setting import Setting
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._units import of_variables
from derive.kinds.robot._velocity.task import task_of
from derive.kinds.units import in_degrees
from derive.mechanics.task import ROWS

Q_0 = Symbol("q_0")
LISTED = 4  # every which sample is a result
FAR, MOVED = 0.02, 1e-6  # of the size of the path
NEAR, SURE = 1e-3, 1e-6  # of accelerations by differences of differences, of rates and of what they add up to
H = 1e-4  # of the whole time
LOST = (
    "at t = {} s the joint rates do not hold the end-effector on the path any more: it leaves the reach of "
    "the arm, or passes too near to a singular configuration"
)
NO_START = "joint rates are integrated from somewhere: add start: {..} with a value for each joint variable"


def by_rates(given: Setting) -> Derivation:
    """By the (pseudo-)inverse of the Jacobian. Raises NotDerivable where a name has no value, without a
    start, and for one that is not on the path."""
    problem, where = given.problem, given.where
    if given.driven is None:
        missing = ", ".join(sorted(given.names - given.point.keys())) or "the end of the motion"
        raise NotDerivable(f"rates are integrated in numbers, and no value is known for {missing}")
    if given.time is not None:
        raise NotDerivable("integrated joints are told at the times of their table: leave t out", "evaluate")
    if given.begun is None:
        raise NotDerivable(NO_START)
    velocity = problem.ask("inverse-velocity", rows=where.rows)
    given.both.require_own(velocity.definitions)
    rates = Rates(given, task_of(problem, where.rows), given.driven)
    typed = [given.begun[name] for name in problem.subject.variables]
    start = rates.onto(typed)
    gap, size = rates.begins(typed)
    if gap > FAR * size:
        raise NotDerivable(f"at the start the end-effector is {gap:.3g} from where the path begins", "start")
    moved = gap > MOVED * size
    found = rates.over_time(start)
    if (lost := rates.lost(found, FAR * size)) is not None:
        raise NotDerivable(LOST.format(f"{lost:.3g}"), "path")
    table = found.table(rows_of(found.times))
    values = [dict(given.start)[name] for name in problem.subject.variables]
    told = column(map(Approximate, map(float, start)) if moved else values)
    begun = Step("q_0", (Q_0, told), "in-numbers")
    work = (
        given.moving.work.resting_on(velocity)
        .showing(begun)
        .claim(
            route("begun", (close(numbers(begun.result, given.point), found.values[0][0], SURE),)),
            route("followed", _holds(rates, found)),
            route("integrated", _adds_up(found)),
            route("as-drawn", rows_follow(where, given.driven, found, given.point)),
            route("as-tabled", (_is_row(row, rates, given) for row in table.rows)),
            route("as-tabled", goes_through(table, found)),
        )
    )
    ranges = ranges_of(given)
    said = said_of_ranges(found, ranges)
    if said is not None:
        work = work.claim(route("ranges-said", holds(said, found, ranges, _between(found))))
    closing = returns(found, given.driven)
    if closing is not None:
        work = work.claim(route("closing", is_so(closing, table, given.driven, problem.subject)))
    step = float(found.times[1] - found.times[0]) / SUBSTEPS
    redundant = len(where.rows) < len(typed)
    facts = Facts(
        way=given.moving.way,
        place=given.moving.names[0],
        integrated=Integrated(
            start=Phrase("near-the-start" if moved else "from-the-start"),
            least=Phrase("least-of-all") if redundant else None,
            step=Measured(Approximate(step), "s"),
            closing=closing,
        ),
        table=table,
        drawn=True,
        numbers=(),
        ranges=said,
    )
    units: dict[Expr | Phrase, str] = {
        Symbol(name): in_degrees(unit, given.turned) for name, unit in of_variables(problem.subject).items()
    }
    listed = _listed(found, given, rates)
    answer = work.answer(
        "joint-motion", {name: _told(each) for name, each in listed.items()}, facts,
        plots=(found.panels(given.turned),), units={**units, T: "s"},
    )  # fmt: skip
    return replace(answer, evaluated=listed)


def _listed(found: Sampled, given: Setting, rates: Rates) -> dict[str, Any]:
    """The table of the JSON."""
    some = slice(None, None, LISTED)
    names = zip(("q", "qdot", "qddot"), found.values, strict=True)
    listed = {name: cleared(each)[some].tolist() for name, each in names}
    return {"t": found.times[some].tolist(), **listed}


def _told(numbers: list[Any]) -> Result:
    """Numbers as trees; several at each time row by row."""
    if isinstance(numbers[0], list):
        return tuple(tuple(map(Approximate, each)) for each in numbers)
    return tuple(map(Approximate, numbers))


# -- what holds it -----------------------------------------------------------------------------------


def _holds(rates: Rates, found: Sampled) -> Iterator[bool]:
    """On the path, with the least rates for its velocity by differences of poses, which change as is said, at
    both ends too."""
    given, where = rates.given, rates.given.where
    h = H * float(found.times[-1] - found.times[0])
    for k in range(5, len(found.times) - 5, 13):
        t, (q, rate, rise) = float(found.times[k]), (each[k] for each in found.values)
        yield on_path(where, rates.driven, t, q, given.point)
        if any(abs(t - joint) < 3 * h for joint in rates.driven.joints):
            continue
        before, now, after = (_seen(rates, t + by * h, q + by * h * rate, h) for by in (-1, 0, 1))
        yield close(rate, now, NEAR)
        yield close(rise, (after - before) / (2 * h), NEAR)
    for k, ahead in ((0, h), (-1, -h)):
        t, (q, rate, rise) = float(found.times[k]), (each[k] for each in found.values)
        steps = (ahead, 2 * ahead, 3 * ahead)
        one, two, three = (_seen(rates, t + by, q + by * rate + by * by / 2 * rise, h) for by in steps)
        yield close(rise, (8 * two - 5 * one - 3 * three) / (2 * ahead), NEAR)


def _seen(rates: Rates, t: float, q: Any, h: float) -> Any:
    """The least rates by the arm in numbers."""
    import numpy as np

    where = rates.given.where
    names = dict(zip(rates.task.found.variables, map(float, q), strict=True))
    arm = oracle_of(rates.given.problem)
    at, point = arm.at({**rates.given.point, **names}), rates.task.point
    whole = arm.jacobian(at, point.frame, point.offset)
    J = np.array([whole[ROWS.index(row)] for row in where.rows])
    a, b, c, d = (rates.driven.place(t + by * h / 2) for by in (-2, -1, 1, 2))
    return np.linalg.pinv(J) @ ((a - 8 * b + 8 * c - d) / (6 * h))


def _adds_up(found: Sampled) -> Iterator[bool]:
    """Whether what lies between two samples is what the rates there, and their changes, come to."""
    q, rates, rises = found.values
    for k, (low, high) in enumerate(pairwise(found.times)):
        h = high - low
        way = h / 2 * (rates[k] + rates[k + 1]) + h * h / 12 * (rises[k] - rises[k + 1])
        yield close(q[k + 1] - q[k], way, SURE)


def _between(found: Sampled) -> Callable[[float], dict[str, float]]:
    """The joint variables between two samples, by these, their rates and their accelerations."""

    def at(t: float) -> dict[str, float]:
        k = int(abs(found.times - t).argmin())
        by = t - found.times[k]
        q, rate, rise = (each[k] for each in found.values)
        return dict(zip(found.robot.variables, map(float, q + by * rate + by * by / 2 * rise), strict=True))

    return at


def _is_row(row: Any, rates: Rates, given: Setting) -> bool:
    """Whether a row of the table stands on the path with the rates there."""
    t, *values = (float(cell.value) for cell in row)
    n = len(given.problem.subject.variables)
    q, rate = values[:n], values[n : 2 * n]
    follows = close(rate, rates.at(t, q)[: len(rate)], SURE)
    return follows and on_path(given.where, rates.driven, t, q, given.point)
