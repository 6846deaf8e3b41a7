"""The solutions at one pose: those that reach it, each once, with what is free where the arm is singular."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any, TypeAlias

from derive.kinds.robot._inverse.checks import SAME, gap, plain
from derive.kinds.robot._inverse.numbers import Leaf, Values
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.oracle import Oracle

Leaves: TypeAlias = Callable[[int, Mapping[int, float], float, bool], Iterable[Leaf]]
GRID = math.radians(10)
PINS = (0.0, *(n * GRID for k in range(1, 18) for n in (k, -k)), math.pi)
NEAR, SECTIONS, GOLDEN = 0.15, 42, (math.sqrt(5) - 1) / 2
STEPS = (0.1, -0.1, 0.01, -0.01)  # by which a free unknown is moved to see what goes with it
MOVED = 1e-4  # of a joint: that went with it
SNAP = 1e-7  # radians or metres from zero or a right angle, which only rounding leaves
EXACT = 1e-9  # by how much a rounder value may miss the pose more


@dataclass(frozen=True, slots=True)
class Freedom:
    """`names` can move, `count` of them at will and the others with them; `fixed` are sums and differences of
    two of the angles that do not, with their values."""

    names: tuple[str, ...]
    fixed: Mapping[str, float]
    count: int = 1


@dataclass(frozen=True, slots=True)
class Solution:
    """Joint values that reach the pose, the branches (from 0) that have them, and what is free."""

    values: Values
    branches: tuple[int, ...]
    freedom: Freedom | None = None


@dataclass(frozen=True)
class Settled:
    """`leaves` gives the values of a branch by its number, the moves that are pinned, to what others are
    pinned where they are open, and whether only what vanishes exactly counts as open. `wanted` are the values
    of every name, `tolerance` how far off an end-effector may stand (in lengths of the arm, `size`)."""

    oracle: Oracle
    goal: Goal
    joints: tuple[str, ...]
    slides: frozenset[str]
    leaves: Leaves
    wanted: Mapping[str, float]
    size: float
    tolerance: float

    def solutions(self, branches: int) -> list[Solution]:
        """Of all branches, in their order; those that coincide once."""
        found: list[Solution] = []
        for k in range(branches):
            for leaf in self._reaching(k):
                values = self._rounded(leaf.values)
                same = next((n for n, each in enumerate(found) if self._same(each.values, values)), None)
                if same is None:
                    found.append(Solution(values, (k,), self._freedom(k, leaf)))
                else:
                    found[same] = self._joined(found[same], values, k)
        return found

    def _reaching(self, k: int) -> list[Leaf]:
        """Those of a branch. Where an unknown is open but not every value of it will do, the first that does;
        where it is open in its own equations only, the values that the others leave it."""
        tried = list(self.leaves(k, {}, 0.0, False))
        found: list[Leaf] = []
        for leaves in (tried, self.leaves(k, {}, 0.0, True)):
            found = found or [*filter(self.reaches, leaves)]
        pinned = sorted({number for leaf in tried for number in leaf.pinned})
        if not pinned or self._is_family(k, found):
            return found
        for pins in ({pinned[0]: 0.0}, {}) if len(pinned) > 1 else ({},):
            if there := self._around(k, pins):
                return [*found, *there]
        return found

    def _around(self, k: int, pins: Mapping[int, float]) -> list[Leaf]:
        """With what is open and not among the pins taken all around: at the first place of a family, or
        wherever the end-effector comes nearest."""
        for usual in PINS:
            there = [*filter(self.reaches, self.leaves(k, pins, usual, False))]
            if self._is_family(k, there):
                return there
        places = self._nearest(k, pins)
        return [leaf for usual in places for leaf in self.leaves(k, pins, usual, False) if self.reaches(leaf)]

    def _is_family(self, k: int, leaves: Sequence[Leaf]) -> bool:
        return any(self._freedom(k, leaf) for leaf in leaves)

    def _nearest(self, k: int, pins: Mapping[int, float]) -> Iterator[float]:
        """By golden sections between the places tried."""

        def off(usual: float) -> float:
            leaves = self.leaves(k, pins, usual, False)
            return min((self.misses(leaf.values) for leaf in leaves if leaf.values), default=math.inf)

        around = sorted(PINS)
        tried = [off(usual) for usual in around]
        for place, here in enumerate(tried):
            if here < NEAR and here <= tried[place - 1] and here < tried[(place + 1) % len(tried)]:
                yield lowest(off, around[place] - GRID, around[place] + GRID)

    def reaches(self, leaf: Leaf) -> bool:
        return bool(leaf.values) and self.misses(leaf.values) < self.tolerance

    def misses(self, values: Values) -> float:
        """How far off the end-effector stands, in lengths of the arm and in elements of R."""
        here = self.goal.numbers(self.oracle.tool({**self.wanted, **values}))
        scale = [self.size if place[1] == 3 else 1.0 for place in self.goal.places.values()] + [1.0, 1.0]
        pairs = zip(
            plain(self.goal, here), plain(self.goal, {n: self.wanted[n] for n in here}), scale, strict=False
        )
        return max(abs(one - other) / size for one, other, size in pairs)

    # -- what is listed ---------------------------------------------------------------------------

    def _rounded(self, values: Values) -> Values:
        """Angles in (-pi, pi]; zero and right angles as such where that reaches the pose as well, all
        together or each by itself."""
        turned = {name: value if name in self.slides else wrapped(value) for name, value in values.items()}
        near = {name: self._near(name, value) for name, value in turned.items()}
        least = self.misses(turned) + EXACT
        for change in (near, *({name: value} for name, value in near.items())):
            if change.items() - turned.items() and self.misses({**turned, **change}) <= least:
                turned |= change
        return {name: value + 0.0 for name, value in turned.items()}  # no negative zero

    def _near(self, name: str, value: float) -> float:
        if name in self.slides:
            return 0.0 if abs(value) < SNAP else value
        return wrapped(rounder(value))

    def _same(self, one: Values, other: Values) -> bool:
        return all(abs(gap(one[n], other[n], n in self.slides)) < SAME for n in self.joints)

    def _joined(self, found: Solution, values: Values, k: int) -> Solution:
        """The middle of two that meet: rounding leaves one on each side of it."""
        middle = {
            n: found.values[n] + gap(values[n], found.values[n], n in self.slides) / 2 for n in self.joints
        }
        middle = self._rounded(middle)
        better = middle if self.misses(middle) <= self.misses(found.values) else found.values
        return replace(found, values=better, branches=(*found.branches, k))

    # -- what is free -----------------------------------------------------------------------------

    def _freedom(self, k: int, leaf: Leaf) -> Freedom | None:
        """What moves with the unknowns that were pinned, where they can be moved."""
        names: dict[str, None] = {}
        fixed: dict[str, float] = {}
        count = 0
        for number, value in leaf.pinned.items():
            other = self._moved(k, leaf, number, value)
            if other is None:
                continue
            count += 1
            moved = [n for n in self.joints if abs(gap(other[n], leaf.values[n], n in self.slides)) > MOVED]
            names.update(dict.fromkeys(moved))
            fixed.update(self._tied(moved, leaf.values, other))
        return Freedom(tuple(n for n in self.joints if n in names), fixed, count) if names else None

    def _moved(self, k: int, leaf: Leaf, number: int, value: float) -> Values | None:
        """The nearest solution with one of the pinned unknowns moved."""
        for step in STEPS:
            pins = {**leaf.pinned, number: value + step}
            there = [each.values for each in self.leaves(k, pins, 0.0, False) if self.reaches(each)]
            if there:
                return min(there, key=lambda each: self._apart(each, leaf.values))
        if len(leaf.pinned) == 1 or number != min(leaf.pinned):
            return None
        found = [each.values for each in self._around(k, {number: value + STEPS[0]})]
        return min(found, key=lambda each: self._apart(each, leaf.values), default=None)

    def _apart(self, one: Values, other: Values) -> float:
        return sum(abs(gap(one[n], other[n], n in self.slides)) for n in self.joints)

    def _tied(self, moved: Sequence[str], here: Values, there: Values) -> Iterator[tuple[str, float]]:
        """Sums and differences of two angles that did not change while both did."""
        for one, other in combinations([name for name in moved if name not in self.slides], 2):
            for sign, operator in ((1, "+"), (-1, "-")):
                before, after = (each[one] + sign * each[other] for each in (here, there))
                if abs(gap(after, before, False)) < SAME + 2 * self.tolerance:
                    yield f"{one} {operator} {other}", rounder(wrapped(before))


def lowest(value: Callable[[float], float], low: float, high: float) -> float:
    """Where a function with one minimum between two places is least, by golden sections."""
    for _ in range(SECTIONS):
        left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        low, high = (low, right) if value(left) < value(right) else (left, high)
    return (low + high) / 2


def rounder(angle: float) -> float:
    """Zero or a right angle where it is very near to one."""
    near = round(angle / (math.pi / 2)) * (math.pi / 2)
    return near if abs(angle - near) < SNAP else angle


def wrapped(angle: float) -> float:
    """In (-pi, pi]."""
    turned = math.remainder(angle, 2 * math.pi)
    return math.pi if turned <= -math.pi + 1e-12 else turned + 0.0


def told(
    found: Sequence[Solution], conditions: Sequence[Sequence[str]], real: Sequence[bool], spare: bool
) -> list[dict[str, Any]]:
    """As the JSON says it, in the order of the branches: one without a solution is not real. Where a pose has
    more coordinates than the arm joints (`spare`), `true_at` says whether a branch meets all of them. `real`
    says of each branch whether its formulas have values."""
    listed: list[dict[str, Any]] = []
    for k, own in enumerate(conditions):
        for each in found:
            if each.branches[0] == k:
                shared = [c for c in own if all(c in conditions[other] for other in each.branches)]
                listed.append({**each.values, "when": _said(shared, each.freedom), **_more(each.freedom)})
                listed[-1] |= {"true_at": True} if spare else {}
        if not any(k in each.branches for each in found):
            listed.append({"when": ", ".join(own), "real": False})
            listed[-1] |= {"true_at": False} if spare and real[k] else {}
    return listed


def _more(freedom: Freedom | None) -> dict[str, Any]:
    return {"free": list(freedom.names), "fixed": dict(freedom.fixed)} if freedom else {}


def _said(conditions: Sequence[str], freedom: Freedom | None) -> str:
    """The conditions that all branches share, and what is free in words."""
    if freedom is None:
        return ", ".join(conditions)
    first, *others = freedom.names
    if freedom.fixed and len(others) == 1:
        said = f"where {first} is free: only {' and '.join(freedom.fixed)} is determined"
    elif others and freedom.count == len(freedom.names):
        said = f"where {' and '.join(freedom.names)} are free"
    else:
        said = f"where {first} is free" + (f", and {' and '.join(others)} with it" if others else "")
    return ", ".join((*conditions, said))
