"""A course of motion in numbers: pieces of polynomials in time, sampled for a plot or looked up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isclose

SAMPLES = 160  # over the whole course
CLOSE = 1e-9  # of places where pieces meet


@dataclass(frozen=True, slots=True)
class Piece:
    """q = c_0 + c_1 tau + c_2 tau^2 + ..., tau = t - start, from `start` to `end`."""

    start: float
    end: float
    coefficients: tuple[float, ...]

    def at(self, t: float, order: int = 0) -> float:
        """The derivative of this order at the time t."""
        coefficients = self.coefficients
        for _ in range(order):
            coefficients = tuple(k * c for k, c in enumerate(coefficients))[1:]
        total = 0.0
        for coefficient in reversed(coefficients):
            total = total * (t - self.start) + coefficient
        return total


Course = tuple[Piece, ...]
Points = tuple[tuple[float, ...], tuple[float, ...]]


def is_joined(course: Sequence[Piece]) -> bool:
    """Whether it begins at the time 0, and each piece begins when and where the one before it ends."""
    if not course or course[0].start:
        return False
    size = max(abs(piece.at(t)) for piece in course for t in (piece.start, piece.end))
    return all(
        isclose(a.end, b.start) and isclose(a.at(a.end), b.at(b.start), rel_tol=CLOSE, abs_tol=CLOSE * size)
        for a, b in pairwise(course)
    )


def at(course: Sequence[Piece], t: float, order: int = 0) -> float:
    """The value, or a derivative, at a time; of the piece that ends there where two meet."""
    piece = next((piece for piece in course if t <= piece.end), course[-1])
    return piece.at(t, order)


def sampled(course: Sequence[Piece], order: int) -> Points:
    """Times and values; where a derivative jumps, both its values at that time."""
    whole = course[-1].end - course[0].start
    times: list[float] = []
    values: list[float] = []
    for piece in course:
        count = max(2, round(SAMPLES * (piece.end - piece.start) / whole))
        for k in range(count + 1):
            t = piece.start + (piece.end - piece.start) * k / count
            times.append(t)
            values.append(piece.at(t, order))
    return tuple(times), tuple(values)


def extremes(course: Sequence[Piece], order: int) -> tuple[float, float]:
    """The least and the greatest value of a derivative over the whole course."""
    import numpy

    values: list[float] = []
    for piece in course:
        polynomial = numpy.polynomial.Polynomial(piece.coefficients).deriv(order)
        turning = polynomial.deriv().roots().tolist() if polynomial.degree() > 1 else []
        length = piece.end - piece.start
        real = [complex(root).real for root in turning if abs(complex(root).imag) < 1e-12]
        inside = [tau for tau in real if 0 < tau < length]
        values += [float(polynomial(tau)) for tau in (0.0, length, *inside)]
    return min(values), max(values)
