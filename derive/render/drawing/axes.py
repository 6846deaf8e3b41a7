"""Axes of a plot: from numbers to points of the paper, and where the ticks are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import ceil, floor, log10

from derive.derivation import Place
from derive.render.numbers import rounded_latex

STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)  # between ticks, times a power of ten
LEAST = 13.0  # points between ticks, where there would be fewer than three otherwise
DIGITS = 6  # of what stands at a tick, at most
NONE = 1e-9  # of a step: what rounding leaves


@dataclass(frozen=True, slots=True)
class Axis:
    """Numbers from `low` to `high` along points from `start` to `end`, evenly or by their logarithms."""

    low: float
    high: float
    start: float
    end: float
    log: bool = False

    def at(self, value: float) -> float:
        """Where on the paper."""
        low, high, value = (log10(x) for x in (self.low, self.high, value)) if self.log else (
            self.low, self.high, value,
        )  # fmt: skip
        return self.start + (self.end - self.start) * (value - low) / (high - low)

    def ticks(self, room: float, whole: bool = False) -> list[float]:
        """Round numbers, about `room` points apart or more; `whole` ones only where that is asked."""
        if self.log:
            return self._powers(room)
        most = max(1.0, abs(self.end - self.start) / room)
        step = _step((self.high - self.low) / most)
        step = max(1.0, float(ceil(step))) if whole else step
        first, last = ceil(self.low / step - NONE), floor(self.high / step + NONE)
        if last - first < 2 and room > LEAST and not whole:
            return self.ticks(0.75 * room)
        return [k * step for k in range(first, last + 1)]

    def _powers(self, room: float) -> list[float]:
        first, last = ceil(log10(self.low) - NONE), floor(log10(self.high) + NONE)
        step = max(1, ceil((last - first) * room / abs(self.end - self.start)))
        return [10.0**k for k in range(first, last + 1) if k % step == 0]

    def written(self, tick: float) -> str:
        """What stands at a tick."""
        if self.log:
            return f"$10^{{{round(log10(tick))}}}$"
        small = abs(tick) <= NONE * (self.high - self.low)
        return "0" if small else f"${rounded_latex(tick, DIGITS)}$"


@dataclass(frozen=True, slots=True)
class Frame:
    """Both axes of a plot; a `panel` has another above it."""

    x: Axis
    y: Axis
    panel: bool = False

    def at(self, place: Place) -> Place:
        return self.x.at(place[0]), self.y.at(place[1])


def _step(least: float) -> float:
    power = 10.0 ** floor(log10(least))
    return next(step * power for step in STEPS if step * power >= least * (1 - NONE))


def span(values: Iterable[float], room: float = 0.0, log: bool = False) -> tuple[float, float]:
    """From the least to the greatest, with room (a share of it) on both sides; never nothing."""
    found = list(values)
    low, high = min(found), max(found)
    if log:
        return 10.0 ** floor(log10(low) + NONE), 10.0 ** ceil(log10(high) - NONE) * (
            10.0 if low == high else 1.0
        )
    if high - low <= NONE * max(abs(low), abs(high)):
        low, high = low - (abs(low) or 1.0) / 2, high + (abs(high) or 1.0) / 2
    return low - room * (high - low), high + room * (high - low)
