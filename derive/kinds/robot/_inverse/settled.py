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

Leaves: TypeAlias = Callable[[int, Mapping[int, float], float], Iterable[Leaf]]  # branch, pins, what is usual
PINS = (0.0, *(math.radians(n) for k in range(1, 36) for n in (5 * k, -5 * k)), math.pi)
STEP = 0.01  # by which a free unknown is moved to see what goes with it
MOVED = 1e-4  # of a joint: that went with it
SNAP = 1e-7  # radians or metres from zero or a right angle, which only rounding leaves
EXACT = 1e-9  # by how much a rounder value may miss the pose more


@dataclass(frozen=True, slots=True)
class Freedom:
    """`names` can be chosen together at will; `fixed` is a sum or difference of two angles, with its value,
    where these two alone are free."""

    names: tuple[str, ...]
    fixed: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Solution:
    """Joint values that reach the pose, the branches (from 0) that have them, and what is free."""

    values: Values
    branches: tuple[int, ...]
    freedom: Freedom | None = None


@dataclass(frozen=True)
class Settled:
    """`wanted` are the values of every name, `tolerance` how far off an end-effector may stand (in lengths of
    the arm, `size`)."""

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
        """Where an unknown is open but not every value of it will do, the first that does."""
        for usual in PINS:
            leaves = list(self.leaves(k, {}, usual))
            there = [leaf for leaf in leaves if self.reaches(leaf)]
            if there or not any(leaf.pinned for leaf in leaves):
                return there
        return []

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
        """Angles in (-pi, pi]; zero and right angles as such where that reaches the pose as well."""
        turned = {name: value if name in self.slides else wrapped(value) for name, value in values.items()}
        rounder = {name: self._rounder(name, value) for name, value in turned.items()}
        if rounder != turned and self.misses(rounder) > self.misses(turned) + EXACT:
            return turned
        return {name: value if name in self.slides else wrapped(value) for name, value in rounder.items()}

    def _rounder(self, name: str, value: float) -> float:
        quarters = 0 if name in self.slides else round(value / (math.pi / 2))
        near = quarters * (math.pi / 2)
        return near if abs(value - near) < SNAP else value + 0.0  # no negative zero

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
        for number, value in leaf.pinned.items():
            other = self._moved(k, leaf, number, value)
            if other is None:
                continue
            moved = [n for n in self.joints if abs(gap(other[n], leaf.values[n], n in self.slides)) > MOVED]
            names.update(dict.fromkeys(moved))
            fixed.update(self._tied(moved, leaf.values, other))
        return Freedom(tuple(n for n in self.joints if n in names), fixed) if names else None

    def _moved(self, k: int, leaf: Leaf, number: int, value: float) -> Values | None:
        """The nearest solution with one of the pinned unknowns moved."""
        for step in (STEP, -STEP):
            pins = {**leaf.pinned, number: value + step}
            there = [each.values for each in self.leaves(k, pins, 0.0) if self.reaches(each)]
            if there:
                return min(there, key=lambda each: self._apart(each, leaf.values))
        return None

    def _apart(self, one: Values, other: Values) -> float:
        return sum(abs(gap(one[n], other[n], n in self.slides)) for n in self.joints)

    def _tied(self, moved: Sequence[str], here: Values, there: Values) -> Iterator[tuple[str, float]]:
        """The sum or the difference of two angles that did not change while both did."""
        if len(moved) != 2 or set(moved) & self.slides:
            return
        for one, other in combinations(moved, 2):
            for sign, operator in ((1, "+"), (-1, "-")):
                before, after = (each[one] + sign * each[other] for each in (here, there))
                if abs(gap(after, before, False)) < SAME + 2 * self.tolerance:
                    yield f"{one} {operator} {other}", self._rounder("", wrapped(before))


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
    if freedom.fixed:
        said = f"where {first} is free: only {' and '.join(freedom.fixed)} is determined"
    else:
        said = f"where {first} is free" + (f", and {' and '.join(others)} with it" if others else "")
    return ", ".join((*conditions, said))
