"""How an end-effector turns about a point that it holds, in numbers: by differences of poses, and by a search
over the joints before the last link."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, pairwise
from math import pi
from typing import Any

from derive.algebra.numbers import floats as numeric
from derive.derivation import Phrase
from derive.expression import Approximate, Expr
from derive.kinds.checks import random_points
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.checks import search
from derive.kinds.robot._reach.dexterous import Rings, holds, near_an_end, samples
from derive.kinds.robot._seen import apart, axis_seen
from derive.mechanics.chain import Chain
from derive.mechanics.reach import moving_joints

POINTS, COUNT = 3, 60
FINE, BORDERS = 10_000, 3  # rings that are added up, and circles at most where they begin or end
SMALL, NEAR = 1e-5, 2e-2
Values = dict[str, float]


@dataclass(frozen=True)
class TurningAbout:
    """An arm and the point that it holds."""

    problem: Problem
    found: Chain
    point: Tracked

    @property
    def points(self) -> Iterator[Values]:
        oracle = oracle_of(self.problem)
        return (dict(oracle.at(at)) for at in random_points(self.problem.symbols, POINTS))

    def told(self, said: Phrase) -> Phrase:
        """What is said of orientations. Of an arm that turns in every way without a wrist as it should be it
        is not known: another elbow may make up for what its wrist leaves out."""
        missing = said.key in ("no-wrist", "too-few-joints")
        is_free = missing and any(self.freedom(at) == 3 for at in self.points)
        return Phrase("orientations-open") if is_free else said

    def freedom(self, at: Values, in_a_plane: bool = False) -> int:
        """In how many independent ways it turns while the point stays, or in the plane that it moves in."""
        import numpy as np

        oracle = oracle_of(self.problem)
        J = oracle.jacobian(oracle.at(at), self.point.frame, self.point.offset)
        _, sizes, rows = np.linalg.svd(J[:3])
        still = rows[int((sizes > SMALL * max(1.0, *sizes)).sum()) :].T
        turns = J[3:] @ still
        if in_a_plane:
            moving = moving_joints(self.found, self.point.position, self.point.last)
            turning = next(i for i in moving if self.found.joint(i).type == "revolute")
            turns = axis_seen(self.problem, self.found, turning, at)[0][None] @ turns
        return int(np.linalg.matrix_rank(turns, tol=SMALL)) if turns.size else 0

    def rings(self, told: Rings) -> Iterator[bool]:
        """Whether a distance lies in the rings just where the last link starts within reach of the others,
        whichever way it points."""
        for at in self.points:
            near, far, last = self._others(at)
            pieces = [
                (numeric.number(low, at), numeric.number(high, at)) for low, high in self._told(told, at)
            ]
            size = far + last
            yield all(high < low - SMALL * size for (_, high), (low, _) in pairwise(pieces))
            for r in samples(size, COUNT):
                if not near_an_end(pieces, r, NEAR * size):
                    yield holds(pieces, r) == (r + last <= far and abs(r - last) >= near)

    def covers(self, area: Expr) -> Iterator[bool]:
        """Whether an area is that of all circles on which the last link may point whichever way."""
        for at in self.points:
            near, far, last = self._others(at)
            size = far + last
            width = 1.1 * size / FINE
            inside = (r for r in samples(size, FINE) if r + last <= far and abs(r - last) >= near)
            apart = numeric.number(area, at) - 2 * pi * width * sum(inside)
            yield abs(apart) < BORDERS * 2 * pi * size * width

    @property
    def is_of_two_links(self) -> bool:
        """Whether just two joints move the point, and both turn."""
        rows = moving_joints(self.found, self.point.position, self.point.last)
        return [self.found.joint(i).type for i in rows] == ["revolute"] * 2

    def at_the_base(self, key: str) -> Iterator[bool]:
        """Whether the end of two links turns about the base just where that is said: always, with links of
        one length, or never."""
        letters = sorted(self.problem.symbols - {*self.found.variables})
        for at in self.points:
            always = self._folds(at)
            ever = any(self._folds({**at, one: at[other]}) for one, other in combinations(letters, 2))
            yield always == (key == "the-base")
            yield ever == (key == "empty-or-the-base") or always

    def _folds(self, at: Values) -> bool:
        """Whether the end comes to the first axis."""
        near, far, last = self._others(at)
        return near - SMALL * far <= last <= far + SMALL * far

    def _told(self, told: Rings, at: Values) -> list[tuple[Any, Any]]:
        """The rings at these lengths; where they depend on the lengths, by the borders that are told."""
        if told.pieces is not None:
            return list(told.pieces)
        low, high, far = (numeric.number(tree, at) for tree in (told.low, told.high, told.r_max))
        inside = [(0.0, min(low, far))] if min(low, far) >= 0 else []
        outside = [(max(high, 0.0), far)] if high <= far else []
        return [(Approximate(a), Approximate(b)) for a, b in (*inside, *outside)]

    def _others(self, at: Values) -> tuple[float, float, float]:
        """The smallest and the largest distance of the last axis from the first, and the length of the last
        link."""
        rows = moving_joints(self.found, self.point.position, self.point.last)
        turning = [i for i in rows if self.found.joint(i).type == "revolute"]
        names = [self.found.joint(i).variable for i in turning[:-1]]

        def distance(here: Values) -> float:
            (z, o), (_, p) = (axis_seen(self.problem, self.found, i, here) for i in (turning[0], turning[-1]))
            return apart(z, p - o)

        starts = [{**at, **{name: at[name] + 1.3 * k for name in names}} for k in range(3)]
        near = min(search(distance, start, names, -1) for start in starts)
        far = max(search(distance, start, names, 1) for start in starts)
        z, o = axis_seen(self.problem, self.found, turning[-1], at)
        return near, far, apart(z, self._place(at) - o)

    def _place(self, here: Values) -> Any:
        import numpy as np

        oracle, point = oracle_of(self.problem), self.point
        beyond = point.frame > len(self.problem.subject.links)
        T = oracle.tool(here) if beyond else oracle.poses(here)[point.frame]
        return np.array(T[:3, :3] @ [numeric.number(x, here) for x in point.offset] + T[:3, 3])
