"""What a motion demands of each joint: by which factor it has to be slower for the limit to be just kept.

In k times the time the torques beyond those of gravity are divided by k^2 (Hollerbach, Dynamic scaling of
manipulator trajectories, 1984; Siciliano et al., section 7.7).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import isclose, sqrt
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import Point, number
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Expr
from derive.kinds.robot._scaled.planned import Planned

if TYPE_CHECKING:
    from numpy.typing import NDArray

SAMPLES = 400  # over the whole time
CLOSER = 60  # thirds of an interval
TOPS, SAME = 6, 1e-9  # so many times are told at which a joint needs most; how equal they are
NEARLY = 0.999  # of the greatest sample
GOLDEN = (sqrt(5) - 1) / 2
TOO_WEAK = "joint {} cannot hold the arm against gravity at t = {:.3g} s: no motion is slow enough"


@dataclass(frozen=True, slots=True)
class Peak:
    """When a joint needs most, its torques then, whole and of gravity, and the factor that it needs;
    `again` are later times at which it needs as much."""

    t: float
    tau: float
    g: float
    k: float
    again: tuple[float, ...] = ()


@dataclass(frozen=True)
class Demands:
    """Torques and limits in numbers; every name but those of the joints and the time has a value."""

    plan: Planned
    motion: Derivation  # the equations of motion
    limits: tuple[Expr, ...]
    point: Point

    @cached_property
    def whole(self) -> float:
        """How long the motion takes."""
        return number(self.plan.time, self.point)

    @cached_property
    def most(self) -> tuple[float, ...]:
        """The limits."""
        return tuple(number(each, self.point) for each in self.limits)

    @cached_property
    def _torques(self) -> tuple[Callable[[Point], float], ...]:
        return tuple(compiled(entry) for (entry,) in self.motion.matrix("tau").rows)

    @cached_property
    def _weights(self) -> tuple[Callable[[Point], float], ...]:
        return tuple(compiled(entry) for (entry,) in self.motion.matrix("g").rows)

    def at(self, t: float, joint: int) -> Peak:
        """What a joint needs at a time."""
        there = self.plan.at(t, self.point)
        tau, g = self._torques[joint](there), self._weights[joint](there)
        return Peak(t, tau, g, needed(tau, g, self.most[joint]))

    def torques(self, times: Sequence[float], k: float) -> NDArray[Any]:
        """Those of all joints in the motion that takes k times as long, at these times of the original."""
        import numpy as np

        rows = []
        for t in times:
            there = self.plan.at(t, self.point)
            g = [each(there) for each in self._weights]
            rows.append([w + (each(there) - w) / k**2 for each, w in zip(self._torques, g, strict=True)])
        return np.array(rows)

    @cached_property
    def peaks(self) -> tuple[Peak, ...]:
        """Of each joint. Raises NotDerivable where gravity alone is too much for one."""
        return tuple(self._peak(joint) for joint in range(len(self.most)))

    def _peak(self, joint: int) -> Peak:
        """By samples, then closer about the greatest ones; the first where it is reached again."""
        times = [self.whole * k / SAMPLES for k in range(SAMPLES + 1)]
        found = [self.at(t, joint) for t in times]
        heavy = next((each for each in found if abs(each.g) >= self.most[joint]), None)
        if heavy is not None:
            raise NotDerivable(TOO_WEAK.format(joint + 1, heavy.t))
        best = max(range(len(found)), key=lambda place: found[place].k)
        tops = _tops([each.k for each in found])
        closer = [self._closer(place, found, joint) for place in (tops if len(tops) <= TOPS else [best])]
        most = max(each.k for each in closer)
        first, *rest = (each for each in closer if isclose(each.k, most, rel_tol=SAME))
        apart = self.whole / SAMPLES
        pairs = zip(rest, (first, *rest), strict=False)
        return replace(first, again=tuple(each.t for each, last in pairs if each.t - last.t > apart))

    def _closer(self, best: int, found: Sequence[Peak], joint: int) -> Peak:
        """The greatest about a sample."""
        times = [each.t for each in found]
        low, high = times[max(best - 1, 0)], times[min(best + 1, SAMPLES)]
        for _ in range(CLOSER):
            width = GOLDEN * (high - low)
            if self.at(high - width, joint).k >= self.at(low + width, joint).k:
                high = low + width
            else:
                low = high - width
        return max(found[best], self.at((low + high) / 2, joint), key=lambda each: each.k)


def _tops(factors: Sequence[float]) -> list[int]:
    """Where none beside it is greater, and none anywhere by much."""
    least = NEARLY * max(factors)
    beside = [0.0, *factors, 0.0]
    around = zip(beside, factors, beside[2:], strict=False)
    return [i for i, (before, here, after) in enumerate(around) if here >= max(before, after, least)]


def needed(tau: float, g: float, most: float) -> float:
    """The factor in which the torque just reaches its limit."""
    beyond = tau - g
    left = most - g if beyond >= 0 else most + g
    return sqrt(abs(beyond) / left) if left > 0 else float("inf")
