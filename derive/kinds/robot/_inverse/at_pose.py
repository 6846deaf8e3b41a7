"""A branch in numbers at one pose, where the equations of a sub-problem may leave its unknown open.

There the determinant of the two equations an angle was found by vanishes, or both coefficients of its one
equation do. Any others that hold it alone, with what is known by then, will do; where there are none the
angle is pinned to a value, and the joints after it follow.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations

from derive.algebra.angles import Form
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.numbers.many_points import Polynomials
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.subproblem import Definition, Solved, Taken
from derive.kinds.robot._inverse.target import Values
from derive.mechanics.inverse.plan import Planned
from derive.mechanics.inverse.subproblems import (
    DoubleAngle,
    Elbow,
    HalfAngle,
    OneEquation,
    Quadratic,
    Quartic,
    Reach,
    Slide,
    TrigEquation,
    TwoEquations,
)

USABLE = 1e-4  # of a determinant or a coefficient: above, other equations determine an angle
MEETING = 1e-9  # of a^2 + b^2 - c^2 against a^2 + b^2: below, the two solutions are one
PLENTY = 0.1  # of a determinant: above, no better equations are looked for
EXACTLY = 1e-13
NOT_REAL = (ValueError, ZeroDivisionError)
Numbers = tuple[float, float, float]  # a, b, c of a cos q + b sin q = c


@dataclass(frozen=True, slots=True)
class Configuration:
    """Joint values, none where the branch is not real; and the sub-problems (by number) whose unknown was
    pinned, with the value it has."""

    values: Values
    pinned: Mapping[int, float]


@dataclass(frozen=True)
class InNumbers:
    """A sub-problem at poses; `size` is a length of the arm, which coefficients are measured by."""

    planned: Planned
    size: float

    def is_open(self, known: Values, small: float) -> bool:
        """Whether its equations do not hold its unknown here: `small` counts as zero."""
        match self.planned.subproblem:
            case TwoEquations(_, first, second):
                rows = self._numbers(first, known), self._numbers(second, known)
                return math.sqrt(_determinant(rows)) < small
            case OneEquation(_, row):
                return _length(self._numbers(row, known)) < small
            case Elbow(_, _, row):
                return _length(self._numbers(row, known, 2)) < small
            case Slide(_, slope):
                return abs(scalar_number(slope, known)) < small
            case Quadratic(coefficients=(a, b, _)):
                return not a and abs(scalar_number(b, known)) < small * self.size
            case DoubleAngle(coefficients=(a, b, _)):
                return math.hypot(scalar_number(a, known), scalar_number(b, known)) < small * self.size**2
            case Reach() | Quartic() | HalfAngle():
                return False

    def met(self, known: Values, meeting: float) -> float | None:
        """The one value where two solutions meet."""
        match self.planned.subproblem:
            case Quadratic(coefficients=coefficients):
                a, b, c = (scalar_number(each, known) for each in coefficients)
                near = a and abs(b * b - 4 * a * c) < meeting * (b * b + abs(4 * a * c))
                return -b / (2 * a) if near else None
            case OneEquation(_, row):
                a, b, c = self._numbers(row, known)
            case DoubleAngle(coefficients=coefficients):
                a, b, c = (scalar_number(each, known) / self.size**2 for each in coefficients)
            case Elbow(_, _, row) as elbow:
                a, b, c = self._numbers(row, known, 2)
                squares = [elbow.across] if elbow.across else [c.known * c.known for c in elbow.coordinates]
                c += sum(scalar_number(each, known) / self.size**2 for each in squares)
            case _:
                return None
        square = a * a + b * b
        return math.atan2(b * c, a * c) if abs(square - c * c) < meeting * square else None

    def by_others(self, known: Values) -> list[float] | None:
        """By any other equation that holds the unknown alone; None where none does."""
        if isinstance(self.planned.subproblem, Slide | Reach | Quadratic):
            pairs = [(scalar_number(s.slope, known), scalar_number(s.value, known)) for s in self._slides]
            slope, value = max(pairs, key=lambda pair: abs(pair[0]), default=(0.0, 0.0))
            return [value / slope] if abs(slope) > USABLE else None
        return _solved(self._known_rows(known))

    @cached_property
    def _slides(self) -> list[Slide]:
        unknown = self.planned.subproblem.unknown
        return self.planned.stage.slides(self.planned.known, unknown) if isinstance(unknown, str) else []

    @cached_property
    def _rows(self) -> list[TrigEquation]:
        unknown = self.planned.subproblem.unknown
        return self.planned.stage.rows(self.planned.known, unknown) if isinstance(unknown, Form) else []

    @cached_property
    def _quick(self) -> Polynomials:
        return Polynomials.of([value for row in self._rows for value in (row.a, row.b, row.c)])

    def _known_rows(self, known: Values) -> list[Numbers]:
        """Those whose names all have values, until two of them determine the angle well."""
        values = self._quick.at(known)
        found: list[Numbers] = []
        for k, row in enumerate(self._rows):
            scale = self.size if row.equation.is_position else 1.0
            a, b, c = values[3 * k : 3 * k + 3]
            if a is None or b is None or c is None:
                continue
            found.append((a / scale, b / scale, c / scale))
            if any(_determinant((other, found[-1])) > PLENTY for other in found):
                break
        return found

    def _numbers(self, row: TrigEquation, known: Values, lengths: int = 1) -> Numbers:
        """a, b and c, those of a position in lengths of the arm."""
        scale = self.size**lengths if row.equation.is_position else 1.0
        a, b, c = (scalar_number(value, known) / scale for value in (row.a, row.b, row.c))
        return a, b, c


@dataclass(frozen=True, slots=True)
class State:
    """What is known while one sub-problem after the other is solved."""

    known: Values
    forms: tuple[Form, ...] = ()
    sums: tuple[float, ...] = ()
    pinned: Mapping[int, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class AtPose:
    """The branches at a point, and the sub-problems they are made from: `small` is what counts as zero of
    their coefficients, `meeting` likewise of a^2 + b^2 - c^2 against a^2 + b^2."""

    solutions: Solutions
    in_numbers: tuple[InNumbers, ...]
    point: Mapping[str, float]
    small: float
    meeting: float = MEETING

    def configurations(
        self, k: int, pins: Mapping[int, float], usual: float, exact: bool
    ) -> Iterator[Configuration]:
        """The values of branch k, several where other equations leave a choice. What is open is pinned to
        `usual`, or as `pins` say; where `exact`, only what vanishes exactly counts as open."""
        here = replace(self, small=EXACTLY, meeting=EXACTLY) if exact else self
        for state, real in here._after(self.solutions.chosen[k], State(dict(self.point)), 0, pins, usual):
            names = self.solutions.joints if real else ()
            yield Configuration({name: state.known[name] for name in names}, state.pinned)

    def _after(
        self, taken: Taken, state: State, place: int, pins: Mapping[int, float], usual: float
    ) -> Iterator[tuple[State, bool]]:
        for k, item in enumerate(self.solutions.items[place:], place):
            if isinstance(item, Definition):
                _define(item, state.known)
                continue
            try:
                found = self._values(item, taken, state.known)
            except NOT_REAL:
                found = []
            if found == []:
                yield state, False
            if found is None:
                found = [pins.get(item.number, usual)]
                state = replace(state, pinned={**state.pinned, item.number: found[0]})
            for value in found:
                yield from self._after(taken, self._learned(item, value, state), k + 1, pins, usual)
            return
        yield state, True

    def _learned(self, solved: Solved, value: float, state: State) -> State:
        if isinstance(solved.unknown, str):
            return replace(state, known={**state.known, solved.unknown: value})
        forms, sums = (*state.forms, solved.unknown), (*state.sums, value)
        return State({**state.known, **self.solutions.angles(forms, sums)}, forms, sums, state.pinned)

    def _values(self, solved: Solved, taken: Taken, known: Values) -> list[float] | None:
        """By its formula; where that fails by other equations, None where no equation holds it."""
        here = self.in_numbers[solved.number]
        try:
            if here.is_open(known, self.small):
                return here.by_others(known)
            met = here.met(known, self.meeting)
        except KeyError:  # of a name that no formula needs
            met = None
        return [taken[solved.number].at(known)] if met is None else [met]


def _define(item: Definition, known: Values) -> None:
    """A name that is not needed may rest on what has no value."""
    try:
        known[item.name.name] = item.at(known)
    except (KeyError, *NOT_REAL):
        known.pop(item.name.name, None)


def _solved(rows: Sequence[Numbers]) -> list[float] | None:
    """By two equations, else by one; None where there is none."""
    best = max(combinations(rows, 2), key=_determinant, default=None)
    if best is not None and _determinant(best) > USABLE:
        (a1, b1, c1), (a2, b2, c2) = best
        D = a1 * b2 - a2 * b1
        return [math.atan2((a1 * c2 - a2 * c1) / D, (c1 * b2 - c2 * b1) / D)]
    longest = max(rows, key=_length, default=(0.0, 0.0, 0.0))
    if _length(longest) < USABLE:
        return None
    a, b, c = longest
    rest = 1 - (c / _length(longest)) ** 2
    if rest < -MEETING:
        return []
    half = math.atan2(math.sqrt(max(rest, 0.0)), c / _length(longest))
    return [math.atan2(b, a) + half, math.atan2(b, a) - half]


def _length(row: Numbers) -> float:
    return math.hypot(row[0], row[1])


def _determinant(pair: tuple[Numbers, Numbers]) -> float:
    (a1, b1, _), (a2, b2, _) = pair
    return abs(a1 * b2 - a2 * b1)
