"""Splines through points in numbers, coordinate by coordinate."""

from __future__ import annotations

from typing import Any

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as value_of
from derive.mechanics.paths import Via
from derive.mechanics.splines import solved_in_floats


class Solved:
    """The spline in floats."""

    def __init__(self, shape: Via, known: Point) -> None:
        self.times = [value_of(time, known) for time in shape.times]
        ends = 0.0 if shape.ends == "clamped" else None
        free: list[float | None] = [ends, *[None] * (len(self.times) - 2), ends]
        self.coefficients = [
            solved_in_floats(self.times, [value_of(place[k], known) for place in shape.places], free)
            for k in range(len(shape.places[0]))
        ]

    def at(self, t: float, order: int = 0) -> Any:
        """The place, or a derivative, at a time."""
        import numpy as np

        k = max(sum(t >= each for each in self.times[:-1]) - 1, 0)
        tau = t - self.times[k]
        pieces = (np.polynomial.Polynomial(each[4 * k : 4 * k + 4]) for each in self.coefficients)
        return np.array([piece.deriv(order)(tau) if order else piece(tau) for piece in pieces])

    def velocities(self) -> Any:
        """At the points (N + 1 by m)."""
        import numpy as np

        return np.array([self.at(t, 1) for t in self.times])
