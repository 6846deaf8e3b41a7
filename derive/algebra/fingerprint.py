"""What a tree says, as one value: trees of the same value are equal as they are written.

A tree is worked out in a ring in which nothing commutes: each name is a triangular matrix (a b; 0 c) of
residues modulo a large prime, drawn from its letters, each function one drawn from its name and the values
of its arguments. So `2 (a + b)` and `2 a + 2 b` are alike, `A B` and `B A` are not, and neither are two
angles or two indices. That different trees are alike by accident happens once in about 10^15 pairs (Schwartz
and Zippel); a tree of any shape has a value, and nothing is rounded.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, reduce
from hashlib import blake2b
from typing import TypeAlias

from derive.expression import (
    PI,
    Approximate,
    Call,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Measured,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

PRIME = 2**61 - 1
BYTES = 8  # of one residue
LARGEST_POWER = 64  # worked out; others are functions of base and exponent

Element: TypeAlias = tuple[int, int, int]  # a, b, c of the matrix (a b; 0 c)


def fingerprint(expr: Expr, digits: int) -> Element:
    """The value of a tree, rounded numbers taken to so many significant digits."""
    return _Walk(digits).value(expr)


@dataclass(slots=True)
class _Walk:
    digits: int

    def value(self, expr: Expr) -> Element:
        # in the order of how often they occur; a `match` on dataclasses takes twice as long
        if isinstance(expr, Symbol):
            return _drawn(expr.name)
        if isinstance(expr, Number):
            return _number(expr.value)
        if isinstance(expr, Product):
            return reduce(_multiplied, map(self.value, expr.factors))
        if isinstance(expr, Call):
            return self._call(expr.function, expr.arguments)
        if isinstance(expr, Sum):
            return reduce(_added, map(self.value, expr.terms))
        if isinstance(expr, Power):
            return self._power(self.value(expr.base), expr.exponent)
        if isinstance(expr, Quotient):
            return _multiplied(self.value(expr.numerator), _inverse(self.value(expr.denominator)))
        return self._rarer(expr)

    def _rarer(self, expr: Degrees | Approximate | Matrix | Derivative | Indexed | Measured) -> Element:
        match expr:
            case Degrees(value):
                return _multiplied(_number(value / 180), self.value(PI))
            case Approximate(value):
                return _number(_rounded(value, self.digits))
            case Matrix(rows):
                entries = (self.value(entry) for row in rows for entry in row)
                return _function(f"matrix of {len(rows)} rows", entries)
            case Measured(inner, unit):
                return _function(f"in {unit}", [self.value(inner)])
            case Derivative(of, by):
                return _function("derivative", map(self.value, (of, by)))
            case Indexed("e", (), (exponent,)):
                return _function("exp", [self.value(exponent)])
            case Indexed(base, lower, upper):
                return _function(f"{base} with {len(lower)} below", map(self.value, lower + upper))

    def _power(self, base: Element, exponent: Expr) -> Element:
        match exponent:
            case Number(value) if value.denominator == 1 and abs(value) <= LARGEST_POWER:
                power = reduce(_multiplied, [base] * abs(int(value)), _number(Fraction(1)))
                return _inverse(power) if value < 0 else power
            case Number(value) if value == Fraction(1, 2):
                return _function("sqrt", [base])
        return _function("power", [base, self.value(exponent)])

    def _call(self, function: str, arguments: tuple[Expr, ...]) -> Element:
        values = [self.value(argument) for argument in arguments]
        return _inverse(values[0]) if function == "inverse" else _function(function, values)


def _added(left: Element, right: Element) -> Element:
    return (left[0] + right[0]) % PRIME, (left[1] + right[1]) % PRIME, (left[2] + right[2]) % PRIME


def _multiplied(left: Element, right: Element) -> Element:
    a, b, c = left
    d, e, f = right
    return a * d % PRIME, (a * e + b * f) % PRIME, c * f % PRIME


def _inverse(value: Element) -> Element:
    a, b, c = value
    if not a or not c:
        return _function("inverse", [value])  # of zero, as it may stand on a page
    over_a, over_c = pow(a, -1, PRIME), pow(c, -1, PRIME)
    return over_a, -b * over_a * over_c % PRIME, over_c


def _number(value: Fraction) -> Element:
    top, bottom = value.numerator, value.denominator
    residue = (top if bottom == 1 else top * pow(bottom, -1, PRIME)) % PRIME
    return residue, 0, residue


def _rounded(value: float, digits: int) -> Fraction:
    """As a page shows it, without what rounding leaves of a zero."""
    return Fraction(f"{value:.{digits - 1}e}") if abs(value) > 1e-12 else Fraction(0)


@cache
def _drawn(name: str) -> Element:
    """A block of zeros, called 0, is zero."""
    return _number(Fraction(name)) if name.isdigit() else _function(name, ())


def _function(name: str, arguments: Iterable[Element]) -> Element:
    drawn = blake2b(name.encode(), digest_size=3 * BYTES)
    for a, b, c in arguments:
        drawn.update((a << 128 | b << 64 | c).to_bytes(3 * BYTES, "big"))
    found = drawn.digest()
    a, b, c = (int.from_bytes(found[k : k + BYTES], "big") % PRIME for k in range(0, 3 * BYTES, BYTES))
    return a, b, c
