"""Rational numbers: an int where whole, for ints hash and multiply several times faster than fractions."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import gcd, lcm
from typing import TypeAlias

from flint import fmpq

Rational: TypeAlias = int | Fraction


def lowest(value: Rational) -> Rational:
    """The same number, an int where it is whole."""
    return value.numerator if value.denominator == 1 else value


def over(top: Rational, bottom: Rational) -> Rational:
    """The exact quotient."""
    return top if bottom == 1 else lowest(Fraction(top) / bottom)


def of_flint(value: fmpq) -> Rational:
    """FLINT's rational as Python's."""
    return int(value.p) if value.q == 1 else Fraction(int(value.p), int(value.q))


def as_fraction(value: fmpq) -> Fraction:
    """FLINT's rational as Python's, a fraction even where it is whole."""
    return Fraction(int(value.p), int(value.q))


def to_flint(value: Rational) -> fmpq:
    """Python's rational as FLINT's."""
    return fmpq(value.numerator, value.denominator)


def measure(numbers: Iterable[Rational]) -> Fraction:
    """The greatest number of which all are whole multiples; its sign is positive."""
    several = tuple(numbers)
    return Fraction(gcd(*(n.numerator for n in several)), lcm(*(n.denominator for n in several)))


def decimal_places(value: Rational) -> int | None:
    """How many places a decimal fraction needs for this number; None where it never ends."""
    rest, needed = value.denominator, [0, 0]
    for k, prime in enumerate((2, 5)):
        while rest % prime == 0:
            rest, needed[k] = rest // prime, needed[k] + 1
    return max(needed) if rest == 1 else None


def significant_digits(value: Rational) -> int | None:
    """How many digits a decimal fraction has for this number, zeros at its ends apart; None where it never
    ends."""
    places = decimal_places(value)
    return None if places is None else len(str(abs(int(value * 10**places))).strip("0"))
