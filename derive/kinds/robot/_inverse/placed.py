"""What is said of the branches at the place asked for, against the arm and the formulas as printed."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, get_args

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, completed
from derive.derivation import Branch, Claim, Condition
from derive.expression import Approximate, Expr, Relation, free_symbols
from derive.kinds.checks import TRIES, close, random_points, route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.checks import in_turn, side
from derive.kinds.robot._inverse.evaluated import EXACT, ROUNDED, Evaluated, Numbers
from derive.kinds.robot._inverse.target import Target, Values, gap
from derive.kinds.sure import place as surely

TREES = get_args(Expr)
NOT_REAL = (ValueError, ZeroDivisionError)
TENTH = 1.5  # of one digit: what rounding to it can change
PARTLY = 1e-9  # relative: of twelve digits in what was put in
Entry = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Placed:
    """The entries under `evaluated`, and the branches they should be; `order` is that of the names of a short
    branch, `at_home` gives a point with joint values every name that is defined on the way."""

    target: Target
    branches: Sequence[Branch]
    order: Sequence[str]
    found: Evaluated
    at_home: Callable[[Point], Values]

    def claims(self, place: Place | None, problem: Problem) -> Iterator[Claim]:
        """That the entries are what they say; nothing without a place."""
        if not self.found.values:
            return
        numbers = self.found.numbers
        given = {**problem.where, **dict(place or ())}
        held = self._in_letters(given) if numbers is None else self._in_numbers(numbers, surely(given))
        yield route("placed", held)

    @property
    def _entries(self) -> Sequence[Entry]:
        entries: Sequence[Entry] = self.found.values["solutions"]
        return entries

    # -- in numbers -------------------------------------------------------------------------------

    def _in_numbers(self, at: Numbers, given: Point) -> Iterator[bool]:
        """Of each entry whether it is what it says, and of each branch whether an entry has it; at the place
        that is given."""
        yield from (close(at.typed[name], value) for name, value in given.items() if name in at.typed)
        near = ((at.point[name], value) for name, value in at.typed.items())
        yield from (one == other or abs(one - other) <= ROUNDED for one, other in near)
        real = [each for each in self._entries if each.get("real", True)]
        place = self.found.place
        yield from self._is_labelled(at)
        yield (place.out_of_reach or place.missed) == (not real)
        yield place.free == any("free" in each for each in real)
        yield place.unreal in (0, self._without_values(at)) and place.unreal < place.of
        for entry in real:
            yield self._misses(at, at.typed, entry) <= 2 * at.tolerance
            yield from self._is_told(at, entry)
        for branch in self.branches:
            values = self._printed(branch, at.point)
            if values is not None and self._misses(at, at.point, values) < at.tolerance:
                yield any(self._is_of(branch, each) and self._same(each, values, at) for each in real)
            else:  # a branch may be real by other equations where its formulas fail
                yield any(self._is_of(branch, each) for each in self._entries)

    def _without_values(self, at: Numbers) -> int:
        """The branches that no entry has, and whose formulas have no real values."""
        labelled = zip(self._entries, self.found.branches, strict=False)
        had = {k for entry, branches in labelled if entry.get("real", True) for k in branches}
        missing = (branch for k, branch in enumerate(self.branches) if k not in had)
        return sum(self._printed(branch, at.point) is None for branch in missing)

    def _is_labelled(self, at: Numbers) -> Iterator[bool]:
        """Whether each entry is of the branches it is said to be of, and is off its place as it is said."""
        yield len(self._entries) == len(self.found.branches)
        labelled = [*zip(self._entries, self.found.branches, strict=False)]
        for entry, branches in labelled:
            yield all(self._is_of(self.branches[k], entry) for k in branches)
        had, not_had = (
            {k for entry, its in labelled for k in its if entry.get("real", True) == real}
            for real in (True, False)
        )
        yield not had & not_had and len(had | not_had) == len(self.branches)
        there = self.target.completed(at.typed)
        real = [self._joints(each) for each in self._entries if each.get("real", True)]
        off = [self.target.deviation(there, each) for each in real]
        yield (self.found.off is None) == (not off)
        if off and (remark := self.found.remark):
            told = remark.about.get("off")
            most = told.value if isinstance(told, Approximate) else EXACT
            yield max(off) <= TENTH * most and (told is None or max(off) >= most / TENTH)

    def _is_told(self, at: Numbers, entry: Entry) -> Iterator[bool]:
        """Whether the conditions are some of a branch and hold, and no other branch has all of its own."""
        own = _conditions(entry)
        known = self.at_home({**self.target.completed(at.point), **self._joints(entry)})
        yield any(self._is_of(branch, entry) for branch in self.branches)
        yield from (each for each in self._decided(own, known, at) if each is not None)
        if self.target.spare or "free" in entry:
            return
        for branch in self.branches:
            if not self._is_of(branch, entry) and all(isinstance(each, Relation) for each in branch.when):
                there = [*self._decided(branch.when, known, at)]
                if None not in there or False in there:
                    yield False in there

    def _decided(self, conditions: Sequence[Condition], known: Values, at: Numbers) -> Iterator[bool | None]:
        """Of the relations among these whether each holds."""
        return (self._holds(each, known, at) for each in conditions if isinstance(each, Relation))

    def _holds(self, relation: Relation, known: Values, at: Numbers) -> bool | None:
        """None where the sides meet: what holds there is not decided by numbers."""
        try:
            value = side(relation, self.target, known)
        except (KeyError, *NOT_REAL):
            return None
        if value is None:
            return False
        if abs(value) <= at.near or abs(abs(value) - math.pi) <= at.near:
            return None
        return value > 0 if relation.sign == ">" else value < 0

    def _printed(self, branch: Branch, point: Point) -> Values | None:
        """The joint values of a branch as printed; None where it is not real."""
        try:
            return self._joints(self._known(branch, point))
        except NOT_REAL:
            return None

    def _is_of(self, branch: Branch, entry: Entry) -> bool:
        """Whether all that is said of an entry is said of the branch."""
        return all(each in branch.when for each in _conditions(entry))

    def _same(self, entry: Entry, values: Values, at: Numbers) -> bool:
        """What is free may have any value, and what goes with it."""
        gaps = self.target.gaps(self._joints(entry), values)
        return all(abs(each) <= at.near for name, each in gaps.items() if name not in entry.get("free", ()))

    def _misses(self, at: Numbers, place: Point, values: Entry) -> float:
        return self.target.misses(self.target.completed(place), self._joints(values), at.size)

    def _joints(self, values: Entry) -> Values:
        return {name: values[name] for name in self.target.joints}

    # -- in the letters that are left -------------------------------------------------------------

    def _in_letters(self, given: Mapping[str, Expr]) -> Iterator[bool]:
        """Each entry is the branch with its conditions, whatever the letters are."""
        formulas = [branch.short or branch.values for branch in self.branches]
        trees = [*given.values(), *(tree for each in formulas for tree in each.values())]
        left = frozenset[str]().union(*map(free_symbols, trees)) - given.keys() - formulas[0].keys()
        points = [completed(drawn, given) for drawn in random_points(left, TRIES)]
        for branch, entry in zip(self.branches, self._entries, strict=True):
            yield branch.when == entry["when"]
            yield from self._in_letters_of(branch, entry, points)

    def _in_letters_of(self, branch: Branch, entry: Entry, points: Sequence[Point]) -> Iterator[bool]:
        """At the first point at which the branch is real; of one that is said not to be, at none."""
        for point in points:
            try:
                known = self._known(branch, point)
            except NOT_REAL:
                continue
            yield entry.get("real", True)
            for name in known.keys() & entry.keys():
                value = entry[name]
                ours = arrays(value, known) if isinstance(value, TREES) else value
                off = gap(ours, known[name], name in self.target.slides)
                yield abs(off) <= PARTLY * max(1.0, abs(known[name]))
            return
        yield not entry.get("real", True)

    def _known(self, branch: Branch, point: Point) -> Values:
        """The names of a branch as printed, each put into those after it. Raises as `compiled` does."""
        if branch.short:
            return in_turn(branch.short, self.order, dict(point))
        turn = [name for name in self.order if name in branch.values] or [*branch.values]
        return in_turn(branch.values, turn, dict(point))


def _conditions(entry: Entry) -> tuple[Condition, ...]:
    """Without what is said of a self-motion, which comes last."""
    when: tuple[Condition, ...] = entry["when"]
    return when[:-1] if "free" in entry else when
