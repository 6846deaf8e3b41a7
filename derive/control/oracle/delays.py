"""Padé's fractions for e^x, by the continued fraction of e^x (Baker and Graves-Morris, Padé Approximants,
4.2)."""

from __future__ import annotations


def exponential(order: int, x: complex) -> complex:
    """1 + 2 x/(2 - x + x^2/(6 + x^2/(10 + ...))), cut off so that both degrees are the order."""
    rest = 0j
    for k in range(order - 1, 0, -1):
        rest = x * x / (4 * k + 2 + rest)
    return 1 + 2 * x / (2 - x + rest)
