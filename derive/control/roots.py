"""Roots of polynomials with numbers as coefficients: certified where those are rational."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import fmpq, fmpq_poly

from derive.algebra.scalar import Scalar

ON_THE_AXIS = 1e-9  # a real part this small against the root counts as zero


def roots(coefficients: Sequence[Scalar]) -> tuple[complex, ...]:
    """Every root, as often as it is one; rational coefficients go through FLINT's certified roots.

    Sorted by real part, the rightmost first.
    """
    exact = [coefficient.constant for coefficient in coefficients]
    if None not in exact and len(exact) > 1:
        found = _certified([fmpq(value.numerator, value.denominator) for value in exact if value is not None])
    else:
        found = _numeric(coefficients)
    return tuple(sorted(map(_cleaned, found), key=lambda root: (-root.real, abs(root.imag), -root.imag)))


def as_json(root: complex) -> float | dict[str, float]:
    """A float, or {"re", "im"}."""
    return root.real if root.imag == 0 else {"re": root.real, "im": root.imag}


def _certified(coefficients: list[fmpq]) -> list[complex]:
    polynomial: Any = fmpq_poly(coefficients[::-1])
    return [complex(root) for root, power in polynomial.complex_roots() for _ in range(int(power))]


def _numeric(coefficients: Sequence[Scalar]) -> list[complex]:
    import numpy

    from derive.algebra.numeric import scalar_number

    values = [scalar_number(coefficient, {}) if coefficient else 0.0 for coefficient in coefficients]
    return [complex(root) for root in numpy.roots(values)]


def _cleaned(root: complex) -> complex:
    """Rounding in the smaller part taken away."""
    re = 0.0 if abs(root.real) <= ON_THE_AXIS * abs(root) else root.real
    im = 0.0 if abs(root.imag) <= ON_THE_AXIS * abs(root) else root.imag
    return complex(re, im)
