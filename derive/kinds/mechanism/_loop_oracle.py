"""Linkages in numbers: whether a loop of bars closes, and every way in which it does, by looking all round.

Points of the plane are complex numbers; nothing here knows a formula for an angle or a place.
"""

from __future__ import annotations

from cmath import exp, phase
from collections.abc import Callable
from itertools import pairwise
from math import tau

ROUND = 720  # places looked at
HALVINGS = 60


def tip(length: float, angle: float) -> complex:
    """Where a bar ends."""
    return length * exp(1j * angle)


def zeros(worth: Callable[[float], float], low: float, high: float) -> list[float]:
    """Every place at which a function changes its sign."""
    places = [low + (high - low) * (k + 0.37) / ROUND for k in range(ROUND + 1)]
    return [_halved(worth, a, b) for a, b in pairwise(places) if worth(a) * worth(b) < 0]


def rockers(crank: float, coupler: float, rocker: float, ground: float, angle: float) -> list[float]:
    """The angles of a rocker whose tip has the distance of the coupler from the end of the crank."""
    end = tip(crank, angle)
    return zeros(lambda theta: abs(ground + tip(rocker, theta) - end) - coupler, 0, tau)


def sliders(crank: float, rod: float, offset: float, angle: float) -> list[float]:
    """The places of a slider on its line that has the distance of the rod from the end of the crank."""
    end = tip(crank, angle)
    far = 1.5 * (crank + rod)
    return zeros(lambda s: abs(s + 1j * offset - end) - rod, -far, far)


def _halved(worth: Callable[[float], float], low: float, high: float) -> float:
    rising = worth(low) < 0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if (worth(middle) < 0) == rising else (low, middle)
    return (low + high) / 2


def angle_of(along: complex) -> float:
    """From the x axis, in (-pi, pi]."""
    return phase(along)
