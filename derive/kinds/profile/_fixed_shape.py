"""The shortest time of a motion of one shape: each limit needs a time, and the longest of them is needed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from math import isclose
from typing import Any

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import Point, completed
from derive.algebra.numbers.floats import number as value_of
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    Approximate,
    Call,
    Degrees,
    Expr,
    Number,
    Product,
    Relation,
    Symbol,
    column,
    factors_of,
    free_symbols,
    multiply,
    number,
    sqrt,
    squared,
    walk,
)
from derive.kinds.checks import random_points
from derive.kinds.meanings import Chain, Names, farthest
from derive.kinds.problem import Problem
from derive.kinds.profile._limited import Limited, board
from derive.kinds.profile._minimum_told import Bound, Outcome
from derive.kinds.profile._places import places
from derive.kinds.profile._shapes import (
    PEAKS,
    SHAPES,
    TIME,
    WAY,
    Shape,
    laws,
    meanings,
    needed,
    over,
    parts,
    peak,
)
from derive.kinds.work import Work
from derive.mechanics import shapes
from derive.mechanics.profile import Profile

SAME = 1e-9  # of times that are one
LOOSE = 1e-5  # what differences leave
EACH = 2  # points for a case
PLACES = 20  # where a case is looked for


@dataclass(frozen=True, slots=True)
class Case:
    """Which limits are active, the board with the time, and the peaks of every axis as they are written."""

    outcome: Outcome
    work: Work
    peaks: Mapping[str, tuple[Expr, ...]]


@dataclass(frozen=True, slots=True)
class Shaped:
    """Every case of a motion by one law; `base` has what they share."""

    law: shapes.Law
    base: Work
    axes: tuple[Limited, ...]
    cases: tuple[Case, ...]

    @property
    def several(self) -> bool:
        return len(self.axes) > 1

    @property
    def bounds(self) -> list[Bound]:
        """All limits, of the axes by their numbers, 0 of a single one."""
        first = 1 if self.several else 0
        return [(place, rate) for place, axis in enumerate(self.axes, first) for rate in axis.limits]

    def axis(self, bound: Bound) -> Limited:
        return self.axes[bound[0] - self.several]


def shaped(law: shapes.Law, profile: Profile, problem: Problem) -> Shaped:
    """Raises NotDerivable where symbols of several axes leave the longest time open."""
    work, axes = board(profile, problem)
    shape = SHAPES[law]
    work = work.showing(*laws(shape, axes[0].d if len(axes) == 1 else WAY, TIME))
    bare = Shaped(law, work, axes, ())
    for bound in bare.bounds:
        axis = bare.axis(bound)
        name, limit = time_of(axis, bound[1]).name, axis.limits[bound[1]]
        work = work.worked(name, needed(shape, bound[1], axis.d, limit), written(shape, work, bound[1], axis))
    bare = replace(bare, base=work)
    return replace(bare, cases=tuple(cases_of(bare, time_of, _timed)))


def written(shape: Shape, work: Work, rate: int, axis: Limited) -> Expr:
    """A time that a limit needs as a person writes it: a root is not taken apart."""
    d, limit = axis.d, axis.limits[rate]
    if free_symbols(work[d]) and free_symbols(work[limit]):
        return needed(shape, rate, work[d], work[limit])
    found = work.shown(needed(shape, rate, d, limit))
    if rate == 1 or not any(isinstance(node, Call) and node.function == "sqrt" for node in walk(found)):
        return found
    return sqrt(work.problem.readable(normal(over(shape.strong, d, limit), work.definitions)))


def at_most(shape: Shape, work: Work, axis: Limited, formula: Expr) -> Expr:
    """The velocity reached at the greatest acceleration, as a `formula` says it: 3 d/(2 T) with
    T^2 = 6 d/a_M is sqrt(3 d a_M/8)."""
    found = work.shown(formula)
    if isinstance(found, Number | Degrees):
        return found
    n, m = parts(shape.border)
    d, a = work[axis.d], work[axis.limits[2]]
    inner = multiply(*(factor for factor in (*factors_of(m), d, a) if factor != ONE)) / n
    if not (free_symbols(d) and free_symbols(a)):
        inner = _over_one_line(work.problem.readable(normal(inner)))
    return sqrt(inner)


def _over_one_line(tree: Expr) -> Expr:
    """45 pi/64 for 45/64 pi."""
    match tree:
        case Product((Number(value), *rest)) if value.denominator > 1:
            return multiply(number(value.numerator), *rest) / number(value.denominator)
    return tree


def time_of(axis: Limited, rate: int) -> Symbol:
    """What the time that a limit needs is called."""
    return Symbol(f"T_{'va'[rate - 1]}{axis.end}")


def cases_of(
    each: Shaped,
    name_of: Callable[[Limited, int], Symbol],
    case: Callable[[Shaped, tuple[Bound, ...], tuple[Relation, ...]], Case],
) -> Iterator[Case]:
    """One; of a single axis with symbols one for either limit. Names are those of what each limit needs."""
    work, bounds = each.base, tuple(each.bounds)
    if each.several or len(bounds) == 1:
        yield case(each, _longest(each, name_of), ())
        return
    (axis,) = each.axes
    border = over(SHAPES[each.law].border, squared(axis.limits[1]), axis.limits[2])
    sign = work.sign(border - axis.d)
    if sign is None:
        left, right = work.shown(border), work.shown(axis.d)
        for bound, relation in zip(bounds, ("<=", ">"), strict=True):
            yield case(each, (bound,), (Relation(left, relation, right),))
    else:
        yield case(each, bounds if not sign else bounds[:1] if sign < 0 else bounds[1:], ())


def _longest(each: Shaped, name_of: Callable[[Limited, int], Symbol]) -> tuple[Bound, ...]:
    """Those that need the longest time. Raises NotDerivable where symbols leave that open."""
    bounds = each.bounds
    if len(bounds) == 1:
        return tuple(bounds)
    try:
        names = [name_of(each.axis(bound), bound[1]) for bound in bounds]
        times = [value_of(each.base.final(name), {}) for name in names]
    except KeyError:
        message = "the slowest axis cannot be told without numbers; give values under where:"
        raise NotDerivable(message) from None
    pairs = zip(bounds, times, strict=True)
    return tuple(bound for bound, time in pairs if isclose(time, max(times), rel_tol=SAME))


def _timed(each: Shaped, active: tuple[Bound, ...], when: tuple[Relation, ...]) -> Case:
    """The time, and what is reached in it."""
    shape = SHAPES[each.law]
    longest = time_of(each.axis(active[0]), active[0][1])
    work = each.base.worked(TIME.name, longest, each.base[longest])
    if not each.several:
        (axis,) = each.axes
        for rate, name in enumerate(PEAKS, 1):
            if (0, rate) in active:
                work = work.worked(name, axis.limits[rate])
            elif rate == 1:  # equal for positive sizes only, which the search checks
                formula = peak(shape, 1, axis.d, TIME)
                work = work.worked(name, formula, at_most(shape, work, axis, formula), "in-numbers")
            else:
                work = work.worked(name, peak(shape, 2, axis.d, TIME))
        values = {name: work.final(name) for name in PEAKS}
        return Case(Outcome(active, {"time": work.final(TIME), **values}, when), work, {})
    peaks = {
        name: tuple(plain(work.shown(peak(shape, rate, axis.d, TIME))) for axis in each.axes)
        for rate, name in enumerate(PEAKS, 1)
    }
    columns = {
        name: column(work.problem.final(work.shown(peak(shape, rate, axis.d, TIME))) for axis in each.axes)
        for rate, name in enumerate(PEAKS, 1)
    }
    return Case(Outcome(active, {"time": work.final(TIME), **columns}, when), work, peaks)


def plain(value: Expr) -> Expr:
    """As it stands in a table: rounded where it is no plain number."""
    return value if isinstance(value, Number | Degrees) else Approximate(value_of(value, {}))


# -- by search ----------------------------------------------------------------------------------------


def searched(each: Shaped, at: Point) -> dict[Bound, float] | None:
    """The least time of each limit alone; None where a size is not positive."""
    times: dict[Bound, float] = {}
    for bound in each.bounds:
        sizes = each.axis(bound).in_numbers(each.base, at)
        if sizes is None:
            return None
        d, v, a = sizes
        limits = {"v_max": v} if bound[1] == 1 else {"a_max": a}
        times[bound] = shapes.least_time(each.law, d, **limits)
    return times


def _active(times: Mapping[Bound, float]) -> set[Bound]:
    longest = max(times.values())
    return {bound for bound, time in times.items() if isclose(time, longest, rel_tol=LOOSE)}


def _points(each: Shaped, case: Case) -> Iterator[tuple[Point, dict[Bound, float]]]:
    """Where the search finds a case."""
    symbols = each.base.problem.symbols
    for at in places(symbols) if case.outcome.when else random_points(symbols, PLACES):
        times = searched(each, at)
        if times and _active(times) == {*case.outcome.active}:
            yield at, times


def given_names(each: Shaped, at: Point) -> dict[Expr, Any]:
    """What was given, in numbers."""
    known = completed(at, each.base.problem.where)
    names: dict[Expr, Any] = {Symbol(name): value for name, value in known.items()}
    for axis in each.axes:
        sizes = axis.in_numbers(each.base, at) or (0.0, 0.0, 0.0)
        names |= {axis.d: sizes[0], **{name: sizes[rate] for rate, name in axis.limits.items()}}
    return names


def names_of(each: Shaped, at: Point, times: Mapping[Bound, float]) -> Names:
    """The times that the search finds beside what was given, and the peaks of the motion in the longest."""
    names = given_names(each, at)
    names |= {time_of(each.axis(bound), bound[1]): time for bound, time in times.items()}
    d, way = (WAY, 1.0) if each.several else (each.axes[0].d, names[each.axes[0].d])
    return {**names, **meanings(each.law, d, TIME, way, max(times.values()))}


def as_told(
    each: Shaped, case: Case, chains: Sequence[Chain], names: Callable[[Point, Mapping[Bound, float]], Names]
) -> Iterator[bool]:
    """Whether all that is told of a case holds where the search finds it, by what `names` are there."""
    for at, found in islice(_points(each, case), EACH):
        yield farthest(chains, names(at, found)) < LOOSE


def right_case(each: Shaped) -> Iterator[bool]:
    """Whether just the case that the search finds is told to be the one, where symbols leave it open."""
    for at in random_points(each.base.problem.symbols, PLACES):
        times = searched(each, at)
        if times:
            known = completed(at, each.base.problem.where)
            met = [case for case in each.cases if case.outcome.is_met(known)]
            yield len(met) == 1 and {*met[0].outcome.active} == _active(times)


def reached(each: Shaped, told: Mapping[str, Sequence[float]]) -> Iterator[bool]:
    """Whether what is told of each of several axes is reached in the time that the search finds."""
    times = searched(each, {})
    for place, axis in enumerate(each.axes):
        sizes = axis.in_numbers(each.base, {})
        if sizes and times:
            peaks = shapes.peaks(each.law, sizes[0], max(times.values()))
            yield from (
                isclose(told[name][place], value, rel_tol=LOOSE)
                for name, value in zip(PEAKS, peaks, strict=True)
            )
