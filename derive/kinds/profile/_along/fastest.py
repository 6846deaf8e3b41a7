"""The fastest motion along a path, by steps of the parameter.

With b = s_dot^2 and u = s_ddot every limit is a straight line in (b, u), and b changes by 2 u ds in a step
(Bobrow, Dubowsky and Gibson, Time-optimal control of robotic manipulators along specified paths, 1985; Pham
and Pham, A new approach to time-optimal path parameterization based on reachability analysis, 2018).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from numpy.typing import NDArray

Vector: TypeAlias = "Callable[[float], NDArray[Any]]"
Limits: TypeAlias = "tuple[NDArray[Any], NDArray[Any]]"  # of velocities and accelerations
STEPS = 2000
FLAT = 1e-12


@dataclass(frozen=True)
class Fastest:
    """b at each value of the parameter, u in each step, when each value is passed, and the greatest b that
    velocities and accelerations allow there."""

    s: NDArray[Any]
    b: NDArray[Any]
    u: NDArray[Any]
    t: NDArray[Any]
    most: NDArray[Any]


@dataclass(frozen=True)
class Bounds:
    """At one value: slopes of u, slopes of b and right sides (each k) of a u + b b <= c; and the greatest b
    by the velocities."""

    a: NDArray[Any]
    b: NDArray[Any]
    c: NDArray[Any]
    fast: float

    def interval(self, b: float) -> tuple[float, float]:
        """The least and the greatest u at a b."""
        left = self.c - self.b * b
        up, down = self.a > FLAT, self.a < -FLAT
        low = (left[down] / self.a[down]).max(initial=-float("inf"))
        high = (left[up] / self.a[up]).min(initial=float("inf"))
        return float(low), float(high)

    def greatest(self, more: Bounds | None = None) -> float:
        """The greatest b for which there is a u."""
        import numpy as np

        parts = (self,) if more is None else (self, more)
        a, b, c = (np.concatenate([getattr(each, key) for each in parts]) for key in "abc")
        best = min(each.fast for each in parts)
        still = abs(a) <= FLAT
        rising = still & (b > FLAT)
        if rising.any():
            best = min(best, float((c[rising] / b[rising]).min()))
        up, down = a > FLAT, a < -FLAT
        # u <= (c - b b)/a above, u >= (c - b b)/a below: each pair bounds b
        high, low = (c[up] / a[up], b[up] / a[up]), (c[down] / a[down], b[down] / a[down])
        slope = high[1][:, None] - low[1][None, :]
        room = high[0][:, None] - low[0][None, :]
        bounding = slope > FLAT
        if bounding.any():
            best = min(best, float((room[bounding] / slope[bounding]).min()))
        return max(best, 0.0)


def fastest(first: Vector, second: Vector, limits: Limits, ends: tuple[float, float], steps: int) -> Fastest:
    """From rest to rest, with the derivatives of the path by its parameter."""
    import numpy as np

    s = np.linspace(*ends, steps + 1)
    step = float(s[1] - s[0])
    here = [bounds(first(float(x)), second(float(x)), *limits) for x in s]
    ahead = [_after(each, step) for each in here[1:]]
    beta = np.zeros(steps + 1)
    for k in range(steps - 1, -1, -1):
        beta[k] = _joined(here[k], ahead[k]).greatest(_next(beta[k + 1], step))
    b, u = np.zeros(steps + 1), np.zeros(steps)
    for k in range(steps):
        _, high = _joined(here[k], ahead[k]).interval(b[k])
        u[k] = min(high, (beta[k + 1] - b[k]) / (2 * step))
        b[k + 1] = max(b[k] + 2 * step * u[k], 0.0)
    rates = np.sqrt(b)
    pace = rates[1:] + rates[:-1]
    if not (pace > 0).all():
        raise ZeroDivisionError("it stands still on the way")
    t = np.concatenate([[0.0], np.cumsum(2 * step / pace)])
    return Fastest(s, b, u, t, np.array([each.greatest() for each in here]))


def bounds(q_s: NDArray[Any], q_ss: NDArray[Any], v_max: NDArray[Any], a_max: NDArray[Any]) -> Bounds:
    """|q_s u + q_ss b| <= a_max and |q_s| sqrt(b) <= v_max."""
    import numpy as np

    moving = abs(q_s) > FLAT
    fast = float(((v_max[moving] / q_s[moving]) ** 2).min(initial=np.inf))
    return Bounds(
        np.concatenate([q_s, -q_s]), np.concatenate([q_ss, -q_ss]), np.concatenate([a_max, a_max]), fast
    )


def _after(each: Bounds, step: float) -> Bounds:
    """The limits at the end of a step, where b has become b + 2 u step."""
    return Bounds(each.a + 2 * step * each.b, each.b, each.c, float("inf"))


def _joined(one: Bounds, other: Bounds) -> Bounds:
    import numpy as np

    a, b, c = (np.concatenate([getattr(each, key) for each in (one, other)]) for key in "abc")
    return Bounds(a, b, c, one.fast)


def _next(beta: float, step: float) -> Bounds:
    """0 <= b + 2 u step <= beta."""
    import numpy as np

    return Bounds(np.array([2 * step, -2 * step]), np.array([1.0, -1.0]), np.array([beta, 0.0]), float("inf"))
