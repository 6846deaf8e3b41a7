"""The solutions at one pose: those that reach it, each once, with what is free where the arm is singular.

There an arm can move its joints without moving the end-effector: a self-motion (Siciliano et al., section
3.5.1). Its joints are tried a little to each side to see which of them move, and which sums of them stay.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any, TypeAlias

from derive.algebra.infix import text
from derive.derivation import Condition, Phrase
from derive.expression import Expr, Symbol
from derive.kinds.robot._inverse.at_pose import Configuration
from derive.kinds.robot._inverse.signs import signed
from derive.kinds.robot._inverse.target import SAME, Target, Values, gap

# of a branch (its number): what is pinned (by the number of the sub-problem), to what any other is pinned
# that is open, and whether only what vanishes exactly counts as open
Configurations: TypeAlias = Callable[[int, Mapping[int, float], float, bool], Iterable[Configuration]]
GRID = math.radians(10)
PINS = (0.0, *(n * GRID for k in range(1, 18) for n in (k, -k)), math.pi)
NEAR, SECTIONS, GOLDEN = 0.15, 42, (math.sqrt(5) - 1) / 2
STEPS = (0.1, -0.1, 0.01, -0.01)  # by which a free unknown is moved to see what goes with it
MOVED = 1e-4  # of a joint: that went with it
SNAP = 1e-7  # radians or metres from zero or a right angle, which only rounding leaves
EXACT = 1e-9  # by how much a rounder value may miss the pose more


@dataclass(frozen=True, slots=True)
class SelfMotion:
    """`names` can move, `count` of them at will and the others with them; `fixed` are sums and differences of
    two of the angles that do not, with their values."""

    names: tuple[str, ...]
    fixed: Mapping[Expr, float]
    count: int = 1


@dataclass(frozen=True, slots=True)
class Solution:
    """Joint values that reach the pose, the branches (from 0) that have them, and what is free."""

    values: Values
    branches: tuple[int, ...]
    self_motion: SelfMotion | None = None


@dataclass(frozen=True, slots=True)
class Distinct:
    """What is sought, a value for every name there (`wanted`), and the configurations of each branch. `size`
    is a length of the arm, `tolerance` how far off an end-effector may stand, in it."""

    target: Target
    configurations: Configurations
    wanted: Mapping[str, float]
    size: float
    tolerance: float

    def solutions(self, branches: int) -> list[Solution]:
        """Of all branches, in their order; those that coincide once."""
        found: list[Solution] = []
        for k in range(branches):
            for each in self._reaching(k):
                values = self._rounded(each.values)
                same = next(
                    (n for n, other in enumerate(found) if self.target.same(other.values, values)), None
                )
                if same is None:
                    found.append(Solution(values, (k,), self._self_motion(k, each)))
                else:
                    found[same] = self._joined(found[same], values, k)
        return found

    def _reaching(self, k: int) -> list[Configuration]:
        """Those of a branch. Where an unknown is open but not every value of it will do, the first that does;
        where it is open in its own equations only, the values that the others leave it."""
        tried = list(self.configurations(k, {}, 0.0, False))
        found = self._of(tried) or self._of(self.configurations(k, {}, 0.0, True))
        pinned = sorted({number for each in tried for number in each.pinned})
        if not pinned or self._is_family(k, found):
            return found
        for pins in ({pinned[0]: 0.0}, {}) if len(pinned) > 1 else ({},):
            if there := self._around(k, pins):
                return [*found, *there]
        return found

    def _around(self, k: int, pins: Mapping[int, float]) -> list[Configuration]:
        """With what is open and not among the pins taken all around: at the first place of a family, or
        wherever the end-effector comes nearest."""
        for usual in PINS:
            there = self._of(self.configurations(k, pins, usual, False))
            if self._is_family(k, there):
                return there
        return [
            each
            for usual in self._nearest(k, pins)
            for each in self._of(self.configurations(k, pins, usual, False))
        ]

    def _is_family(self, k: int, there: Sequence[Configuration]) -> bool:
        return any(self._self_motion(k, each) for each in there)

    def _nearest(self, k: int, pins: Mapping[int, float]) -> Iterator[float]:
        """By golden sections between the places tried."""

        def off(usual: float) -> float:
            there = self.configurations(k, pins, usual, False)
            return min((self._misses(each.values) for each in there if each.values), default=math.inf)

        around = sorted(PINS)
        tried = [off(usual) for usual in around]
        for place, here in enumerate(tried):
            if here < NEAR and here <= tried[place - 1] and here < tried[(place + 1) % len(tried)]:
                yield lowest(off, around[place] - GRID, around[place] + GRID)

    def _of(self, tried: Iterable[Configuration]) -> list[Configuration]:
        """Those that reach the pose."""
        return [each for each in tried if each.values and self._misses(each.values) < self.tolerance]

    def _misses(self, values: Values) -> float:
        return self.target.misses(self.wanted, values, self.size)

    # -- what is listed ---------------------------------------------------------------------------

    def _rounded(self, values: Values) -> Values:
        """Angles in (-pi, pi]; zero and right angles as such where that reaches the pose as well, all
        together or each by itself."""
        slides = self.target.slides
        turned = {name: value if name in slides else wrapped(value) for name, value in values.items()}
        near = {name: self._near(name, value) for name, value in turned.items()}
        least = self._misses(turned) + EXACT
        for change in (near, *({name: value} for name, value in near.items())):
            if change.items() - turned.items() and self._misses({**turned, **change}) <= least:
                turned |= change
        return {name: value + 0.0 for name, value in turned.items()}  # no negative zero

    def _near(self, name: str, value: float) -> float:
        if name in self.target.slides:
            return 0.0 if abs(value) < SNAP else value
        return wrapped(rounder(value))

    def _joined(self, found: Solution, values: Values, k: int) -> Solution:
        """The middle of two that meet: rounding leaves one on each side of it."""
        gaps = self.target.gaps(values, found.values)
        middle = self._rounded({name: found.values[name] + each / 2 for name, each in gaps.items()})
        better = middle if self._misses(middle) <= self._misses(found.values) else found.values
        return replace(found, values=better, branches=(*found.branches, k))

    # -- what is free -----------------------------------------------------------------------------

    def _self_motion(self, k: int, here: Configuration) -> SelfMotion | None:
        """What moves with the unknowns that were pinned, where they can be moved."""
        names: set[str] = set()
        fixed: dict[Expr, float] = {}
        count = 0
        for number, value in here.pinned.items():
            other = self._moved(k, here, number, value)
            if other is None:
                continue
            count += 1
            gaps = self.target.gaps(other, here.values)
            moved = [name for name, each in gaps.items() if abs(each) > MOVED]
            names.update(moved)
            fixed.update(self._tied(moved, here.values, other))
        ordered = tuple(name for name in self.target.joints if name in names)
        return SelfMotion(ordered, fixed, count) if names else None

    def _moved(self, k: int, here: Configuration, number: int, value: float) -> Values | None:
        """The nearest solution with one of the pinned unknowns moved."""
        for step in STEPS:
            pins = {**here.pinned, number: value + step}
            if there := self._of(self.configurations(k, pins, 0.0, False)):
                return self._nearest_to(here, there)
        if len(here.pinned) == 1 or number != min(here.pinned):
            return None
        return self._nearest_to(here, self._around(k, {number: value + STEPS[0]}))

    def _nearest_to(self, here: Configuration, there: Iterable[Configuration]) -> Values | None:
        def apart(values: Values) -> float:
            return sum(map(abs, self.target.gaps(values, here.values).values()))

        return min((each.values for each in there), key=apart, default=None)

    def _tied(self, moved: Sequence[str], here: Values, there: Values) -> Iterator[tuple[Expr, float]]:
        """Sums and differences of two angles that did not change while both did."""
        for one, other in combinations([name for name in moved if name not in self.target.slides], 2):
            for sign in (1, -1):
                before, after = (each[one] + sign * each[other] for each in (here, there))
                if abs(gap(after, before)) < SAME + 2 * self.tolerance:
                    yield Symbol(one) + signed(sign, Symbol(other)), rounder(wrapped(before))


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


def listed(
    found: Sequence[Solution], conditions: Sequence[Sequence[Condition]], real: Sequence[bool], spare: bool
) -> list[dict[str, Any]]:
    """As the JSON lists it, in the order of the branches: one without a solution is not real. Where a pose
    has more coordinates than the arm joints (`spare`), `true_at` says whether a branch meets all of them.
    `real` says of each branch whether its formulas have values."""
    entries: list[dict[str, Any]] = []
    for each in in_order(found, len(conditions)):
        k = each.branches[0]
        own = conditions[k]
        if not each.values:
            missed = {"true_at": False} if spare and real[k] else {}
            entries.append({"when": tuple(own), "real": False, **missed})
            continue
        shared = [c for c in own if all(c in conditions[other] for other in each.branches)]
        entries.append({**each.values, "when": tuple(shared), **({"true_at": True} if spare else {})})
        if motion := each.self_motion:
            entries[-1]["when"] = (*shared, free(motion))
            fixed = {text(tree): value for tree, value in motion.fixed.items()}
            entries[-1] |= {"free": list(motion.names), "fixed": fixed}
    return entries


def in_order(found: Sequence[Solution], branches: int) -> Iterator[Solution]:
    """By the first branch that each is of; a branch without a solution has one without values."""
    for k in range(branches):
        yield from (each for each in found if each.branches[0] == k)
        if not any(k in each.branches for each in found):
            yield Solution({}, (k,))


def free(motion: SelfMotion) -> Phrase:
    """What is free, and what is determined nevertheless."""
    first, *others = names = tuple(map(Symbol, motion.names))
    if motion.fixed and len(others) == 1:
        return Phrase("free-but-for", {"free": first, "determined": tuple(motion.fixed)})
    if others and motion.count == len(names):
        return Phrase("all-free", {"names": names})
    return Phrase("free-with" if others else "free", {"free": first, "others": tuple(others)})
