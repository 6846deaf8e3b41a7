"""Equations for the joint variables: the pose of the end-effector seen from the frames of the arm.

(T_i^0)^-1 T (T_e^j)^-1 = T_j^i moves the joints up to i and those after j to the side of the known pose
(Paul, Robot Manipulators, chapter 3): each entry is an equation in which some joints no longer occur.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.poses import homogeneous, inverse_pose, rotation_part


@dataclass(frozen=True, slots=True)
class View:
    """The frames between which an equation is written; `last` None is the end-effector."""

    first: int
    last: int | None


@dataclass(frozen=True, slots=True)
class Equation:
    """One entry of a view, counted from 0: column 3 is the position. left = right."""

    view: View
    row: int
    col: int
    left: Scalar
    right: Scalar

    @property
    def is_position(self) -> bool:
        return self.col == 3


def position_equations(chain: Chain, goal: Goal, home: Ring) -> Iterator[Equation]:
    """The position seen from each frame; from the base alone where a coordinate is not known."""
    target = chain.T_tool.into(home)
    frames = [0, *(i for i, _ in chain.moving)] if goal.whole_position else [0]
    for i in frames:
        left, right = _seen(chain, goal, home, i), _rest(chain, target, home, i)
        for row in range(3):
            known = left[row]
            if known is not None:
                yield Equation(View(i, None), row, 3, known, right[row, 3])


def _rest(chain: Chain, target: ScalarMatrix, home: Ring, i: int) -> ScalarMatrix:
    return inverse_pose(chain.T[i].into(home)) @ target if i else target


def _seen(chain: Chain, goal: Goal, home: Ring, i: int) -> tuple[Scalar | None, ...]:
    if i == 0:
        return goal.p
    p = ScalarMatrix.column([*(part for part in goal.p if part is not None), 1])
    return (inverse_pose(chain.T[i].into(home)) @ p).columns(0).entries[:3]


def orientation_equations(chain: Chain, goal: Goal, home: Ring) -> Iterator[Equation]:
    """The orientation seen from each frame towards each later one."""
    if goal.R is None:
        return
    pose = homogeneous(goal.R, (0, 0, 0))
    for equation in _views(chain, pose, home):
        if equation.col < 3:
            yield equation


def pose_equations(chain: Chain, goal: Goal, home: Ring) -> Iterator[Equation]:
    """The whole pose seen from each frame towards each later one."""
    if goal.R is None or not goal.whole_position:
        return
    yield from _views(chain, homogeneous(goal.R, [part for part in goal.p if part is not None]), home)


def _views(chain: Chain, pose: ScalarMatrix, home: Ring) -> Iterator[Equation]:
    rows = [i for i, _ in chain.moving]
    T_0 = {i: chain.T[i].into(home) for i in range(len(chain.T))}
    T_e = chain.T_tool.into(home)
    for i in (0, *rows):
        left = inverse_pose(T_0[i]) @ pose if i else pose
        yield from _entries(View(i, None), left, inverse_pose(T_0[i]) @ T_e if i else T_e)
        for j in (row - 1 for row in rows):
            if j > i:
                after = inverse_pose(inverse_pose(T_0[j]) @ T_e)
                yield from _entries(View(i, j), left @ after, inverse_pose(T_0[i]) @ T_0[j])


def _entries(view: View, left: ScalarMatrix, right: ScalarMatrix) -> Iterator[Equation]:
    for row in range(3):
        for col in range(4):
            yield Equation(view, row, col, left[row, col], right[row, col])


def rotation_of(chain: Chain, first: int) -> ScalarMatrix:
    """R of the end-effector in frame `first`."""
    return rotation_part(inverse_pose(chain.T[first]) @ chain.T_tool)
