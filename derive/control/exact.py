"""Polynomials in one unknown over a field in which zero is decided: what they share, and how often.

Coefficients stand highest power first. They are FLINT's rationals where all are rational, and scalars in
normal form where there are roots of numbers or pi among them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias

from flint import fmpq

from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable

MOST_TERMS = 200  # of a coefficient

Coefficients: TypeAlias = tuple[Any, ...]  # of one field, highest power first, the first not zero


def field(values: Sequence[Scalar]) -> Coefficients:
    """Scalars as elements of the smallest field that has them all; leading zeros dropped."""
    numbers = [value.constant if value else fmpq(0) for value in values]
    if None in numbers:
        return stripped(tuple(values))
    return stripped(
        tuple(fmpq(k.numerator, k.denominator) if k else fmpq(0) for k in numbers if k is not None)
    )


def stripped(values: Sequence[Any]) -> Coefficients:
    """Without leading zeros."""
    return tuple(values[next((place for place, k in enumerate(values) if k), len(values)) :])


def monic(values: Sequence[Any]) -> Coefficients:
    """Divided by the first coefficient."""
    return tuple(k / values[0] for k in values)


def divided(top: Sequence[Any], bottom: Sequence[Any]) -> tuple[Coefficients, Coefficients]:
    """(quotient, remainder)."""
    left, found = list(top), []
    while len(left) >= len(bottom):
        factor = left[0] / bottom[0]
        found.append(factor)
        for place, k in enumerate(bottom):
            left[place] = left[place] - factor * k
        left = left[1:]
        _require_short(left)
    return tuple(found), stripped(left)


def _require_short(values: Sequence[Any]) -> None:
    longest = max((len(k.numerator) for k in values if isinstance(k, Scalar)), default=0)
    if longest > MOST_TERMS:
        raise NotDerivable(
            f"roots and functions in the coefficients make numbers of {longest} terms, and at most "
            f"{MOST_TERMS} are worked with; give decimals in their place"
        )


def common(left: Sequence[Any], right: Sequence[Any]) -> Coefficients:
    """The greatest common divisor, its first coefficient 1; () for two zeros."""
    while right:
        left, right = right, divided(left, right)[1]
        right = monic(right) if right else right
    return monic(left) if left else ()


def derivative(values: Sequence[Any]) -> Coefficients:
    """The derivative."""
    degree = len(values) - 1
    return tuple(k * (degree - place) for place, k in enumerate(values[:-1]))


def square_free(values: Coefficients) -> Iterator[tuple[Coefficients, int]]:
    """The roots by how often they are one: (polynomial with simple roots, multiplicity), by Yun's algorithm
    (Geddes, Czapor and Labahn, Algorithms for Computer Algebra, section 8.2)."""
    shared = common(values, derivative(values))
    left, power = divided(values, shared)[0], 1
    while len(left) > 1:
        both = common(left, shared)
        single = divided(left, both)[0]
        if len(single) > 1:
            yield monic(single), power
        left, shared, power = both, divided(shared, both)[0], power + 1


def symmetric(values: Coefficients) -> tuple[Coefficients, Coefficients]:
    """(g, q) with p(s) = g(s^2) q(s) for a square-free p with p(0) not zero: the roots of g(s^2) lie
    symmetric to the origin, and no two of q do. g is what the even and the odd part share."""
    even, odd = stripped(values[::-1][::2][::-1]), stripped(values[::-1][1::2][::-1])
    shared = common(even, odd)
    spread: list[Any] = []
    for k in shared:
        spread += [k, k * 0]
    return shared, divided(values, spread[:-1])[0]
