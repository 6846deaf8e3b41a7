"""Equations for the joint variables: the pose of the end-effector seen from the frames of the arm.

(T_i^0)^-1 T (T_e^j)^-1 = T_j^i moves the joints up to i and those after j to the side of the known pose
(Paul, Robot Manipulators, chapter 3): each entry is an equation in which some joints no longer occur. So does
its inverse, where the arm is seen from the end-effector.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.poses import homogeneous, inverse_pose


@dataclass(frozen=True, slots=True)
class Between:
    """The frames between which an equation is written; None is the end-effector's."""

    first: int | None
    last: int | None

    @property
    def reversed(self) -> bool:
        """Whether the first of them comes later in the arm."""
        return self.last is not None and (self.first is None or self.last < self.first)


Place: TypeAlias = tuple[Between, int, int]


@dataclass(frozen=True, slots=True)
class Equation:
    """One entry of T_last^first, counted from 0: column 3 is the position. left = right."""

    between: Between
    row: int
    col: int
    left: Scalar
    right: Scalar

    @property
    def place(self) -> Place:
        """Where it stands; no two equations of an arm stand in one place."""
        return self.between, self.row, self.col

    @property
    def is_position(self) -> bool:
        """Whether it compares lengths; else cosines of directions."""
        return self.col == 3


@dataclass(frozen=True, slots=True)
class Frames:
    """The poses of the frames of an arm, or of its part after frame `base`, in that frame; `end` is the
    end-effector's. `moving` are the rows that move."""

    T: Mapping[int, ScalarMatrix]
    end: ScalarMatrix
    moving: tuple[int, ...]
    base: int = 0

    @staticmethod
    def of(chain: Chain, home: Ring, base: int = 0, last: int | None = None) -> Frames:
        """From frame `base` to the end-effector, or to frame `last`, whose origin ends the part then."""
        whole = [T.into(home) for T in chain.T]
        back = inverse_pose(whole[base]) if base else None
        stop = len(whole) - 1 if last is None else last
        T = {i: back @ whole[i] if back else whole[i] for i in range(base, stop + 1)}
        end = chain.T_tool.into(home) if last is None else whole[last]
        rows = tuple(i for i, _ in chain.moving if base < i <= stop)
        return Frames(T, back @ end if back else end, rows, base)

    def seen_from(self, i: int, T: ScalarMatrix) -> ScalarMatrix:
        """A pose (or points in columns, 4 high) given in the base, in frame i."""
        return T if i == self.base else inverse_pose(self.T[i]) @ T


def position_equations(
    frames: Frames, goal: Sequence[Scalar | None], point: ScalarMatrix
) -> Iterator[Equation]:
    """The position of a point (3 by 1, in the end's frame) seen from each frame; from the base alone where
    a coordinate is not known."""
    there = frames.end @ ScalarMatrix.column((*point.entries, 1))
    whole = None not in goal
    known = ScalarMatrix.column([*(part if part is not None else 0 for part in goal), 1])
    for i in (frames.base, *(frames.moving if whole else ())):
        left, right = frames.seen_from(i, known), frames.seen_from(i, there)
        for row in range(3):
            if goal[row] is not None or whole:
                yield Equation(Between(i, None), row, 3, left[row, 0], right[row, 0])


def centre_equations(frames: Frames, goal: Sequence[Scalar], point: ScalarMatrix) -> Iterator[Equation]:
    """The position of a point (3 by 1) of the base frame of a part, known in the end-effector's frame
    (`goal`), seen from that, from each frame of the part, and from those after its last joint."""
    known, there = (ScalarMatrix.column((*part, 1)) for part in (goal, point.entries))
    for i in (None, *(row - 1 for row in frames.moving), *range(frames.moving[-1], max(frames.T) + 1)):
        back = inverse_pose(frames.end if i is None else frames.T[i])
        left, right = (known if i is None else back @ frames.end @ known), back @ there
        for row in range(3):
            yield Equation(Between(i, None), row, 3, left[row, 0], right[row, 0])


def pose_equations(frames: Frames, R: ScalarMatrix, p: Sequence[Scalar] | None) -> Iterator[Equation]:
    """The pose seen from each frame towards each later one; the orientation alone without `p`."""
    pose = homogeneous(R, p or (0, 0, 0))
    width = 4 if p else 3
    for i in (frames.base, *frames.moving):
        left = frames.seen_from(i, pose)
        yield from _entries(Between(i, None), left, frames.seen_from(i, frames.end), width)
        for j in (row - 1 for row in frames.moving):
            if j > i:
                after = inverse_pose(inverse_pose(frames.T[j]) @ frames.end)
                yield from _entries(Between(i, j), left @ after, frames.seen_from(i, frames.T[j]), width)


def reversed_equations(frames: Frames, R: ScalarMatrix, p: Sequence[Scalar]) -> Iterator[Equation]:
    """The position of each frame seen from each later one and from the end-effector: the same chain taken
    from its other end, (T_e^j) T^-1 T_i^0 = T_i^j."""
    back = homogeneous(R.T, (-(R.T @ ScalarMatrix.column(p))).entries)
    for j in (None, *(row - 1 for row in frames.moving)):
        inside = inverse_pose(frames.end if j is None else frames.T[j])
        known = back if j is None else inside @ frames.end @ back
        for i in (frames.base, *frames.moving):
            if j is None or i < j:
                left, right = known @ frames.T[i], inside @ frames.T[i]
                yield from (Equation(Between(j, i), row, 3, left[row, 3], right[row, 3]) for row in range(3))


def _entries(between: Between, left: ScalarMatrix, right: ScalarMatrix, width: int) -> Iterator[Equation]:
    for row in range(3):
        for col in range(width):
            yield Equation(between, row, col, left[row, col], right[row, col])
