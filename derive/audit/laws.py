"""Laws of time from rest to rest in many digits: polynomials by conditions, trapezoids by their area."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import mpmath

from derive.audit.asked import Asked
from derive.audit.points import Point
from derive.mechanics.paths import Timing

Rates: TypeAlias = tuple[Any, Any, Any]


@dataclass(frozen=True, slots=True)
class Law:
    """The whole time, and what goes on at a time with its first two derivatives."""

    whole: Any
    at: Callable[[Any], Rates]


def law(asked: Asked, point: Point, low: Any, high: Any, speed: Any) -> Law:
    """Of a path whose parameter goes from `low` to `high`; its limits are those times the `speed`."""
    timing: Timing = asked.subject.timing
    sizes = {
        key: None if value is None else mpmath.mpf(point.at(asked.formula(value)))
        for key, value in (("time", timing.time), ("v", timing.v_max), ("a", timing.a_max))
    }
    if any(size is not None and size <= 0 for size in sizes.values()):
        raise ZeroDivisionError  # another point
    if timing.law == "trapezoidal":
        return _trapezoid((high - low) * speed, low, speed, **sizes)
    return _polynomial(low, high, sizes["time"], 2 if timing.law == "cubic" else 3)


def _polynomial(low: Any, high: Any, whole: Any, order: int) -> Law:
    count = 2 * order
    rows, right = [], []
    for at, place in ((mpmath.mpf(0), low), (whole, high)):
        for rate in range(order):
            rows.append([mpmath.ff(k, rate) * (at ** (k - rate) if k >= rate else 0) for k in range(count)])
            right.append(place if rate == 0 else mpmath.mpf(0))
    solved = mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix(right))

    def rates(time: Any) -> Rates:
        first, second, third = (
            sum(solved[k] * mpmath.ff(k, rate) * time ** (k - rate) for k in range(rate, count))
            for rate in range(3)
        )
        return first, second, third

    return Law(whole, rates)


def _trapezoid(length: Any, low: Any, speed: Any, time: Any, v: Any, a: Any) -> Law:
    """The area under the velocity is the length."""
    if time is None:
        v = min(v, mpmath.sqrt(a * length))
        time = length / v + v / a
    elif v is None:  # v^2/a - v time + length = 0
        v = a * (time - mpmath.sqrt(time**2 - 4 * length / a)) / 2
    t_1 = time - length / v
    a = v / t_1

    def rates(now: Any) -> Rates:
        if now <= t_1:
            found = a * now**2 / 2, a * now, a
        elif now <= time - t_1:
            found = v * (now - t_1 / 2), v, mpmath.mpf(0)
        else:
            found = length - a * (time - now) ** 2 / 2, a * (time - now), -a
        way, rate, change = found
        return low + way / speed, rate / speed, change / speed

    return Law(time, rates)
