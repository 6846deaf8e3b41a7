"""Cubic splines in floats, by one linear system for all coefficients: what exact ones are checked against."""

from __future__ import annotations

from collections.abc import Sequence


def solved_in_floats(
    times: Sequence[float], places: Sequence[float], velocities: Sequence[float | None]
) -> list[float]:
    """c_0, ..., c_3 of each piece in turn. Where a velocity is None the acceleration is continuous, or zero
    at an end; where it is given the piece before and the one after have it."""
    import numpy

    pieces = len(times) - 1
    rows: list[list[float]] = []
    right: list[float] = []

    def condition(value: float, *parts: tuple[int, list[float]]) -> None:
        row = [0.0] * (4 * pieces)
        for piece, weights in parts:
            row[4 * piece : 4 * piece + 4] = weights
        rows.append(row)
        right.append(value)

    for k in range(pieces):
        h = times[k + 1] - times[k]
        condition(places[k], (k, _weights(0.0, 0)))
        condition(places[k + 1], (k, _weights(h, 0)))
    for k, velocity in enumerate(velocities):
        before = None if k == 0 else (k - 1, times[k] - times[k - 1])
        after = None if k == pieces else (k, 0.0)
        sides = [side for side in (before, after) if side is not None]
        if velocity is not None:
            for piece, tau in sides:
                condition(velocity, (piece, _weights(tau, 1)))
        elif len(sides) == 1:
            condition(0.0, (sides[0][0], _weights(sides[0][1], 2)))
        else:
            for order in (1, 2):
                (left, tau), (right_piece, zero) = sides
                opposite = [-w for w in _weights(zero, order)]
                condition(0.0, (left, _weights(tau, order)), (right_piece, opposite))
    found: list[float] = numpy.linalg.solve(rows, right).tolist()
    return found


def acceleration_jumps(
    times: Sequence[float], places: Sequence[float], velocities: Sequence[float]
) -> list[float]:
    """By how much the acceleration changes at each point, where the pieces have these velocities at their
    ends; before the first and after the last there is none."""
    import numpy

    jumps = [0.0] * len(times)
    for k in range(len(times) - 1):
        h = times[k + 1] - times[k]
        ends = [_weights(tau, order) for tau in (0.0, h) for order in (0, 1)]
        cubic = numpy.linalg.solve(ends, [places[k], velocities[k], places[k + 1], velocities[k + 1]])
        jumps[k] += float(cubic @ _weights(0.0, 2))
        jumps[k + 1] -= float(cubic @ _weights(h, 2))
    return jumps


def _weights(tau: float, order: int) -> list[float]:
    """What multiplies c_0, ..., c_3 in a derivative at tau."""
    return [
        [1.0, tau, tau**2, tau**3],
        [0.0, 1.0, 2 * tau, 3 * tau**2],
        [0.0, 0.0, 2.0, 6 * tau],
    ][order]
