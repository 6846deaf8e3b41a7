"""What a singular configuration looks like: which axes coincide, which point lies on which axis, which
arm is stretched. Read off numbers at points of the singular set, and named from what is found there.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.numbers.floats import number
from derive.kinds.checks import random_points
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.mechanics.chain import Chain
from derive.mechanics.zeros import Zero

TOLERANCE = 1e-7
POINTS, TRIES = 3, 60


@dataclass(frozen=True, slots=True)
class Look:
    """What is seen at a singular configuration: `kind` is "axis" (the point lies on the axis of `joints`),
    "coincide" (two axes are one line), "parallel" (two axes are), "stretched" or "folded" (at joint
    `joints[-1]`, seen from the axis of `joints[0]`), "plane" (the point lies in the plane through the axis of
    `joints[0]` that is parallel to that of `joints[1]`). `of` is the joint whose axis holds
    the point, 0 for the point itself."""

    kind: str
    joints: tuple[int, ...]
    of: int = 0


@dataclass(frozen=True, slots=True)
class Seeing:
    """An arm in numbers; `point` is the point that moves (3 by 1), `rows` the joints that move it."""

    problem: Problem
    chain: Chain
    point: ScalarMatrix
    rows: tuple[int, ...]

    def places(self, zeros: tuple[Zero, ...]) -> list[dict[str, float]]:
        """Points of the set, of all symbols."""
        found = []
        for at in random_points(self.problem.symbols, TRIES):
            if (here := self.put(at, zeros)) is not None:
                found.append(here)
            if len(found) == POINTS:
                break
        return found

    def put(self, at: Mapping[str, float], zeros: tuple[Zero, ...]) -> dict[str, float] | None:
        """A point moved onto the set; None where the set is not real there."""
        here = dict(oracle_of(self.problem).at(at))
        try:
            for _ in zeros:  # a value may hold another one
                here |= {zero.variable: number(zero.value, here) for zero in zeros}
        except ValueError:
            return None
        return here

    def looks(self, zeros: tuple[Zero, ...]) -> tuple[Look, ...]:
        """All that is true at every one of the places."""
        places = self.places(zeros)
        if not places:
            return ()
        seen = [list(self._at(here, zeros)) for here in places]
        anywhere = set(self._at(self.somewhere, zeros))
        return tuple(
            look for look in seen[0] if look not in anywhere and all(look in other for other in seen[1:])
        )

    @property
    def has_wrist(self) -> bool:
        """Whether the last three axes turn and the middle one is not parallel to those beside it."""
        last = self.rows[-3:]
        if len(last) < 3 or any(self.chain.joint(i).type != "revolute" for i in last):
            return False
        z, w = self.chain.axis(last[1]), self.chain.axis(last[2])
        return bool(any(z.cross(w).entries))

    @property
    def somewhere(self) -> dict[str, float]:
        """A configuration at random."""
        (at,) = random_points(self.problem.symbols, 1)
        return dict(oracle_of(self.problem).at(at))

    def _at(self, here: dict[str, float], zeros: tuple[Zero, ...]) -> Iterator[Look]:
        import numpy as np

        lines = {i: self._line(i, here) for i in self.rows}
        p = self._vector(self.point, here)
        turning = {i: line for i, line in lines.items() if self.chain.joint(i).type == "revolute"}
        for i, (z, o) in turning.items():
            if np.linalg.norm(np.cross(z, p - o)) < TOLERANCE:
                yield Look("axis", (i,))
        yield from self._planes(here, turning)
        for (i, (z, o)), (j, (w, q)) in combinations(turning.items(), 2):
            if np.linalg.norm(np.cross(z, w)) < TOLERANCE:
                yield Look("parallel", (i, j))
            if np.linalg.norm(np.cross(z, w)) + np.linalg.norm(np.cross(z, q - o)) < TOLERANCE:
                yield Look("coincide", (i, j))
        yield from self._reaches(here, zeros, lines)

    def _planes(self, here: dict[str, float], lines: Any) -> Iterator[Look]:
        """Of the first two axes, where they are turned against each other."""
        import numpy as np

        if len(lines) < 2 or len(self.rows) < 3:
            return
        (i, (z, o)), (j, (w, _)) = list(lines.items())[:2]
        normal = np.cross(z, w)
        if np.linalg.norm(normal) < TOLERANCE:
            return
        points = [(0, self._vector(self.point, here)), *((k, line[1]) for k, line in lines.items() if k > j)]
        for k, p in points:
            if abs(normal @ (p - o)) < TOLERANCE and np.linalg.norm(np.cross(z, p - o)) > TOLERANCE:
                yield Look("plane", (i, j), k)

    def _reaches(self, here: dict[str, float], zeros: tuple[Zero, ...], lines: Any) -> Iterator[Look]:
        """Whether the distance of a point from the axis before the joint is at its largest or smallest."""
        turned = {zero.variable for zero in zeros}
        for i, j in zip(self.rows, self.rows[1:], strict=False):
            name = self.chain.joint(j).variable
            if name not in turned or not self._parallel(lines, i, j):
                continue
            for point in self._beyond(j):
                kind = self._extreme(point, i, name, here)
                if kind:
                    yield Look(kind, (i, j))
                    break

    def _parallel(self, lines: Any, i: int, j: int) -> bool:
        import numpy as np

        both = all(self.chain.joint(k).type == "revolute" for k in (i, j))
        return both and bool(np.linalg.norm(np.cross(lines[i][0], lines[j][0])) < TOLERANCE)

    def _beyond(self, j: int) -> list[ScalarMatrix]:
        """The point itself, then the points of the later axes."""
        return [self.point, *(self.chain.point(k) for k in self.rows if k > j)]

    def _extreme(self, point: ScalarMatrix, i: int, name: str, here: dict[str, float]) -> str:
        def reach(angle: float) -> float:
            import numpy as np

            at = {**here, name: angle}
            z, o = self._line(i, at)
            return float(np.linalg.norm(np.cross(z, self._vector(point, at) - o)))

        now, step = here[name], 1e-3
        middle, less, more = reach(now), reach(now - step), reach(now + step)
        if abs(more - less) > 1e-9 * max(1.0, middle) or abs(more + less - 2 * middle) < 1e-9:
            return ""
        return "stretched" if more + less < 2 * middle else "folded"

    def _line(self, i: int, here: Mapping[str, float]) -> tuple[Any, Any]:
        return self._vector(self.chain.axis(i), here), self._vector(self.chain.point(i), here)

    @staticmethod
    def _vector(column: ScalarMatrix, here: Mapping[str, float]) -> Any:
        import numpy as np

        return np.array([row[0] for row in numeric.matrix_numbers(column, here)])
