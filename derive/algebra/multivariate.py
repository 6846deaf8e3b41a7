"""Polynomials in several generators, as FLINT holds them: their factors, their terms by the powers of some
generators.

Factors come in one order, whatever the release: python-flint 0.8 gives them in another than 0.9, and pages
list cases and solutions as the factors come.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from flint import fmpq, fmpq_mpoly


def factored(polynomial: fmpq_mpoly) -> tuple[fmpq, list[tuple[fmpq_mpoly, int]]]:
    """(number, irreducible factors with their powers), by power, then term by term."""
    return _in_order(*polynomial.factor())


def square_free(polynomial: fmpq_mpoly) -> tuple[fmpq, list[tuple[fmpq_mpoly, int]]]:
    """(number, factors without a square and with their powers), in the same order."""
    return _in_order(*polynomial.factor_squarefree())


def grouped(polynomial: fmpq_mpoly, places: Iterable[int]) -> dict[tuple[int, ...], fmpq_mpoly]:
    """The polynomial as one in the generators at these places: for each combination of their powers, in the
    order in which it is met, what stands before it, which holds none of them."""
    chosen = tuple(places)
    groups: dict[tuple[int, ...], dict[tuple[int, ...], fmpq]] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        powers = tuple([int(exponents[place]) for place in chosen])
        rest = list(exponents)
        for place in chosen:
            rest[place] = 0
        groups.setdefault(powers, {})[tuple(rest)] = coefficient
    context = polynomial.context()
    return {powers: context.from_dict(terms) for powers, terms in groups.items()}


def without(polynomial: fmpq_mpoly, places: Iterable[int]) -> fmpq_mpoly:
    """The terms that hold none of the generators at these places."""
    return polynomial.subs(dict.fromkeys(places, 0))


def _in_order(number: fmpq, found: list[tuple[fmpq_mpoly, Any]]) -> tuple[fmpq, list[tuple[fmpq_mpoly, int]]]:
    factors = [(factor, int(power)) for factor, power in found]
    return number, sorted(factors, key=_place) if len(factors) > 1 else factors


def _place(found: tuple[fmpq_mpoly, int]) -> tuple[int, list[Any]]:
    factor, power = found
    return power, list(factor.terms())
