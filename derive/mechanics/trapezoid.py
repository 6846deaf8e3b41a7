"""Trapezoidal profiles in numbers: solved by their formulas, and by a search that knows none of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, sqrt
from typing import Literal, TypeAlias

from derive.mechanics.course import Course, Piece

NEARLY = 1e-9
Case: TypeAlias = Literal["trapezoidal", "triangular", "infeasible"]


@dataclass(frozen=True, slots=True)
class Switching:
    """Accelerating up to t_1, at the velocity v up to t_2, at rest again at t_3."""

    case: Case
    t_1: float
    t_2: float
    t_3: float
    v: float
    a: float


def shortest(d: float, v_max: float, a_max: float) -> Switching:
    """The fastest way over a distance d > 0."""
    if v_max**2 / a_max < d * (1 - NEARLY):
        t_1, t_2 = v_max / a_max, d / v_max
        return Switching("trapezoidal", t_1, t_2, t_1 + t_2, v_max, a_max)
    t_3 = sqrt(4 * d / a_max)
    return Switching("triangular", t_3 / 2, t_3 / 2, t_3, a_max * t_3 / 2, a_max)


def timed(d: float, v_max: float, a_max: float, t_3: float) -> Switching:
    """The way in the time t_3 with the least acceleration; infeasible where that is too large."""
    t_1, v = t_3 / 2, 2 * d / t_3
    if v > v_max:
        v, t_1 = v_max, t_3 - d / v_max
    if t_1 <= 0 or v / t_1 > a_max * (1 + 1e-12):
        return Switching("infeasible", t_1, t_3 - t_1, t_3, v, v / t_1 if t_1 > 0 else float("inf"))
    case: Case = "triangular" if 2 * t_1 >= t_3 else "trapezoidal"
    return Switching(case, t_1, t_3 - t_1, t_3, v, v / t_1)


def course(found: Switching, start: float = 0.0, sign: float = 1.0) -> Course:
    """The three pieces, the middle one left out where it has no length."""
    a, v = sign * found.a, sign * found.v
    middle = start + a * found.t_1**2 / 2
    later = middle + v * (found.t_2 - found.t_1)
    pieces = (
        Piece(0.0, found.t_1, (start, 0.0, a / 2)),
        Piece(found.t_1, found.t_2, (middle, v)),
        Piece(found.t_2, found.t_3, (later, v, -a / 2)),
    )
    return tuple(piece for piece in pieces if piece.end > piece.start + 1e-12 * found.t_3)


# -- by search ----------------------------------------------------------------------------------------

FLAT = 1e-6  # of the whole time: a plateau that is shorter is none


def searched(d: float, v_max: float, a_max: float, t_3: float | None = None) -> Switching:
    """The fastest way, or the one of the least acceleration in a time, over all peak velocities."""
    if t_3 is None:
        v = _argument(lambda p: d / p + p / a_max, 0.0, v_max)
        a, t_3 = a_max, d / v + v / a_max
    elif v_max * t_3 <= d:
        return Switching("infeasible", t_3 - d / v_max, d / v_max, t_3, v_max, inf)
    else:
        whole = t_3
        v = _argument(lambda p: p / (whole - d / p), d / t_3, v_max)
        a = v / (t_3 - d / v)
    t_1 = v / a
    case: Case = "trapezoidal" if t_3 - 2 * t_1 > FLAT * t_3 else "triangular"
    return Switching(case if a <= a_max * (1 + NEARLY) else "infeasible", t_1, t_3 - t_1, t_3, v, a)


def searched_time(d: float, v_max: float, a_max: float) -> float:
    """The least time over all peak velocities: d/p + p/a_max."""
    return searched(d, v_max, a_max).t_3


def searched_acceleration(d: float, v_max: float, t_3: float) -> float:
    """The least acceleration over all peak velocities that arrive at t_3: p/(t_3 - d/p)."""
    return searched(d, v_max, inf, t_3).a


def _argument(of: Callable[[float], float], low: float, high: float) -> float:
    """Where a function with one minimum is least between two places (`low` left out)."""
    span = high - low
    low += 1e-9 * span
    for _ in range(90):
        left, right = low + (high - low) / 3, high - (high - low) / 3
        if of(left) < of(right):
            high = right
        else:
            low = left
    return high
