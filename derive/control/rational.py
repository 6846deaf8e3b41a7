"""Rational functions of s as two polynomials with exact coefficients, highest power first."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache, reduce
from math import lcm
from typing import TypeAlias

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.rationals import as_fraction
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar, common_ring
from derive.algebra.solving.polynomials import coefficients as rising_coefficients
from derive.control.exact import common, divided, stripped
from derive.control.ratios import PLAIN, Ratio
from derive.control.roots import are_coprime
from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    Expr,
    Sum,
    Symbol,
    add,
    factors_of,
    free_symbols,
    is_negative,
    multiply,
    number,
    terms_of,
)

S = Symbol("s")
Polynomial: TypeAlias = tuple[Scalar, ...]  # coefficients, highest power first, the first not zero


@dataclass(frozen=True, slots=True)
class Rational:
    """num / den. Not reduced unless it says so: what cancels is a mode that the output does not show."""

    num: Polynomial
    den: Polynomial

    @staticmethod
    def of(ratio: Ratio) -> Rational:
        """An unexpanded ratio multiplied out; common factors stay."""
        if not ratio:
            return Rational((), (Scalar.of(1),))
        top = normal(Ratio(top=ratio.top).expr()) * ratio.scale
        return Rational(polynomial(top), polynomial(normal(Ratio(top=ratio.bottom).expr())))

    @property
    def proper(self) -> bool:
        """Whether the degree of the numerator is not above that of the denominator."""
        return len(self.num) <= len(self.den)

    @property
    def value(self) -> Scalar:
        """The quotient as one scalar, common factors cancelled."""
        return scalar(self.num) / scalar(self.den)

    def reduced(self) -> Rational:
        """Without common factors; itself where there are none."""
        if not all(map(_is_plain, (*self.num, *self.den))):
            return self._reduced_exactly()
        top, bottom = scalar(self.num), scalar(self.den)
        both = top + bottom  # lives in a ring that holds the two
        divisor = top.into(both.ring).numerator.gcd(bottom.into(both.ring).numerator)
        if not self.num:
            return Rational((), (Scalar.of(1),))
        if divisor.is_constant():
            return self
        value = top / bottom
        below = Scalar.of(1) if value.denominator is None else Scalar(value.ring, value.denominator)
        return Rational(*_cleared(polynomial(Scalar(value.ring, value.numerator)), polynomial(below)))

    def _reduced_exactly(self) -> Rational:
        """With roots and functions among the coefficients: s^2 - 2 = (s - sqrt(2)) (s + sqrt(2))."""
        if not self.num:
            return Rational((), (Scalar.of(1),))
        if not self.symbols() and (are_coprime(self.num, self.den) or are_coprime(self.den, self.num)):
            return self
        both = common(self.den, self.num)
        if len(both) == 1:
            return self
        return Rational(divided(self.num, both)[0], divided(self.den, both)[0])

    @property
    def cancelled(self) -> int:
        """How many poles zeros cancel."""
        return len(self.den) - len(self.reduced().den)

    def at(self, names: Mapping[Expr, Expr]) -> Rational:
        """With names replaced by what they stand for."""
        return Rational(stripped(at(self.num, names)), stripped(at(self.den, names)))

    def expr(self, style: Style = PLAIN) -> Expr:
        """Both polynomials collected by powers of s."""
        top, bottom = written(self.num, style), written(self.den, style)
        terms = top.terms if isinstance(top, Sum) else ()
        if bottom != ONE and terms and all(map(is_negative, terms)):
            top = written(tuple(-coefficient for coefficient in self.num), style)
            return MINUS_ONE * (top / bottom)
        return top if bottom == ONE else top / bottom

    def numbers(self) -> tuple[list[float], list[float]]:
        """The coefficients as floats. Raises KeyError where a symbol is left."""
        return _floats(self.num), _floats(self.den)

    def symbols(self) -> frozenset[str]:
        """The names of the coefficients; numbers such as pi and sqrt(2) are none."""
        return names_in((*self.num, *self.den))


def at(coefficients: Iterable[Scalar], names: Mapping[Expr, Expr]) -> list[Scalar]:
    """With names replaced, those inside roots and functions too."""
    values = {name.name: normal(name, names) for name in names if isinstance(name, Symbol)}

    def is_inside(k: Scalar) -> bool:
        """Whether one of the names stands inside a root or a function."""
        return any(
            _letters(k.ring, each) & values.keys() for each in k.generators() if not each.isidentifier()
        )

    return [normal(readable(k), names) if is_inside(k) else k.substitute(values) for k in coefficients]


def names_in(coefficients: Iterable[Scalar]) -> frozenset[str]:
    """The symbols, those inside roots and functions too."""
    return frozenset(
        name for k in coefficients if k for each in k.generators() for name in _letters(k.ring, each)
    )


@lru_cache(maxsize=1024)
def _letters(home: Ring, generator: str) -> frozenset[str]:
    """The symbols of one generator."""
    return free_symbols(readable(Scalar(home, home.gen(generator))))


def polynomial(value: Scalar) -> Polynomial:
    """The coefficients of a polynomial in s."""
    if S.name not in value.ring.index:
        return (value,) if value else ()
    if not value.numerator:
        return ()
    below = 1 if value.denominator is None else Scalar(value.ring, value.denominator)
    return tuple(k / below for k in reversed(rising_coefficients(value, S.name)))


def scalar(coefficients: Sequence[Scalar]) -> Scalar:
    """The polynomial of coefficients."""
    s = Scalar.symbol(S.name)
    value = Scalar.of(0)
    for coefficient in coefficients:
        value = value * s + coefficient
    return value


def times(left: Polynomial, right: Polynomial) -> Polynomial:
    """The product."""
    return polynomial(scalar(left) * scalar(right))


def plus(left: Polynomial, right: Polynomial) -> Polynomial:
    """The sum."""
    return polynomial(scalar(left) + scalar(right))


def written(coefficients: Sequence[Scalar], style: Style = PLAIN) -> Expr:
    """Collected: `J L_a s^3 + (J R_a + L_a b) s^2 + ...`; what all coefficients share comes first."""
    common = shared(coefficients)
    if common.constant is None:
        inner = written([coefficient / common for coefficient in coefficients], style)
        return multiply(*factors_of(readable(common, style)), inner)
    degree = len(coefficients) - 1
    terms = [
        _term(readable(coefficient, style), degree - place)
        for place, coefficient in enumerate(coefficients)
        if coefficient
    ]
    flat = [part for term in terms for part in terms_of(term)]
    return add(*flat) if flat else ZERO


def shared(coefficients: Sequence[Scalar]) -> Scalar:
    """The symbols common to two coefficients or more; else 1."""
    several = [coefficient for coefficient in coefficients if coefficient]
    if len(several) < 2 or any(coefficient.denominator is not None for coefficient in several):
        return Scalar.of(1)
    home = common_ring(several)
    polynomials = [coefficient.into(home).numerator for coefficient in several]
    common = reduce(lambda left, right: left.gcd(right), polynomials)
    return Scalar.of(1) if common.is_constant() else Scalar(home, common)


def _term(coefficient: Expr, power: int) -> Expr:
    if power == 0:
        return coefficient
    return multiply(*factors_of(coefficient), S if power == 1 else S ** number(power))


def _floats(coefficients: Polynomial) -> list[float]:
    return [scalar_number(c, {}) if c else 0.0 for c in coefficients]


def _is_plain(value: Scalar) -> bool:
    """Whether its generators are names, none of them a root or a function."""
    return all(name.isidentifier() for name in value.generators())


def _cleared(num: Polynomial, den: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Both multiplied so that no coefficient has a fraction."""
    below = lcm(*(_denominator(c) for c in (*num, *den)))
    return tuple(c * below for c in num), tuple(c * below for c in den)


def _denominator(value: Scalar) -> int:
    fractions = (as_fraction(c) for _, c in value.numerator.terms())
    return lcm(*(Fraction(f).denominator for f in fractions))
