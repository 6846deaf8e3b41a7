"""The moves in numbers at one pose, where the equations of a move may leave its angle open.

There the determinant of the two equations an angle was found by vanishes, or both coefficients of its one
equation do. Any others that hold it alone, with what is known by then, will do; where there are none the
angle is pinned to a value, and the joints after it follow.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import combinations

from derive.algebra.angles import Form
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.numbers.many_points import Quick
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.moves import Definition, Item, Move, Option
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.knowledge import Knowledge
from derive.mechanics.inverse.plan import Plan, learned
from derive.mechanics.inverse.search import Found
from derive.mechanics.inverse.slide import Slide
from derive.mechanics.inverse.squares import Elbow, Reach
from derive.mechanics.inverse.trigonometric import OneEquation, Row, TwoEquations

USABLE = 1e-4  # of a determinant or a coefficient: above, other equations determine an angle
MEETING = 1e-9  # of a^2 + b^2 - c^2 against a^2 + b^2: below, the two solutions are one
PLENTY = 0.1  # of a determinant: above, no better equations are looked for
NOT_REAL = (ValueError, ZeroDivisionError)
Values = dict[str, float]
Numbers = tuple[float, float, float]  # a, b, c of a cos q + b sin q = c


@dataclass(frozen=True, slots=True)
class Leaf:
    """Joint values, none where the branch is not real; and the moves (by number) whose unknown was pinned,
    with the value it has."""

    values: Values
    pinned: Mapping[int, float]


@dataclass(frozen=True, slots=True)
class State:
    """What is known while the moves are made."""

    known: Values
    forms: tuple[Form, ...] = ()
    sums: tuple[float, ...] = ()
    pinned: Mapping[int, float] = field(default_factory=dict)


@dataclass(frozen=True)
class AtPoint:
    """A plan and its moves at a pose. `size` is a length of the arm, which coefficients are measured by;
    `small` is what counts as zero of them, `meeting` likewise of a^2 + b^2 - c^2 against a^2 + b^2."""

    solutions: Solutions
    items: tuple[Item, ...]
    chain: Chain
    plan: Plan
    size: float
    small: float
    meeting: float = MEETING

    def leaves(
        self, taken: Mapping[int, Option], point: Mapping[str, float], pins: Mapping[int, float], usual: float
    ) -> Iterator[Leaf]:
        """The values of a branch, several where other equations leave a choice. What is open is pinned to
        `usual`, or as `pins` say."""
        for state, real in self._after(taken, State(dict(point)), 0, pins, usual):
            names = self.solutions.joints if real else ()
            yield Leaf({name: state.known[name] for name in names}, state.pinned)

    def _after(
        self, taken: Mapping[int, Option], state: State, place: int, pins: Mapping[int, float], usual: float
    ) -> Iterator[tuple[State, bool]]:
        for k, item in enumerate(self.items[place:], place):
            if isinstance(item, Definition):
                self._define(item, state.known)
                continue
            try:
                found = self._values(item, taken[item.number], state.known)
            except NOT_REAL:
                found = []
            if found == []:
                yield state, False
            free = found is None
            for value in [pins.get(item.number, usual)] if found is None else found:
                pinned = {**state.pinned, item.number: value} if free else state.pinned
                yield from self._after(taken, self._learned(item, value, state, pinned), k + 1, pins, usual)
            return
        yield state, True

    def _define(self, item: Definition, known: Values) -> None:
        """A name that is not needed may rest on what has no value."""
        try:
            known[item.name.name] = self.solutions.value(item, known)
        except (KeyError, *NOT_REAL):
            known.pop(item.name.name, None)

    def _learned(self, move: Move, value: float, state: State, pinned: Mapping[int, float]) -> State:
        if isinstance(move.of, str):
            return State({**state.known, move.of: value}, state.forms, state.sums, pinned)
        forms, sums = (*state.forms, move.of), (*state.sums, value)
        return State({**state.known, **self.solutions.angles(forms, sums)}, forms, sums, pinned)

    # -- one move ---------------------------------------------------------------------------------

    def _values(self, move: Move, option: Option, known: Values) -> list[float] | None:
        """By its formula; where that fails by other equations, None where no equation holds it."""
        _, found = self.plan.found[move.number]
        try:
            if self._is_open(found, known):
                return self._by_others(move.number, known)
            met = self._met(found, known)
        except KeyError:  # of a name that no formula needs
            met = None
        return [self.solutions.value(option, known)] if met is None else [met]

    @cached_property
    def _before(self) -> list[Knowledge]:
        """What is known before each move in its stage."""
        knowledge: dict[int, Knowledge] = {}
        found = []
        for stage, each in self.plan.found:
            found.append(knowledge.get(id(stage)) or Knowledge.of(self.chain, stage.joints))
            knowledge[id(stage)] = learned(found[-1], each)
        return found

    def _is_open(self, found: Found, known: Values) -> bool:
        """Whether these equations do not hold their unknown here."""
        match found:
            case TwoEquations(_, first, second):
                rows = self._numbers(first, known), self._numbers(second, known)
                return math.sqrt(_determinant(rows)) < self.small
            case OneEquation(_, row):
                return _length(self._numbers(row, known)) < self.small
            case Elbow(_, _, row):
                return _length(self._numbers(row, known, 2)) < self.small
            case Slide():
                return abs(scalar_number(found.slope, known)) < self.small
            case Reach():
                return False

    def _met(self, found: Found, known: Values) -> float | None:
        """The one angle where two solutions meet."""
        match found:
            case OneEquation(_, row):
                a, b, c = self._numbers(row, known)
            case Elbow(_, parts, row):
                a, b, c = self._numbers(row, known, 2)
                c += sum((scalar_number(part.known, known) / self.size) ** 2 for part in parts)
            case _:
                return None
        square = a * a + b * b
        return math.atan2(b * c, a * c) if abs(square - c * c) < self.meeting * square else None

    def _by_others(self, number: int, known: Values) -> list[float] | None:
        _, slides = self._others(number)
        if slides:
            pairs = [(scalar_number(s.slope, known), scalar_number(s.value, known)) for s in slides]
            slope, value = max(pairs, key=lambda pair: abs(pair[0]))
            return [value / slope] if abs(slope) > USABLE else None
        return _solved(self._known_rows(number, known))

    def _others(self, number: int) -> tuple[list[Row], list[Slide]]:
        """Every equation that holds the unknown of a move alone, looked for once."""
        if number not in self._looked_up:
            stage, found = self.plan.found[number]
            before = self._before[number]
            if isinstance(found, Slide | Reach):
                self._looked_up[number] = [], stage.slides(before, found.slide)
            else:
                self._looked_up[number] = stage.rows(before, found.angle), []
        return self._looked_up[number]

    @cached_property
    def _looked_up(self) -> dict[int, tuple[list[Row], list[Slide]]]:
        return {}

    def _known_rows(self, number: int, known: Values) -> list[Numbers]:
        """Those whose names all have values, until two of them determine the angle well."""
        rows, _ = self._others(number)
        if number not in self._quick:
            self._quick[number] = Quick.of([value for row in rows for value in (row.a, row.b, row.c)])
        values = self._quick[number].at(known)
        found: list[Numbers] = []
        for k, row in enumerate(rows):
            scale = self.size if row.equation.is_position else 1.0
            a, b, c = values[3 * k : 3 * k + 3]
            if a is None or b is None or c is None:
                continue
            found.append((a / scale, b / scale, c / scale))
            if any(_determinant((other, found[-1])) > PLENTY for other in found):
                break
        return found

    @cached_property
    def _quick(self) -> dict[int, Quick]:
        return {}

    def _numbers(self, row: Row, known: Values, lengths: int = 1) -> Numbers:
        """a, b and c, those of a position in lengths of the arm."""
        scale = self.size**lengths if row.equation.is_position else 1.0
        a, b, c = (scalar_number(value, known) / scale for value in (row.a, row.b, row.c))
        return a, b, c


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
