"""The axes of a motion with their limits, under names of one board."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, completed
from derive.algebra.numbers.floats import number as value_of
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, free_symbols, is_negative
from derive.kinds.checks import close
from derive.kinds.problem import Problem
from derive.kinds.profile._shapes import TIME
from derive.kinds.profile._units import units_of
from derive.kinds.somewhere import Somewhere
from derive.kinds.work import Work
from derive.mechanics.profile import Profile
from derive.names import named

NO_LIMIT = "no limit of velocity or acceleration is given; write v_max: or a_max:"


@dataclass(frozen=True, slots=True)
class Limited:
    """One axis: the name of its distance, those of its limits by how often what they limit is differentiated,
    and what these names end with."""

    d: Symbol
    limits: Mapping[int, Symbol]
    backwards: bool
    end: str = ""
    open: bool = False  # whether symbols leave it open that it is not backwards

    def in_numbers(self, work: Work, at: Point) -> tuple[float, float, float] | None:
        """Distance and limits, inf where there is none; None where they are not positive."""
        known = completed(at, work.problem.where)
        d = value_of(work.problem.final(work[self.d]), known)
        v, a = (
            value_of(work.problem.final(work[self.limits[rate]]), known) if rate in self.limits else inf
            for rate in (1, 2)
        )
        return (d, v, a) if min(d, v, a) > 0 else None


def board(profile: Profile, problem: Problem) -> tuple[Work, tuple[Limited, ...]]:
    """A board with the distances and limits, distances backwards as their sizes. Raises NotDerivable for a
    motion without limits."""
    typed = _typed(profile)
    angular = profile.sort == "angle" and problem.style.degrees
    bare = Work(problem, {}, angular)
    values: dict[Expr, Expr] = {}
    rates: dict[Expr, int | None] = {}
    axes = []
    for k, (way, *given) in enumerate(typed, 1):
        end = str(k) if len(typed) > 1 else ""
        if way is None:
            raise NotDerivable("a distance is needed")
        sign = bare.sign(way)
        if sign == 0:
            raise NotDerivable("the distance is zero: there is nothing to move", "distance")
        backwards = sign == -1 or (sign is None and is_negative(way))
        size = bare.shown(-way) if backwards else way if free_symbols(way) else bare.shown(way)
        d = named(f"d_{end}" if end else "d", size, problem.taken)
        values[d], rates[d] = size, 0
        limits: dict[int, Symbol] = {}
        for rate, (letter, limit) in enumerate(zip("va", given, strict=True), 1):
            if limit is not None:
                limits[rate] = named(f"{letter}_M{end}", limit, problem.taken)
                values[limits[rate]], rates[limits[rate]] = limit, rate
                rates[Symbol(f"T_{letter}{end}")] = None
        if not limits:
            raise NotDerivable(NO_LIMIT)
        axes.append(Limited(d, limits, backwards, end, sign is None and d != size))
    units = units_of(profile, {**rates, TIME: None})
    return Work(problem, values, angular, units=units), tuple(axes)


def _typed(profile: Profile) -> list[tuple[Expr | None, ...]]:
    """The way and both limits of each axis."""
    if profile.axes:
        return [(axis.distance, axis.v_max, axis.a_max) for axis in profile.axes]
    journey = profile.journey
    if journey is None:
        raise NotDerivable("a distance is needed")
    return [(journey.end - journey.start, journey.v_max, journey.a_max)]


def as_typed(profile: Profile, work: Work, axes: tuple[Limited, ...]) -> Iterator[bool]:
    """Whether each distance is that from where a motion starts to where it ends, in numbers."""
    at = Somewhere({Symbol(name): value for name, value in work.problem.where.items()})
    journey = profile.journey
    ways = [arrays(axis.distance, at) for axis in profile.axes if axis.distance is not None]
    if journey and not ways:
        ways = [arrays(journey.end, at) - arrays(journey.start, at)]
    for axis, way in zip(axes, ways, strict=True):
        yield close(arrays(work[axis.d], at), -way if axis.backwards else way)


def given_of(work: Work, axes: tuple[Limited, ...]) -> tuple[tuple[Expr, Expr, int | None], ...]:
    """What was typed, by name, each with how often it is differentiated."""
    rates: dict[Expr, int | None] = {axis.d: 0 for axis in axes}
    rates |= {name: rate for axis in axes for rate, name in axis.limits.items()}
    return tuple((name, value, rates[name]) for name, value in work.typed if name in rates)
