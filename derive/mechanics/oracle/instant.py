"""An arm at one point, its frames and how they move by their indices, as books number them.

Frames are 0, 1, ..., n, e (the end-effector) and c1 (at the com of link 1, turned as that link).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from derive.algebra.ball_arithmetic import precise
from derive.expression import free_symbols
from derive.mechanics.motion import Move
from derive.mechanics.oracle.arm import Oracle
from derive.mechanics.oracle.displacements import Course, Placed, along, course, many_digits
from derive.mechanics.oracle.poses import compose, direction
from derive.mechanics.oracle.sweep import Axis
from derive.mechanics.oracle.values import Array
from derive.mechanics.robot import FreeRow

NEAR = 1e-4  # of differences; of two of them the error is about its fourth power
TIP = "e"


@dataclass(frozen=True)
class Instant:
    """The arm in numbers where its joint variables are those of the point. Rates and accelerations are read
    of the point where a method says so."""

    oracle: Oracle
    at: Any

    # -- where it is ----------------------------------------------------------------------------------

    @cached_property
    def frames(self) -> dict[str, Array]:
        """The pose (4 by 4, in the base) of each frame."""
        import numpy as np

        robot, poses = self.oracle.robot, self.oracle.poses(self.at)
        found = {str(i): T for i, T in enumerate(poses)}
        found[TIP] = poses[-1] @ self.oracle.in_hand(self.at)
        for i, body in enumerate(self.bodies, 1):
            if body is not None:
                found[f"c{i}"] = np.block([[body.R, body.com[:, None]], [np.zeros((1, 3)), np.ones((1, 1))]])
        if robot.base:  # frame 0 stands where the base puts it, and poses are seen from the base
            found["base"], found["0"] = poses[0], np.eye(4)
        return found

    def pose(self, frame: str, seen_from: str = "0") -> Array:
        """T (4 by 4) of a frame in another."""
        import numpy as np

        return np.linalg.inv(self.frames[seen_from]) @ self.frames[frame]

    def local(self, i: int) -> Array:
        """T (4 by 4) of row i alone."""
        return self.oracle.local(self.at)[i - 1]

    def axis(self, i: int) -> Array:
        """The direction (3, base frame) of the joint of row i."""
        import numpy as np

        moved = self._axes[i - 1]
        return np.array(self._before(i)[:3, :3] @ moved.direction if moved else [np.nan] * 3)

    def on_axis(self, i: int, point: Sequence[float]) -> Array:
        """The point (3) of the axis of row i that is nearest to a point. A slide has a direction alone: its
        axis goes through any point."""
        import numpy as np

        if self._slides(i):
            return np.array(point)
        moved, T = self._axes[i - 1], self._before(i)
        if moved is None:
            return np.full(3, np.nan)
        k, o = T[:3, :3] @ moved.direction, T[:3, :3] @ moved.point + T[:3, 3]
        return np.array(o + k * (k @ (np.array(point) - o)) / (k @ k))

    @cached_property
    def _axes(self) -> list[Axis | None]:
        found = self.oracle.axes(self.at)
        return [axis or self._coupled_axis(i) for i, axis in enumerate(found, 1)]

    def _slides(self, i: int) -> bool:
        link = self.oracle.robot.links[i - 1]
        coupled = self._coupled_move(i)
        return link.joint == "prismatic" or (coupled is not None and coupled[1].kind == "translate")

    def _coupled_axis(self, i: int) -> Axis | None:
        """Of a row that is moved by the variable of another, in the frame before it; None of a fixed row."""
        if (coupled := self._coupled_move(i)) is None:
            return None
        made, move = coupled
        T = compose(made, self.at)
        return Axis(T[:3, :3] @ direction(move.axis, self.at), T[:3, 3])

    def _coupled_move(self, i: int) -> tuple[tuple[Move, ...], Move] | None:
        """The one move of a row without a joint by which it moves, and those before it."""
        link, variables = self.oracle.robot.links[i - 1], set(self.oracle.robot.variables)
        made = link.row.moves if isinstance(link.row, FreeRow) and link.variable is None else ()
        moving = [k for k, move in enumerate(made) if free_symbols(move.by) & variables]
        return (made[: moving[0]], made[moving[0]]) if len(moving) == 1 else None

    def _before(self, i: int) -> Array:
        return self.oracle.poses(self.at)[i - 1]

    @cached_property
    def bodies(self) -> list[Placed | None]:
        """Of each link."""
        return self.oracle.bodies(self.at)

    # -- how it moves ---------------------------------------------------------------------------------

    def jacobian(self, frame: str) -> Array:
        """J (6 by n) of the origin of a frame, by differences of its pose: what it shifts and turns."""
        import numpy as np

        columns = []
        R = self.frames[frame][:3, :3]
        for ahead, behind, far, near in self._shots:
            rate = (8 * (ahead[frame] - behind[frame]) - (far[frame] - near[frame])) / (12 * NEAR)
            S = rate[:3, :3] @ R.T
            columns.append([*rate[:3, 3], S[2, 1], S[0, 2], S[1, 0]])
        return np.array(columns).T

    @cached_property
    def _shots(self) -> list[tuple[dict[str, Array], ...]]:
        """The frames a little further and a little back along each joint variable, then twice as far."""
        return [
            tuple(
                Instant(self.oracle, {**self.at, name: self.at[name] + k * NEAR}).frames
                for k in (1, -1, 2, -2)
            )
            for name in self.oracle.robot.variables
        ]

    @cached_property
    def courses(self) -> dict[str, Course]:
        """How each frame moves at the rates and accelerations of the point."""
        robot = self.oracle.robot
        precisely = replace(self.oracle, value=precise)
        with many_digits(self.at) as at:
            shots = [Instant(precisely, now).frames for now in along(at, robot.variables)]
            return {frame: course(*(shot[frame] for shot in shots)) for frame in self.frames}
