"""Where the equations of a sub-problem are said to be read: as the unknown moves, the elements that are told
miss the pose by as much as the equations fail, up to a number in front."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.arrays import arrays
from derive.expression import Symbol, free_symbols
from derive.kinds.robot._chain import TOOL
from derive.kinds.robot._inverse.facts import Compared
from derive.kinds.robot._inverse.subproblem import Solved, course
from derive.kinds.robot._inverse.target import Target, Values

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

MOVES = (0.3, -0.5, 1.1)  # of the unknown
SAME, NONE = 1e-6, 1e-9


@dataclass(frozen=True, slots=True)
class Reading:
    """An arm at a solution: `known` are the values of all names there, `given` the poses that are known, by
    their names. A spherical wrist has the frame `inside` before it, a `shoulder` that after it, and its
    `centre` (4) in that."""

    target: Target
    known: Values
    given: Mapping[str, Array]
    inside: int
    centre: Array
    shoulder: bool

    def right(self, solved: Solved, before: Sequence[Solved]) -> Iterator[bool]:
        """Whether each equation is read somewhere, and every element told is read by an equation."""
        turning = [name for name in self.target.joints if name not in self.target.slides]
        if again := solved.facts.again:
            yield not solved.compared or any(each.compared == solved.compared for each in before)
            yield again.about["known"] == before[-1].facts.called
        if not solved.compared:  # made of equations before, which are read there
            return
        rates = course(solved, before, turning)
        moved = [
            {**self.known, **{name: self.known[name] + by * rate for name, rate in rates.items()}}
            for by in MOVES
        ]
        told = solved.equations or tuple((step.chain[0], step.chain[1]) for step in solved.facts.solved)
        failed = [[float(arrays(left, at) - arrays(right, at)) for at in moved] for left, right in told]
        missed = [element for each in solved.compared for element in self._missed(each, solved, moved)]
        if solved.facts.squares:  # a coordinate among those squared may not move with the unknown
            still = [sum(map(_is_still, each)) for each in (failed, missed)]
            yield still[0] == still[1] < len(failed)
            failed = [one for one in failed if not _is_still(one)]
            missed = [one for one in missed if not _is_still(one)]
        yield from (any(_alike(one, other) for other in missed) for one in failed)
        yield from (any(_alike(one, other) for one in failed) for other in missed)

    def _missed(self, told: Compared, solved: Solved, moved: Sequence[Values]) -> Iterator[Sequence[float]]:
        """Of each coordinate or element how far it is off, at these places."""
        if told.axes:
            gaps = [self._off(told, at) for at in moved]
            yield from ([gap["xyz".index(axis)] for gap in gaps] for axis in told.axes)
            return
        there = [self._differs(told, solved.stage, at) for at in moved]
        for entry in told.entries:
            i, j = (int(n) - 1 for n in entry.strip("()").split(", "))
            yield [T[i, j] for T in there]

    def _off(self, told: Compared, at: Values) -> Array:
        """From the point to its place, in the axes of the frame."""
        import numpy as np

        inside, centre = str(self.inside), self.centre
        if told.centre == "shoulder":  # its place is known in the end-effector's frame
            frame = TOOL if told.frame is None else str(told.frame)
            place = self._between(inside, TOOL, self.known) @ centre
            return np.array(
                (self._between(TOOL, frame, at) @ place - self._between(inside, frame, at) @ centre)[:3]
            )
        R = self._pose("0" if told.frame is None else str(told.frame), at)[:3, :3]
        if told.centre is None:
            gap = self._pose(TOOL, self.known) - self._pose(TOOL, at)
            return np.array(R.T @ gap[:3, 3])
        here, there = (self._pose(inside, each) for each in (at, self.known))
        return np.array(R.T @ ((there - here) @ centre)[:3])

    def _differs(self, told: Compared, stage: str, at: Values) -> Array:
        """The product that is known less what it is said to equal, by itself the pose of the end-effector."""
        assert told.product is not None
        meaning: dict[str, Any] = {**at, **self.given}
        for name in free_symbols(told.product) - meaning.keys():
            meaning[name] = self._named(name, at)
        known: Array = arrays(told.product, meaning)
        if told.equals is not None:
            return known - self._named(told.equals.name, at)
        hand = stage == "hand"
        if stage == "shoulder":
            assert isinstance(told.product, Symbol)
            return known - self._named(told.product.name, at)
        if hand and self.shoulder:
            T = self._pose(str(self.inside), at)
        else:
            T = self._between(TOOL, str(self.inside if hand else 0), at)
        return known - T[: len(known), : len(known)]

    def _named(self, name: str, at: Values) -> Array:
        """T_2^0 or R_2^0."""
        letter, _, frames = name.partition("_")
        of, seen_from = frames.split("^")
        T = self._between(of, seen_from, at)
        return T[:3, :3] if letter == "R" else T

    def _between(self, of: str, seen_from: str, at: Values) -> Array:
        import numpy as np

        T: Array = np.linalg.solve(self._pose(seen_from, at), self._pose(of, at))
        return T

    def _pose(self, frame: str, at: Values) -> Array:
        """T (4 by 4) of a frame in the base, which is frame 0."""
        import numpy as np

        if frame == "0":
            return np.eye(4)
        oracle = self.target.oracle
        return oracle.tool(at) if frame == TOOL else oracle.poses(at)[int(frame)]


def _is_still(gaps: Sequence[float]) -> bool:
    """Whether it is not off at all."""
    return max(map(abs, gaps)) < NONE


def _alike(one: Sequence[float], other: Sequence[float]) -> bool:
    """Whether they have a ratio that does not change, and are not all zero."""
    size, scale = (max(map(abs, each)) for each in (one, other))
    if min(size, scale) < NONE:
        return False
    k = max(range(len(one)), key=lambda n: abs(other[n]))
    ratio = one[k] / other[k]
    return all(abs(a - ratio * b) < SAME * size for a, b in zip(one, other, strict=True))
