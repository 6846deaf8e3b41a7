"""Joint rates along a path, integrated in numbers from a start (Runge and Kutta)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.compiled import compiled
from derive.errors import NotDerivable
from derive.kinds.path._moving import Driven
from derive.kinds.path._timing import T
from derive.kinds.robot._carried.followed import entries
from derive.kinds.robot._carried.sampled import Sampled, moments
from derive.kinds.robot._carried.setting import Setting
from derive.kinds.robot._velocity.task import Task

if TYPE_CHECKING:
    from numpy.typing import NDArray

SINGULAR = "the arm is singular on the path at t = {} s: no joint rates follow it there"
SUBSTEPS = 2  # between samples
NEWTON = 12  # steps onto the path
PLACES = 24  # along a path
FLAT = 1e-6  # of the greatest singular value: the least that has an inverse
SMALL = 1e-5  # of the whole time, for differences


@dataclass(frozen=True)
class Rates:
    """qdot = J^+ v in numbers, where every name but those of the joints and the time has a value."""

    given: Setting
    task: Task
    driven: Driven

    @cached_property
    def _functions(self) -> tuple[list[list[Any]], list[Any]]:
        """J and the velocity of the path."""
        rows = [[compiled(entry) for entry in row] for row in self.task.written.rows]
        return rows, [compiled(entry) for entry in entries(self.given.moving.by_time[1])]

    def jacobian(self, q: Any) -> NDArray[Any]:
        """J (m by n)."""
        import numpy as np

        at = {**self.given.point, **dict(zip(self.task.found.variables, map(float, q), strict=True))}
        return np.array([[entry(at) for entry in row] for row in self._functions[0]])

    def at(self, t: float, q: Any) -> NDArray[Any]:
        """The rates at a time. Raises NotDerivable at a singular configuration."""
        import numpy as np

        velocity = np.array([entry({**self.given.point, T.name: t}) for entry in self._functions[1]])
        J = self.jacobian(q)
        sizes = np.linalg.svd(J, compute_uv=False)
        if sizes[-1] < FLAT * sizes[0]:
            raise NotDerivable(SINGULAR.format(f"{t:.3g}"), "path")
        found: NDArray[Any] = np.linalg.pinv(J) @ velocity
        return found

    def onto(self, q: Any) -> NDArray[Any]:
        """The nearest configurations, step by step, until the arm stands where the path begins."""
        import numpy as np

        begin = (self.driven.ends or (0.0, 1.0))[0]
        found = np.array(q, dtype=float)
        for _ in range(NEWTON):
            found = found - np.linalg.pinv(self.jacobian(found)) @ self.gap(begin, found)
        return found

    def begins(self, q: Any) -> tuple[float, float]:
        """How far from where the path begins the arm is, and how large the path is."""
        import numpy as np

        begin, end = self.driven.ends or (0.0, 1.0)
        first = self.driven.place(begin)
        places = [self.driven.place(begin + (end - begin) * k / PLACES) for k in range(PLACES + 1)]
        size = max(float(np.linalg.norm(place - first)) for place in places)
        return float(np.linalg.norm(self.gap(begin, q))), size

    def gap(self, t: float, q: Any) -> NDArray[Any]:
        """How far the arm is from the path."""
        return self.given.where.gap(self.driven, t, q, self.given.point)

    def lost(self, found: Sampled, most: float) -> float | None:
        """When the arm is first further from the path than that; None where it never is."""
        import numpy as np

        pairs = zip(map(float, found.times), found.values[0], strict=True)
        return next((t for t, q in pairs if float(np.linalg.norm(self.gap(t, q))) > most), None)

    def over_time(self, start: Any) -> Sampled:
        """From the start, by four slopes a step; accelerations by differences along the motion."""
        import numpy as np

        times = moments(self.driven)
        q = [np.array(start, dtype=float)]
        for low, high in pairwise(times):
            h, now = (high - low) / SUBSTEPS, q[-1]
            for k in range(SUBSTEPS):
                now = now + _slope(self, low + k * h, now, h)
            q.append(now)
        rates = [self.at(float(t), each) for t, each in zip(times, q, strict=True)]
        there = zip(times, q, rates, strict=True)
        rises = [self._rise(float(t), each, rate, times) for t, each, rate in there]
        return Sampled(self.given.problem.subject, times, (np.array(q), np.array(rates), np.array(rises)))

    def _rise(self, t: float, q: Any, rate: Any, times: Any) -> NDArray[Any]:
        """The acceleration at a time, from the side on which no law ends."""
        h = SMALL * float(times[-1] - times[0])
        joints = self.driven.joints
        if any(0 <= t - end < 2 * h for end in (float(times[0]), *joints)):
            sides = {0: -3.0, 1: 4.0, 2: -1.0}
        elif any(0 <= end - t < 2 * h for end in (*joints, float(times[-1]))):
            sides = {0: 3.0, -1: -4.0, -2: 1.0}
        else:
            sides = {-1: -1.0, 1: 1.0}
        parts = [weight * self._ahead(t, k * h, q, rate) for k, weight in sides.items()]
        found: NDArray[Any] = sum(parts, 0 * rate) / (2 * h)
        return found

    def _ahead(self, t: float, by: float, q: Any, rate: Any) -> NDArray[Any]:
        """The rates a little later, or before, where the joints have come by then."""
        way = by * rate
        if by:  # to the second order
            way = by / 2 * (rate + self.at(t + by, q + way))
        return self.at(t + by, q + way)


def _slope(rates: Rates, t: float, q: Any, h: float) -> Any:
    """A step of the fourth order."""
    a = rates.at(t, q)
    b = rates.at(t + h / 2, q + h / 2 * a)
    c = rates.at(t + h / 2, q + h / 2 * b)
    d = rates.at(t + h, q + h * c)
    return h / 6 * (a + 2 * b + 2 * c + d)
