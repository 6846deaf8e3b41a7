"""What is said of a singular configuration, held to the arm as it stands there: axes and points come from
moving the joints of the oracle a little, not from the chain."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import number, numbers
from derive.derivation import Phrase, Said
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._seen import apart, axis_seen, meeting, motion
from derive.kinds.robot._velocity.task import Task

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

NEAR = 1e-6
ROUND = tuple(2 * math.pi * k / 24 for k in range(1, 24))
Values = dict[str, float]


@dataclass(frozen=True, slots=True)
class Postures:
    """The arm of a task; `hand` are the joints whose axes meet in the point that is meant, where that is the
    centre of a wrist."""

    task: Task
    rows: tuple[int, ...]  # of the joints that are meant, in order
    hand: tuple[int, ...] = ()

    def true(self, said: Phrase, here: Values) -> bool:
        """Whether it is so at a configuration. Raises KeyError for words that are none of a posture."""
        about = said.about
        match said.key:
            case "besides":
                return all(self.true(_phrase(about[part]), here) for part in ("one", "other"))
            case "shoulder" | "shoulder-singularity":
                look = _phrase(about["look"])
                return look.about["first"] == self.rows[0] and self.true(look, here)
            case "wrist" | "wrist-singularity":
                look = _phrase(about["look"])
                if (look.about["first"], look.about["last"]) != (self.rows[-3], self.rows[-1]):
                    return False
                return not self._parallel(self.rows[-2], self.rows[-1], here) and self.true(look, here)
            case "elbow-is-stretched" | "elbow-is-folded" | "elbow-stretched" | "elbow-folded":
                joint = int(str(about.get("joint", about.get("last"))))
                return self._bent(joint, here) == said.key.rsplit("-", 1)[1]
        return self._so(said, here) and not self._so(said, self._elsewhere(here))

    def _elsewhere(self, here: Values) -> Values:
        """Another configuration: what is so everywhere is not said of a singular one."""
        return here | {name: here[name] + 0.7 + 0.31 * k for k, name in enumerate(self.task.found.variables)}

    def _so(self, said: Phrase, here: Values) -> bool:
        """Whether axes or a point lie as it is said."""
        about = said.about
        first, last = (int(str(about[name])) for name in ("first", "last"))
        point = self._meant(_phrase(about["point"]), here)
        z, o = self._axis(first, here)
        match said.key:
            case "on-an-axis":
                return apart(z, point - o) < NEAR
            case "axes-parallel":
                return self._parallel(first, last, here)
            case "axes-coincide":
                return self._parallel(first, last, here) and apart(z, self._axis(last, here)[1] - o) < NEAR
            case "in-a-plane":
                w, _ = self._axis(last, here)
                return bool(abs(_cross(z, w) @ (point - o)) < NEAR)
        raise KeyError(said.key)

    def _meant(self, point: Phrase, here: Values) -> Array:
        """The point (3) that words mean."""
        if point.key == "point-of-axis":
            return self._named(int(str(point.about["axis"])), here)
        if point.key == "center-of-the-wrist":
            return self._centre(here)
        return self._point(here)

    def _named(self, i: int, here: Values) -> Array:
        """The point (3) by which an axis is given, if it lies on it."""
        import numpy as np

        at = oracle_of(self.task.problem).at(here)
        p = np.array(numbers(self.task.found.point(i), at)).ravel()
        z, o = self._axis(i, here)
        return p if apart(z, p - o) < NEAR else np.full(3, np.nan)

    def _point(self, here: Values) -> Array:
        """The point (3) of the task."""
        import numpy as np

        oracle, point = oracle_of(self.task.problem), self.task.point
        at = oracle.at(here)
        last = point.frame > len(self.task.found.T_local)
        T = oracle.tool(at) if last else oracle.poses(at)[point.frame]
        return np.array(T[:3, :3] @ [number(x, at) for x in point.offset] + T[:3, 3])

    def _axis(self, i: int, here: Values) -> tuple[Array, Array]:
        return axis_seen(self.task.problem, self.task.found, i, here)

    def _parallel(self, i: int, j: int, here: Values) -> bool:
        return apart(self._axis(i, here)[0], self._axis(j, here)[0]) < NEAR

    def _bent(self, joint: int, here: Values) -> str:
        """Whether the point, or else the first later axis of which that is so, is as far from the axis
        before a joint as it can be brought, or as near."""
        before = self.rows[self.rows.index(joint) - 1]
        if not self._parallel(before, joint, here):
            return ""  # it is no elbow
        name = self.task.found.joint(joint).variable
        around = [here, *({**here, name: here[name] + by} for by in ROUND)]
        later = [i for i in self.rows if i > joint and self.task.found.joint(i).type == "revolute"]
        z, o = self._axis(before, here)  # which joints after it leave where it is
        for i in (0, *later):
            ends = (self._axis(i, at)[1] if i else self._of_rows(at) for at in around)
            reach = [apart(z, end - o) for end in ends]
            if max(reach) - min(reach) < NEAR:
                continue
            if reach[0] > max(reach) - NEAR:
                return "stretched"
            if reach[0] < min(reach) + NEAR:
                return "folded"
        return ""

    def _of_rows(self, here: Values) -> Array:
        return self._centre(here) if self.hand else self._point(here)

    def _centre(self, here: Values) -> Array:
        """Where the axes of the hand meet (3)."""
        return meeting([motion(self.task.problem, self.task.found, i, here) for i in self.hand])


def _phrase(said: Said) -> Phrase:
    if isinstance(said, Phrase):
        return said
    raise TypeError(f"{said} is no phrase")


def _cross(a: Array, b: Array) -> Array:
    import numpy as np

    return np.array(np.cross(a, b))
