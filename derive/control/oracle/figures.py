"""What is read off a step response, held to a curve that is known by its Laplace transform alone."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from derive.control.oracle.inversion import inverted

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[Any]

CLOSE = 2e-6  # of the height of the curve
MOST_TERMS = 6000  # of an inverted transform
TERMS = 60  # that are always taken
PLACES, MOST_PLACES = 48, 320  # of the curve, or of a part of it
WORK = 2e5  # terms of all places together
SWINGS, CLOSER = 2, 3  # the first ones, and how often a peak is looked at more closely
CIRCLE = 64  # points on which a transfer function is averaged about the origin
LOW, HIGH, BAND = 0.1, 0.9, 0.02


@dataclass(frozen=True, slots=True)
class Seen:
    """A response to a unit step, by output / input at arrays of s. `fastest` is its fastest swing [rad/s],
    `slowest` the distance of its nearest pole from the origin."""

    gain: Callable[[Array], Array]
    fastest: float
    slowest: float
    growth: float = 0.0  # of the mode that grows fastest [1/s]

    def at(self, times: Sequence[float]) -> Array:
        """y at times after 0. Where it swings too often, not a number."""
        import numpy as np

        found = np.full(len(times), math.nan)
        wanted = np.asarray(times, dtype=float)
        terms = TERMS + np.ceil(self.fastest * wanted)
        seen = (wanted > 0) & (terms <= MOST_TERMS)
        if seen.any():
            most = int(terms[seen].max())
            grown = np.exp(self.growth * wanted[seen])
            found[seen] = grown * inverted(self._damped, wanted[seen], most)
        return found

    def _damped(self, s: Array) -> Array:
        """The transform of y e^(-growth t)."""
        there = s + self.growth
        return self.gain(there) / there

    @property
    def last(self) -> float:
        """Where it settles: the transfer function at the origin, its mean on a circle without a pole in
        it."""
        return float(self.gain(self._circle).mean().real)

    @property
    def slope(self) -> float:
        """Of what it becomes in the end, if it grows by an integrator: s times the function at the
        origin."""
        return float((self._circle * self.gain(self._circle)).mean().real)

    @property
    def grows(self) -> bool:
        """Whether it has a slope in the end."""
        return abs(self.slope) > CLOSE * float(abs(self._circle * self.gain(self._circle)).max())

    @property
    def _circle(self) -> Array:
        """Places about the origin, no pole inside but one there."""
        import numpy as np

        turns = (np.arange(CIRCLE) + 0.5) / CIRCLE
        circle: Array = 0.4 * self.slowest * np.exp(2j * math.pi * turns)
        return circle

    def follows(self, times: Sequence[float], values: Sequence[float]) -> list[bool]:
        """Whether a curve is this one, at each of the times that are seen."""
        height = max(1e-300, *map(abs, values))
        pairs = zip(self.at(times), values, strict=True)
        return [bool(abs(y - value) <= CLOSE * height) for y, value in pairs if not math.isnan(y)]


@dataclass(frozen=True, slots=True)
class Figures:
    """What is read off: between which times it rises, after which it stays settled, the overshoot in
    percent and when it is highest; `end` is the last time that is looked at."""

    last: float
    rises: tuple[float, float]
    settling: float
    overshoot: float
    peak: float | None
    end: float


def agree(seen: Seen, told: Figures) -> Iterator[bool]:
    """Each of them against the curve, as shares of where it settles."""
    last, top = seen.last, 1 + told.overshoot / 100
    close = CLOSE * top
    yield abs(told.last - last) <= CLOSE * abs(last)

    def shares(times: Sequence[float]) -> list[float]:
        return [float(y) for y in seen.at(times) / last if not math.isnan(y)]

    for time, level in zip(told.rises, (LOW, HIGH), strict=True):
        if time > 0:
            yield from (abs(share - level) <= close for share in shares([time]))
            yield from (share < level + close for share in shares(between(0.0, time, PLACES)))
        else:
            yield from (share >= level - close for share in shares([1e-9 * told.end]))
    if told.settling > 0:
        yield from (abs(abs(share - 1) - BAND) <= close for share in shares([told.settling]))
    for times in _after(seen, told.settling, told.end):
        yield from (abs(share - 1) <= BAND + close for share in shares(times))
    for times in _after(seen, 0.0, told.end):
        yield all(share <= top + close for share in shares(times))
        yield _highest(shares, times) <= top + close
    if told.peak is not None and told.peak > 0:
        yield from (abs(share - top) <= close for share in shares([told.peak]))


def between(start: float, stop: float, count: int) -> list[float]:
    """Times spread evenly between two, without these."""
    return [start + (stop - start) * (k + 0.5) / count for k in range(count)]


def _after(seen: Seen, start: float, end: float) -> Iterator[list[float]]:
    """Times from one on: over all that is looked at, and over the first swings."""
    most = max(PLACES, min(MOST_PLACES, round(WORK / (TERMS + seen.fastest * end))))
    yield between(start, end, most)
    if seen.fastest:
        yield between(start, min(end, start + SWINGS * 2 * math.pi / seen.fastest), PLACES * SWINGS)


def _highest(shares: Callable[[Sequence[float]], list[float]], times: Sequence[float]) -> float:
    """The highest place of a curve near the highest of some times, looked at closer and closer."""
    found = -math.inf
    for _ in range(CLOSER):
        values = shares(times)
        if len(values) < len(times):
            break
        place = max(range(len(values)), key=values.__getitem__)
        found = max(found, values[place])
        around = times[max(0, place - 1)], times[min(len(times) - 1, place + 1)]
        times = between(*around, PLACES)
    return found
