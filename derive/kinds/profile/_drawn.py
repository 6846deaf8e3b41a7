"""A trajectory in floats beside its exact one: evaluated, drawn, and held against its limits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import degrees, inf, isclose
from types import MappingProxyType
from typing import Any

from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Claim, Figure, Record
from derive.expression import Approximate, Degrees, Expr, Product, Relation, walk
from derive.figures.courses import panels
from derive.kinds.checks import close, law, route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.profile._pieces import Span, in_floats
from derive.kinds.profile._units import sort_at
from derive.kinds.profile._written import Written
from derive.kinds.sure import place
from derive.kinds.values_at import point_of
from derive.mechanics.course import Course, at, extremes, sampled
from derive.mechanics.profile import Profile

SLACK = 1e-9
NONE: Mapping[str, Expr] = MappingProxyType({})
NO_MOMENTS: Mapping[Expr, Expr] = MappingProxyType({})


class LimitTold(Record):
    name: str
    limit: Expr
    rate: int  # 1 for a velocity, 2 for an acceleration
    reached: Expr | None  # None where it is the limit itself
    kept: bool
    first: Expr | None  # from when on it is not kept; None from the start on
    until: Expr | None  # and until when; None to the end


@dataclass(frozen=True, slots=True)
class Drawn:
    """A profile at the point its author asks for; `course` is None where a value is left open there."""

    profile: Profile
    problem: Problem
    evaluate: Place | None
    course: Course | None

    @staticmethod
    def of(spans: Sequence[Span], profile: Profile, problem: Problem, evaluate: Place | None) -> Drawn:
        """Of a trajectory in pieces. Raises NotDerivable where the point makes none of them."""
        return Drawn(profile, problem, evaluate, in_floats(spans, evaluate, problem))

    def evaluated(self, results: Mapping[str, Expr]) -> dict[str, Any]:
        """The results in numbers, and q where a time is given."""
        if self.evaluate is None or self.course is None:
            return {}
        point = point_of(dict(self.evaluate), self.problem.where)
        found = {name: value_of(tree, point) for name, tree in results.items()}
        return {**found, "q": at(self.course, point["t"])} if "t" in point else found

    def plots(self, name: str, moments: Mapping[Expr, Expr], through: bool = False) -> tuple[Figure, ...]:
        """Position, velocity and acceleration over time, pieces that last no time left out; `moments` are
        named on the axis. With `through` the places are marked where two pieces meet, and the ends."""
        if self.course is None:
            return ()
        kept = tuple(piece for piece in self.course if piece.end > piece.start)
        knots = [(piece.start, piece.at(piece.start)) for piece in kept] + [
            (kept[-1].end, at(kept, kept[-1].end))
        ]
        turned = self.problem.style.degrees or self.in_degrees
        sort = sort_at(self.profile, self.evaluate)
        limits = limits_drawn(self.profile, self.problem)
        times = self.marked(moments)
        return (panels(name, {"": kept}, sort, turned, times, limits, knots if through else ()),)

    @property
    def in_degrees(self) -> bool:
        """Whether the values with which it is drawn are."""
        return any(isinstance(node, Degrees) for _, value in self.evaluate or () for node in walk(value))

    def marked(self, moments: Mapping[Expr, Expr]) -> dict[Expr, float]:
        """The moments in seconds."""
        point = place({**self.problem.where, **{n: v for n, v in self.evaluate or () if n != "t"}})
        return {name: value_of(tree, point) for name, tree in moments.items()}

    def claims(
        self,
        pieces: Sequence[tuple[Expr, Relation | None]],
        told: Sequence[LimitTold],
        drawn: bool,
        results: Mapping[str, Expr] = NONE,
        moments: Mapping[Expr, Expr] = NO_MOMENTS,
    ) -> Iterator[Claim]:
        """What is told of the limits, and of q at a time, against the trajectory as it is written, maybe in
        names of `results`; what is marked on the picture, against the ends of its pieces."""
        yield law("drawn", drawn == (self.course is not None))
        if self.course is None:
            return
        ends = [piece.end for piece in self.course]
        yield law("marked", (any(close(t, end) for end in ends) for t in self.marked(moments).values()))
        names = {**results, **self.problem.where}
        there = dict(self.evaluate or ())
        point = place({**names, **{name: value for name, value in there.items() if name != "t"}})
        written = Written(pieces, point, self.course[-1].end)
        given = [(limit, rate) for limit, rate in self._given if self._most(limit) < inf]
        if told or given:
            listed = [(each.limit, each.rate) for each in told] == given
            yield route("limits", (listed, *(written.keeps(each, self._most(each.limit)) for each in told)))
        asked = place({**self.problem.where, **there})
        if "t" in asked and 0 <= asked["t"] <= self.course[-1].end:
            here = float(written.place(asked["t"]))
            yield route("at-the-time", close(here, self.evaluated({})["q"], 1e-8))

    @property
    def _given(self) -> list[tuple[Expr, int]]:
        """The limits of the sheet, each with how often what it limits is differentiated."""
        journey = self.profile.journey
        pairs = ((journey.v_max, 1), (journey.a_max, 2)) if journey else ()
        return [(limit, rate) for limit, rate in pairs if limit is not None]

    def _most(self, limit: Expr) -> float:
        size = _size(self.problem.final(limit), self.evaluate or ())
        return inf if size is None else size

    def limits(self) -> tuple[LimitTold, ...]:
        """Each limit that is given, what is reached, whether that is kept, and when it is not."""
        journey, course = self.profile.journey, self.course
        if journey is None or course is None:
            return ()
        given = (("velocity", journey.v_max, 1), ("acceleration", journey.a_max, 2))
        turned = self.profile.sort == "angle" and self.problem.style.degrees
        found = (
            _limit(name, limit, order, course, _size(self.problem.final(limit), self.evaluate or ()), turned)
            for name, limit, order in given
            if limit is not None
        )
        return tuple(each for each in found if each)


def limits_drawn(profile: Profile, problem: Problem) -> tuple[float | None, float | None]:
    """The limits of velocity and acceleration as numbers, where they are."""
    journey = profile.journey
    given = (None, None) if journey is None else (journey.v_max, journey.a_max)
    fast, strong = (None if limit is None else _size(problem.final(limit)) for limit in given)
    return fast, strong


def _size(limit: Expr, point: Place = ()) -> float | None:
    try:
        return value_of(limit, point_of(dict(point), {}))
    except KeyError:
        return None


def _shown(value: float, most: float, in_degrees: bool) -> Expr | None:
    """To the digits of a page, or to more where the limit would be the same; an angle in degrees where the
    author typed such. None of the limit itself."""
    if isclose(value, most, rel_tol=SLACK):
        return None
    if not in_degrees:
        return Approximate(value)
    size = degrees(value)
    alike = f"{size:.3g}" == f"{degrees(most):.3g}"
    return Degrees(Fraction(f"{size:.6g}")) if alike else Product((Approximate(size), Degrees(Fraction(1))))


def _limit(
    name: str, limit: Expr, order: int, course: Course, most: float | None, turned: bool
) -> LimitTold | None:
    if most is None:
        return None
    reached = max(map(abs, extremes(course, order)))
    times, values = sampled(course, order)
    past = [abs(value) > most * (1 + SLACK) for value in values]
    first = past.index(True) if any(past) else 0
    last = past.index(False, first) if False in past[first:] and any(past) else 0
    edges = (_crossing(course, order, most, times, k) if k else None for k in (first, last))
    begins, ends = (None if edge is None else Approximate(edge) for edge in edges)
    return LimitTold(
        name=name,
        limit=limit,
        rate=order,
        reached=_shown(reached, most, turned),
        kept=reached <= most * (1 + SLACK),
        first=begins,
        until=ends,
    )


def _crossing(course: Course, order: int, most: float, times: Sequence[float], k: int) -> float:
    """Between a sample and the one before it, of which one is beyond the limit, by halving; the border of a
    piece where the derivative jumps."""
    low, high = times[k - 1], times[k]
    beyond = abs(at(course, high, order)) > most
    for _ in range(60):
        middle = (low + high) / 2
        if (abs(at(course, middle, order)) > most) == beyond:
            high = middle
        else:
            low = middle
    return high
