"""An arm in numbers within the limits of its joints: where its point is, configuration by configuration."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers import floats as numeric
from derive.expression import Expr
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.shapes import Shape
from derive.kinds.robot._seen import axis_seen, motion
from derive.mechanics.chain import Chain
from derive.mechanics.oracle.poses import crossing, turn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


Values = dict[str, float]
Limits = tuple[float, float]
EACH = {1: 2001, 2: 201, 3: 41, 4: 17, 5: 11, 6: 7, 7: 5}  # values of a joint, by their number
DRAWN = 60_000  # places at random
FAR = 12.0  # where a slide has no end
SMALL = 1e-6


@dataclass(frozen=True)
class InNumbers:
    """A point of an arm `at` one set of lengths and limits, and the shape that it is said to reach."""

    problem: Problem
    found: Chain
    point: Tracked
    shape: Shape
    at: Values

    @cached_property
    def limits(self) -> dict[int, Limits]:
        """Of each row that moves the point; what slides without end goes far."""
        found = {}
        for row in self.shape.rows:
            joint = self.found.joint(row)
            ends = self.problem.subject.ranges.get(joint.variable)
            usual = (-math.pi, math.pi) if joint.type == "revolute" else (-FAR, FAR)
            found[row] = (self.number(ends[0]), self.number(ends[1])) if ends else usual
        return found

    @cached_property
    def here(self) -> Values:
        """A configuration within the limits."""
        own = {
            self.found.joint(row).variable: low + 0.55 * (high - low)
            for row, (low, high) in self.limits.items()
        }
        return {**self.at, **own}

    def number(self, tree: Expr) -> float:
        return numeric.number(tree, self.at)

    @cached_property
    def lines(self) -> dict[int, tuple[Array, Array | None]]:
        """Of each row its direction, and a point on the axis of one that turns."""
        found: dict[int, tuple[Array, Array | None]] = {}
        for row in self.shape.rows:
            if self.found.joint(row).type == "revolute":
                found[row] = axis_seen(self.problem, self.found, row, self.here)
            else:
                way = motion(self.problem, self.found, row, self.here)[:3, 3]
                found[row] = way / float((way @ way) ** 0.5), None
        return found

    @cached_property
    def start(self) -> Array:
        """The point (3) in that configuration."""
        import numpy as np

        oracle, point = oracle_of(self.problem), self.point
        last = point.frame > len(self.problem.subject.links)
        T = oracle.tool(self.here) if last else oracle.poses(self.here)[point.frame]
        offset = [self.number(x) for x in point.offset]
        return np.array(T[:3, :3] @ offset + T[:3, 3])

    @cached_property
    def places(self) -> Array:
        """Where the point is (N by 3) on a grid of the joint variables: from the last joint to the first,
        each moves all places so far as a whole."""
        import numpy as np

        count, places = EACH[len(self.shape.rows)], self.start[None]
        for row in reversed(self.shape.rows):
            direction, through = self.lines[row]
            moved = np.linspace(*self.limits[row], count) - self.here[self.variable(row)]
            if through is None:
                spread = moved[:, None, None] * direction + places
            else:
                spread = through + (places - through) @ turn(direction, moved[:, None, None]).transpose(
                    0, 2, 1
                )
            places = spread.reshape(-1, 3)
        return places

    @cached_property
    def scattered(self) -> Array:
        """The same places and others at random, which leave fewer gaps where joints are several."""
        import numpy as np

        draw = np.random.default_rng(0)
        others = self.moved({row: draw.uniform(*self.limits[row], DRAWN) for row in self.shape.rows})
        return np.concatenate([self.places, others])

    def moved(self, values: Mapping[int, Array]) -> Array:
        """Where the point is (N by 3) with the joints of these rows at N values each, the others as they
        are."""
        import numpy as np

        places = np.tile(self.start, (next(iter(values.values())).size, 1))
        for row, value in reversed([*values.items()]):
            moved = value - self.here[self.found.joint(row).variable]
            direction, through = self.lines[row]
            if through is None:
                places = places + moved[:, None] * direction
            else:
                places = through + _turned(places - through, direction, moved)
        return places

    def variable(self, row: int) -> str:
        return self.found.joint(row).variable

    @property
    def first(self) -> int:
        return next(row for row in self.shape.rows if self.found.joint(row).type == "revolute")

    def lifts(self, row: int) -> bool:
        import numpy as np

        along = np.cross(self.lines[row][0], self.lines[self.first][0])
        return self.lines[row][1] is None and float(np.linalg.norm(along)) < SMALL


def _turned(away: Array, z: Array, by: Array) -> Array:
    """Each row of `away` turned about z by its angle (Rodrigues)."""
    import numpy as np

    c, s = np.cos(by)[:, None], np.sin(by)[:, None]
    return np.array(away * c + away @ crossing(z).T * s + (away @ z)[:, None] * (1 - c) * z)
