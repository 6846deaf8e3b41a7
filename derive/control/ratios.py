"""Quotients of products as a person keeps them while eliminating: unexpanded, factor by factor."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import TypeAlias

from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.readable.terms import Alphabet, Atom, Style, terminates
from derive.expression import (
    MINUS_ONE,
    ONE,
    Expr,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    free_symbols,
    is_negative,
    multiply,
    number,
    terms_of,
    walk,
)

S = Symbol("s")
PLAIN = Style()
Factors: TypeAlias = tuple[tuple[Expr, int], ...]  # (base, power), powers positive, bases distinct


@dataclass(frozen=True, slots=True)
class Ratio:
    """scale * top / bottom. Factors are symbols, and sums as they were written but for the powers of s,
    which fall."""

    scale: Fraction = Fraction(1)
    top: Factors = ()
    bottom: Factors = ()

    @staticmethod
    def of(expr: Expr, style: Style = PLAIN) -> Ratio:
        """A tree taken apart into its factors; a sum with s in a denominator over a common one."""

        def part(inner: Expr) -> Ratio:
            return Ratio.of(inner, style)

        match expr:
            case Number(value):
                return Ratio(value)
            case Product(factors):
                return reduce(Ratio.__mul__, map(part, factors))
            case Quotient(top, bottom):
                return part(top) / part(bottom)
            case Power(base, Number(power)) if power.denominator == 1:
                return part(base).raised(int(power))
            case Sum(terms) if _has_s_below(expr):
                return total(map(part, terms), style)
            case Sum() if normal(expr) == 0:
                return Ratio(Fraction(0))
            case Sum(terms):
                return Ratio(top=((Sum(tuple(sorted(terms, key=lambda term: -degree(term)))), 1),))
            case _:
                return Ratio(top=((expr, 1),))

    def __mul__(self, other: Ratio) -> Ratio:
        top = _without_zeros(_joined(self.top, other.top))
        bottom = _without_zeros(_joined(self.bottom, other.bottom))
        shared = _shared(top, bottom)
        return Ratio(self.scale * other.scale, _taken(top, shared), _taken(bottom, shared))

    def __truediv__(self, other: Ratio) -> Ratio:
        return self * other.inverse()

    def __neg__(self) -> Ratio:
        return Ratio(-self.scale, self.top, self.bottom)

    def __bool__(self) -> bool:
        return self.scale != 0

    def inverse(self) -> Ratio:
        """Raises ZeroDivisionError for zero."""
        return Ratio(1 / self.scale, self.bottom, self.top)

    def raised(self, power: int) -> Ratio:
        """A whole power. Raises ZeroDivisionError for a negative one of zero."""
        base = self if power >= 0 else self.inverse()
        return reduce(Ratio.__mul__, [base] * abs(power), Ratio())

    def expr(self, style: Style = PLAIN) -> Expr:
        """As it is written: numbers, symbols, s, then sums; one fraction bar, a minus sign before it."""
        if self.scale < 0 and self.bottom:
            return MINUS_ONE * (-self).expr(style)
        whole = style.decimals or self.scale.denominator == 1
        above = self.scale if whole else Fraction(self.scale.numerator)
        below = Fraction(1) if whole else Fraction(self.scale.denominator)
        top = _product(above, self.top, style)
        bottom = _product(below, self.bottom, style)
        return top if bottom == ONE else top / bottom

    def parts(self, style: Style = PLAIN) -> tuple[Expr, Expr]:
        """(numerator, denominator) as they are written; a minus sign is in the numerator."""
        size = Ratio(abs(self.scale), self.top, self.bottom).expr(style)
        top, bottom = (size.numerator, size.denominator) if isinstance(size, Quotient) else (size, ONE)
        return -top if self.scale < 0 else top, bottom


def total(ratios: Iterable[Ratio], style: Style = PLAIN) -> Ratio:
    """The sum over a common denominator, common factors (but no s) taken out, the highest power of s
    first; zero where it cancels."""
    parts = [ratio for ratio in ratios if ratio]
    nothing: Factors = ()
    bottom = reduce(_least_multiple, (part.bottom for part in parts), nothing)
    tops = _merged([part * Ratio(top=bottom) for part in parts])
    if len(tops) <= 1:
        return tops[0] / Ratio(top=bottom) if tops else Ratio(Fraction(0))
    common = reduce(_shared, (top.top for top in tops))
    common = tuple((base, power) for base, power in common if base != S)
    rests = [Ratio(top.scale, _taken(top.top, common)) for top in tops]
    terms = sorted((term for rest in rests for term in terms_of(rest.expr(style))), key=lambda t: -degree(t))
    sign = -1 if all(map(is_negative, terms)) else 1
    inner = Sum(tuple(-term for term in terms) if sign < 0 else _positive_first(terms))
    if normal(inner) == 0:
        return Ratio(Fraction(0))
    return Ratio(Fraction(sign), common) * Ratio(top=((inner, 1),)) / Ratio(top=bottom)


def _has_s_below(expr: Expr) -> bool:
    """Whether some denominator in it holds s."""
    return any(
        (isinstance(node, Quotient) and S.name in free_symbols(node.denominator))
        or (isinstance(node, Power) and is_negative(node.exponent) and S.name in free_symbols(node.base))
        for node in walk(expr)
    )


def degree(expr: Expr) -> int:
    """The degree in s of a polynomial."""
    value = normal(expr)
    return int(value.numerator.degrees()[value.ring.index[S.name]]) if S.name in value.ring.index else 0


def _merged(tops: list[Ratio]) -> list[Ratio]:
    """Like terms added."""
    found: dict[frozenset[tuple[Expr, int]], Ratio] = {}
    for top in tops:
        key = frozenset(top.top)
        before = found[key].scale if key in found else Fraction(0)
        found[key] = Ratio(before + top.scale, top.top)
    return [top for top in found.values() if top]


def _positive_first(terms: list[Expr]) -> tuple[Expr, ...]:
    """A term without a sign first where the highest power has one."""
    first = next(place for place, term in enumerate(terms) if not is_negative(term))
    return (terms[first], *terms[:first], *terms[first + 1 :])


def _product(scale: Fraction, factors: Factors, style: Style) -> Expr:
    alphabet = Alphabet(style)

    def place(factor: tuple[Expr, int]) -> tuple[object, ...]:
        base = factor[0]
        if isinstance(base, Symbol):
            kind = 1 if base == S else 0
            return kind, alphabet.key(alphabet.number(Atom("symbol", base.name)))
        return 2, -degree(base) if S.name in free_symbols(base) else 0, text(base)

    ordered = sorted(factors, key=place)
    powers = [base ** number(power) if power > 1 else base for base, power in ordered]
    return multiply(Number(scale, style.decimals and terminates(scale)), *powers)


def _same(left: Expr, right: Expr) -> bool:
    if left == right:
        return True
    return isinstance(left, Sum) and isinstance(right, Sum) and normal(left) == normal(right)


def _power_in(base: Expr, factors: Factors) -> int:
    return next((power for other, power in factors if _same(base, other)), 0)


def _joined(left: Factors, right: Factors) -> Factors:
    new = tuple((base, power) for base, power in right if not _power_in(base, left))
    return tuple((base, power + _power_in(base, right)) for base, power in left) + new


def _shared(left: Factors, right: Factors) -> Factors:
    return _without_zeros(tuple((base, min(power, _power_in(base, right))) for base, power in left))


def _taken(factors: Factors, away: Factors) -> Factors:
    return _without_zeros(tuple((base, power - _power_in(base, away)) for base, power in factors))


def _least_multiple(left: Factors, right: Factors) -> Factors:
    return _joined(left, _taken(right, _shared(left, right)))


def _without_zeros(factors: Factors) -> Factors:
    return tuple((base, power) for base, power in factors if power > 0)
