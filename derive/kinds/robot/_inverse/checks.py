"""Every branch put back through the poses of the oracle, and held to the conditions that say which it is."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import Point
from derive.derivation import Branch, Claim, Condition, Phrase
from derive.expression import ZERO, Expr, Relation, Symbol, is_negative, terms_of
from derive.kinds.checks import route
from derive.kinds.robot._inverse.target import SAME, Target, Values

Conditions = Sequence[Condition]
MORE = 2


@dataclass(frozen=True)
class Tried:
    """Branches at poses that the arm reaches with the joint values in these `points`: what each gives there
    for every name it works with, None where it is not real; `at_home` does the same to the point itself, with
    the joint values that are in it."""

    target: Target
    points: Sequence[Point]
    conditions: Sequence[Conditions]
    met: Sequence[Sequence[Values | None]]  # by point, then by branch
    at_home: Callable[[Point], Values]

    @cached_property
    def _there(self) -> tuple[tuple[bool, ...], ...]:
        """Of each branch whether it brings the end-effector to the poses at which it is real."""
        found: list[list[bool]] = [[] for _ in self.conditions]
        for point, branches in zip(self.points, self.met, strict=True):
            for there, values in zip(found, branches, strict=True):
                if values is not None:
                    there.append(self.target.reached(point, self._joints(values)))
        return tuple(map(tuple, found))

    @cached_property
    def reached(self) -> tuple[bool, ...]:
        """Whether it always does, and does so anywhere."""
        return tuple(bool(there) and all(there) for there in self._there)

    @property
    def partial(self) -> bool:
        """Whether some branches are solutions at some poses only, as where an arm has fewer joints than what
        is given has coordinates, so that they have to fulfil more equations than they are made from."""
        return self.target.spare and not all(self.reached)

    @property
    def solved(self) -> Iterator[tuple[int, Point, Values]]:
        """(branch, point, values of all names) wherever one reaches the pose."""
        for point, branches in zip(self.points, self.met, strict=True):
            for k, values in enumerate(branches):
                if values is not None and self.target.reached(point, self._joints(values)):
                    yield k, point, values

    @property
    def once(self) -> Iterator[tuple[int, Point, Values]]:
        """The same for every branch at the first pose that it reaches, and for the first of them at one more:
        what costs much is looked at there."""
        seen: list[int] = []
        for k, point, values in self.solved:
            if k not in seen or (k == seen[0] and seen.count(k) < MORE):
                seen.append(k)
                yield k, point, values

    def claims(self) -> Iterator[Claim]:
        """What has to hold; of a branch nothing where it need not reach."""
        for when, there, always in zip(self.conditions, self._there, self.reached, strict=True):
            if always or not self.target.spare:
                yield reaches(when, there)
        yield route("pose-found", map(self._found, self._each))
        yield route("when-holds", self._sorted())

    @property
    def _each(self) -> Iterator[tuple[Point, Sequence[Values | None]]]:
        return zip(self.points, self.met, strict=True)

    def _found(self, tried: tuple[Point, Sequence[Values | None]]) -> bool:
        """Whether the joint values a pose came from are among the solutions."""
        point, branches = tried
        return any(self._is_home(values, point) for values in branches)

    def _sorted(self) -> Iterator[bool]:
        """Whether the conditions of a branch hold of what it gives, and where they hold of the joint values a
        pose came from, that it gives these."""
        for k, _, values in self.solved:
            yield self._hold(self.conditions[k], values)
        for point, branches in self._each:
            home = self.at_home(point)
            meant = [k for k, when in enumerate(self.conditions) if self._hold(when, home)]
            same = [self._is_home(branches[k], point) for k in meant]
            yield any(same)
            if not self.target.spare:
                told = [all(isinstance(each, Relation) for each in self.conditions[k]) for k in meant]
                yield all(here for here, plain in zip(same, told, strict=True) if plain)

    def _hold(self, conditions: Conditions, known: Values) -> bool:
        """Whether the relations among these hold; of words nothing is known here."""
        return all(self._holds(each, known) for each in conditions if isinstance(each, Relation))

    def _holds(self, relation: Relation, known: Values) -> bool:
        value = side(relation, self.target, known)
        return value is not None and bool(value > 0 if relation.sign == ">" else value < 0)

    def _is_home(self, values: Values | None, point: Point) -> bool:
        return values is not None and self.target.same(values, point)

    def _joints(self, values: Values) -> Values:
        return {name: values[name] for name in self.target.joints}


def side(relation: Relation, target: Target, known: Values) -> float | None:
    """What should be positive or negative, an angle from -pi to pi; None of a relation that says no such
    thing."""
    left = relation.left
    if isinstance(left, Relation) or relation.right != ZERO or relation.sign not in "<>":
        return None
    turning = {Symbol(name) for name in target.joints if name not in target.slides}
    value = float(arrays(left, known))
    if turning >= {-term if is_negative(term) else term for term in terms_of(left)}:
        return math.remainder(value, 2 * math.pi)
    return value


def reaches(when: Conditions, there: Iterable[bool]) -> Claim:
    """That the branch with these conditions brings the end-effector to its place, wherever it is real."""
    if not when:
        return route("only-branch-reaches", there)
    first, *rest = when
    whole = reduce(lambda done, then: Phrase("also", {"first": done, "then": then}), rest, first)
    return route("branch-reaches", there, when=whole)


def as_printed(tried: Tried, branches: Sequence[Branch], order: Sequence[str]) -> Claim:
    """That the branches as results, with everything put in and in short formulas, have the values that were
    put back."""
    return route(
        "as-printed",
        (
            _prints(branches[k], order, _given(point, tried.target.joints), values)
            for k, point, values in tried.once
        ),
    )


def _prints(branch: Branch, order: Sequence[str], given: Values, values: Values) -> bool:
    """Both ways of writing one branch."""
    turn = [name for name in order if name in branch.values] or [*branch.values]
    written = [in_turn(branch.values, turn, given)]
    if order:
        written.append(in_turn(branch.short, order, given))
    return all(
        abs(found[name] - values[name]) <= SAME * max(1.0, abs(values[name]))
        for found in written
        for name in branch.values
    )


def _given(point: Point, joints: Sequence[str]) -> Values:
    return {name: value for name, value in point.items() if name not in joints}


def in_turn(formulas: Mapping[str, Expr], names: Sequence[str], given: Values) -> Values:
    """The values of formulas, each put into those after it. Raises as `compiled` does."""
    known = dict(given)
    for name in names:
        known[name] = compiled(formulas[name])(known)
    return known
