"""An arm in section, in numbers: where its point is for many values of two joints, and how far that goes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point, matrix_numbers, number
from derive.expression import Expr
from derive.kinds.robot._point import Tracked
from derive.mechanics.chain import Chain
from derive.mechanics.covering import Covering
from derive.mechanics.oracle.poses import crossing
from derive.mechanics.section import Section

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

GRID = 288  # values of each of two joints
MANY = 100  # of each of more
WINDOW, NARROWER, STEPS = 4, 2.0, 80
TIP, MOST_TIPS, AROUND = 0.02, 12, 61  # of the size: how near to the axis; and values of each joint there
NOTHING = 1e-9  # of the size, what is no distance
Limits = tuple[float, float]


@dataclass(frozen=True)
class Swept:
    """Joint by joint after the first: whether it turns, its axis and a point on it while all are at zero
    (3 each), and its limits; the first axis and the point that is carried."""

    axis: tuple[Array, Array]
    joints: Sequence[tuple[bool, Array, Array]]
    limits: Sequence[Limits]
    start: Array

    @staticmethod
    def of(
        chain: Chain, found: Section, point: Tracked, at: Point, ranges: Mapping[str, tuple[Expr, Expr]]
    ) -> Swept:
        """The arm with a value for every length. Raises KeyError where one is missing, or a slide has no
        end."""
        import numpy as np

        zero = {**at, **dict.fromkeys(chain.variables, 0.0)}

        def vector(value: Any) -> Array:
            return np.array(matrix_numbers(value, zero)).ravel()

        limits, joints = [], []
        for i in found.others:
            joint = chain.joint(i)
            own = ranges.get(joint.variable)
            if own is None and joint.type != "revolute":
                raise KeyError(joint.variable)
            limits.append((number(own[0], at), number(own[1], at)) if own else (-math.pi, math.pi))
            joints.append((joint.type == "revolute", vector(chain.axis(i)), vector(chain.point(i))))
        axis = vector(chain.axis(found.first)), vector(chain.point(found.first))
        return Swept(axis, joints, limits, vector(point.position))

    def place(self, *values: Array) -> tuple[Array, Array]:
        """(rho, z) for arrays of values of the joints."""
        import numpy as np

        flat, height = self._flat(*values)
        return np.linalg.norm(flat, axis=-1), height

    @property
    def directions(self) -> tuple[Array, Array]:
        """(rho, phi) on the grid, with the first joint at zero and an axis along z."""
        import numpy as np

        flat, _ = self._flat(*self.grid)
        return np.linalg.norm(flat, axis=-1), np.arctan2(flat[..., 1], flat[..., 0])

    def _flat(self, *values: Array) -> tuple[Array, Array]:
        """The way from the first axis to the point, square to the axis, and the height."""
        import numpy as np

        p = np.broadcast_to(self.start, (*values[-1].shape, 3))
        for (turns, w, o), value in reversed([*zip(self.joints, values, strict=True)]):
            if not turns:
                p = p + value[..., None] * w
                continue
            away, c, s = p - o, np.cos(value)[..., None], np.sin(value)[..., None]
            p = o + away * c + away @ crossing(w).T * s + (away @ w)[..., None] * (1 - c) * w
        w, o = self.axis
        height = p @ w
        flat = p - o
        return flat - (flat @ w)[..., None] * w, height

    @cached_property
    def grid(self) -> tuple[Array, ...]:
        """Values of the joints, each in all its range."""
        import numpy as np

        count = {1: GRID**2, 2: GRID + 1}.get(len(self.joints), MANY + 1)
        axes = [np.linspace(*each, count) for each in self.limits]
        return tuple(np.meshgrid(*axes, indexing="ij"))

    @property
    def outline(self) -> tuple[Array, ...]:
        """Values of one joint that draw its curve."""
        import numpy as np

        return (np.linspace(*self.limits[0], GRID + 1),)

    @cached_property
    def covering(self) -> Covering:
        """What two joints cover."""
        return Covering(*self.place(*self.grid), self._beside)

    @property
    def _beside(self) -> tuple[Array, Array] | None:
        """Places around those at which the point comes to the axis, or near, which a grid has none of."""
        import numpy as np

        rho, _ = self.place(*self.grid)
        around = np.pad(rho, 1, constant_values=np.inf)
        n, m = rho.shape
        least = np.min([around[i : i + n, j : j + m] for i in range(3) for j in range(3)], axis=0)
        tips = np.argwhere((rho == least) & (rho < TIP * self.size))[:MOST_TIPS]
        step = [(high - low) / GRID for low, high in self.limits]
        fine = np.linspace(-1.0, 1.0, AROUND)
        found = []
        for tip in tips:
            here = self._refined(0, -1, [float(each[tuple(tip)]) for each in self.grid], step)
            axes = [
                np.clip(q + width * fine, *own) for q, width, own in zip(here, step, self.limits, strict=True)
            ]
            found.append(self.place(*np.meshgrid(*axes, indexing="ij")))
        return (np.stack([x for x, _ in found]), np.stack([y for _, y in found])) if found else None

    def extreme(self, which: int, sign: int) -> float:
        """The largest (1) or the smallest (-1) value of rho (0) or z (1), by ever finer grids."""
        import numpy as np

        values = sign * self.place(*self.grid)[which]
        best = np.unravel_index(int(values.argmax()), values.shape)
        start = [float(each[best]) for each in self.grid]
        here = self._refined(which, sign, start, [(high - low) / MANY for low, high in self.limits])
        found = float(self.place(*map(np.array, here))[which])
        return 0.0 if abs(found) < NOTHING * self.size else found

    def _refined(self, which: int, sign: int, here: list[float], width: list[float]) -> list[float]:
        """The values of the joints at the extreme that is so near."""
        import numpy as np

        offsets = np.linspace(-1.0, 1.0, 2 * WINDOW + 1)
        for _ in range(STEPS):
            axes = [
                np.clip(middle + w * offsets, *own)
                for middle, w, own in zip(here, width, self.limits, strict=True)
            ]
            near = np.meshgrid(*axes, indexing="ij")
            values = sign * self.place(*near)[which]
            best = np.unravel_index(int(values.argmax()), values.shape)
            here = [float(each[best]) for each in near]
            ways_on = zip(best, here, self.limits, strict=True)
            if not any(k in (0, 2 * WINDOW) and low < x < high for k, x, (low, high) in ways_on):
                width = [w / NARROWER for w in width]
        return here

    @cached_property
    def size(self) -> float:
        """Of what is reached."""
        rho, z = self.place(*self.grid)
        return float(max(rho.max(), z.max() - z.min()))

    def samples(self) -> list[Sample]:
        """One well inside the largest region of each number of configurations, and in the largest void that
        is closed in."""
        found: dict[int, Sample] = {}
        for count, part in self.covering.regions:
            is_open = part[-1].any() or part[:, 0].any() or part[:, -1].any()
            if not (count == 0 and is_open):
                found.setdefault(count, Sample(*self.covering.innermost(part), count))
        return sorted(found.values(), key=lambda each: each.count)


@dataclass(frozen=True, slots=True)
class Sample:
    """A place (rho, z), and how many pairs of values of the joints lead to it: none in a void."""

    rho: float
    z: float
    count: int

    @property
    def row(self) -> tuple[float, float, float]:
        return self.rho, self.z, float(self.count)
