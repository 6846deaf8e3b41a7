"""Factors of polynomials in one order, whatever the release of FLINT: python-flint 0.8 gives them in another
than 0.9, and pages list cases and solutions as the factors come."""

from __future__ import annotations

from typing import Any

from flint import fmpq, fmpq_mpoly


def factored(polynomial: fmpq_mpoly) -> tuple[fmpq, list[tuple[fmpq_mpoly, int]]]:
    """(number, irreducible factors with their powers), by power, then term by term."""
    return _in_order(*polynomial.factor())


def square_free(polynomial: fmpq_mpoly) -> tuple[fmpq, list[tuple[fmpq_mpoly, int]]]:
    """(number, factors without a square and with their powers), in the same order."""
    return _in_order(*polynomial.factor_squarefree())


def _in_order(number: fmpq, found: list[tuple[fmpq_mpoly, Any]]) -> tuple[fmpq, list[tuple[fmpq_mpoly, int]]]:
    factors = [(factor, int(power)) for factor, power in found]
    return number, sorted(factors, key=_place) if len(factors) > 1 else factors


def _place(found: tuple[fmpq_mpoly, int]) -> tuple[int, list[Any]]:
    factor, power = found
    return power, list(factor.terms())
