"""The point and the rows of a Jacobian that a question is about."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np

from derive.audit.linear import Rows, det, is_zero
from derive.audit.subjects.robot.arm import Arm, numbers
from derive.audit.subjects.robot.series import Array

ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")


@dataclass(frozen=True)
class Task:
    """The Jacobian of the point that the options name, the end-effector where they name none."""

    arm: Arm

    @cached_property
    def frame(self) -> int | None:
        """The one that carries the point; none for the end-effector."""
        point = getattr(self.arm.asked.options, "point", None)
        if point is None:
            return None
        return next((n for n in (point.link, point.frame) if n is not None), len(self.arm.robot.links))

    @cached_property
    def pose(self) -> Array:
        """Of the body that carries the point."""
        return self.arm.end if self.frame is None else self.arm.poses[self.frame]

    @cached_property
    def place(self) -> Array:
        """The point in the base frame (3 series)."""
        point = getattr(self.arm.asked.options, "point", None)
        at = [0, 0, 0] if point is None else [self.arm.series(part) for part in point.at]
        return self.arm.carried(np.array(at, dtype=object), self.frame)

    @cached_property
    def whole(self) -> Array:
        """All six rows, as series."""
        return self.arm.jacobian(self.pose, self.place)

    def rows(self, names: tuple[str, ...]) -> Array:
        """Some of them, in their order."""
        found: Array = self.whole[[ROWS.index(name) for name in names]]
        return found

    @cached_property
    def moving(self) -> tuple[str, ...]:
        """The rows that are not zero everywhere; at a random configuration that is the same."""
        values = numbers(self.whole)
        return tuple(name for name, row in zip(ROWS, values, strict=True) if not all(map(is_zero, row)))

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The rows asked for, or those that the arm is built to command: its position where its joints
        command just that, all that moves where they can, its orientation where they command just that."""
        asked: tuple[str, ...] = getattr(self.arm.asked.options, "rows", ())
        if asked:
            return asked
        linear = tuple(name for name in self.moving if name[0] == "v")
        angular = tuple(name for name in self.moving if name[0] == "w")
        if self._commanded(linear):
            return linear
        if len(self.moving) > self.arm.n and self._commanded(angular):
            return angular
        return self.moving

    def _commanded(self, names: tuple[str, ...]) -> bool:
        """Whether the joints move these independently, with none to spare."""
        n = self.arm.n
        if not n <= min(len(names), 3):
            return False
        return any(not is_zero(det(numbers(self.rows(each)))) for each in combinations(names, n))

    def rows_in(self, names: tuple[str, ...]) -> Rows:
        """These rows in numbers."""
        return numbers(self.rows(names))

    @property
    def J(self) -> Rows:
        """The rows of the task in numbers (m by n)."""
        return self.rows_in(self.names)
