"""The fastest way from one velocity to another over a distance, by a search over the velocity in between."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, sqrt

from derive.mechanics.course import Course, Piece

GRID, ROUNDS = 2000, 9  # velocities looked at, and how often more closely


@dataclass(frozen=True, slots=True)
class Ways:
    """A distance (negative backwards), the velocities at both ends, and the limits."""

    d: float
    v_0: float
    v_f: float
    a_max: float
    v_max: float = inf


@dataclass(frozen=True, slots=True)
class Switched:
    """The velocity between the two ramps, which end and begin at these times, and the whole time."""

    v: float
    t_1: float
    t_2: float
    time: float


def covered(v: float, w: float, a_max: float) -> float:
    """The distance of a ramp between two velocities: its mean velocity times its time."""
    return (v + w) / 2 * abs(w - v) / a_max


def along(ways: Ways, v: float) -> Switched | None:
    """By this velocity in between; None where the rest of the way would be behind."""
    a = ways.a_max
    rest = ways.d - covered(ways.v_0, v, a) - covered(v, ways.v_f, a)
    slack = 1e-12 * (abs(ways.d) + (ways.v_0**2 + ways.v_f**2 + v**2) / a)
    if abs(rest) <= slack:
        coast = 0.0
    elif rest * v <= 0:
        return None
    else:
        coast = rest / v
    t_1, t_3 = abs(v - ways.v_0) / a, abs(v - ways.v_f) / a
    return Switched(v, t_1, t_1 + coast, t_1 + coast + t_3)


def searched(ways: Ways) -> Switched:
    """The fastest of all. Raises ValueError where none is found."""
    most = sqrt(ways.a_max * abs(ways.d)) + abs(ways.v_0) + abs(ways.v_f)
    low, high = -min(most, ways.v_max), min(most, ways.v_max)
    best: Switched | None = None
    for _ in range(ROUNDS):
        step = (high - low) / GRID
        found = [each for k in range(GRID + 1) if (each := along(ways, low + k * step))]
        best = min([*found, *([best] if best else [])], key=lambda each: each.time)
        low, high = max(best.v - 3 * step, low), min(best.v + 3 * step, high)
    if best is None:
        raise ValueError("no velocity does")
    return best


def course(ways: Ways, found: Switched, start: float) -> Course:
    """The pieces of it, those of no length left out."""
    first, last = ((found.v > v) - (found.v < v) for v in (ways.v_0, ways.v_f))
    middle = start + covered(ways.v_0, found.v, ways.a_max)
    later = middle + found.v * (found.t_2 - found.t_1)
    pieces = (
        Piece(0.0, found.t_1, (start, ways.v_0, first * ways.a_max / 2)),
        Piece(found.t_1, found.t_2, (middle, found.v)),
        Piece(found.t_2, found.time, (later, found.v, -last * ways.a_max / 2)),
    )
    return tuple(piece for piece in pieces if piece.end > piece.start + 1e-9 * found.time)
