"""The real roots of a polynomial in one unknown: exactly where square roots suffice, else enclosed."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from flint import arb, ctx, fmpq, fmpq_poly

from derive.algebra.exact_values import square_root
from derive.algebra.multivariate import square_free
from derive.algebra.rationals import as_fraction
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomials import (
    ball,
    coefficients,
    factors,
    holds,
    known_sign,
    monomials,
    numerator,
)
from derive.errors import NotDerivable

BITS = 160  # of the numbers that enclose a root
UNKNOWN = "unknown_"  # a letter that no author types


@dataclass(frozen=True, slots=True)
class RealRoot:
    """A root, exactly or as a ball that holds it and no other; real only where `real_if` is positive."""

    value: Scalar | arb
    real_if: Scalar | None = None


def real_roots(polynomial: Sequence[Scalar | arb], positive: Collection[str] = ()) -> list[RealRoot]:
    """The real roots of a polynomial, given by its coefficients with the constant term first. Raises
    NotDerivable where neither square roots nor enclosing reaches them."""
    if any(isinstance(k, arb) for k in polynomial):
        return _of_balls([ball(k, {}) if isinstance(k, Scalar) else k for k in polynomial])
    exact = [k for k in polynomial if isinstance(k, Scalar)]
    while len(exact) > 1 and not exact[-1]:
        exact.pop()
    return [found for part in _irreducible(exact) for found in _of_irreducible(part, positive)]


def _irreducible(exact: list[Scalar]) -> list[list[Scalar]]:
    """The coefficients of the factors over the rationals, parameters being letters."""
    if len(exact) < 3:
        return [exact]
    total = Scalar.of(0)
    for power, k in enumerate(exact):
        total = total + k * Scalar.symbol(UNKNOWN) ** power
    return [coefficients(part, UNKNOWN) for part in factors(numerator(total), (UNKNOWN,))]


def _of_irreducible(k: list[Scalar], positive: Collection[str]) -> list[RealRoot]:
    match len(k) - 1:
        case 0:
            return []
        case 1:
            return [RealRoot(-k[0] / k[1])]
        case 2:
            return _quadratic(k, positive)
        case 4 if not k[1] and not k[3]:
            return _biquadratic(k, positive)
    return _enclosed(k)


def _quadratic(k: list[Scalar], positive: Collection[str]) -> list[RealRoot]:
    c, b, a = k
    if not b:
        return _signed(Scalar.of(0), -c / a, Scalar.of(1), positive)
    return _signed(-b / (2 * a), b * b - 4 * a * c, 2 * a, positive)


def _signed(middle: Scalar, square: Scalar, over: Scalar, positive: Collection[str]) -> list[RealRoot]:
    """middle + and - sqrt(square)/over; the positive root first."""
    sign = known_sign(square, positive)
    if sign == -1:
        return []
    if sign == 0:
        return [RealRoot(middle)]
    away = either_root(square) / over
    if known_sign(away, positive) == -1:
        away = -away
    needs = square if sign is None else None
    return [RealRoot(middle + away, needs), RealRoot(middle - away, needs)]


def _biquadratic(k: list[Scalar], positive: Collection[str]) -> list[RealRoot]:
    """a v^4 + b v^2 + c by way of v^2."""
    found = []
    for outer in _quadratic([k[0], k[2], k[4]], positive):
        if isinstance(outer.value, Scalar):
            if outer.real_if is not None:
                raise NotDerivable(
                    "whether this biquadratic equation has real roots depends on its parameters"
                )
            found += _signed(Scalar.of(0), outer.value, Scalar.of(1), positive)
    return found


def either_root(square: Scalar) -> Scalar:
    """A square root of either sign: squares come out without the bars of an absolute value."""
    if square.constant is not None:
        return square_root(square.constant)
    if (simpler := _denested(square)) is not None:
        return simpler
    bottom = square.ring.one if square.denominator is None else square.denominator
    content, found = square_free(square.ring.reduce(square.numerator * bottom))
    outside = 1 / Scalar(square.ring, bottom)
    inside = Scalar.of(as_fraction(content))
    for factor, power in found:
        part = Scalar(square.ring, square.ring.reduce(factor))
        outside = outside * part ** (power // 2)
        inside = inside * part if power % 2 else inside
    return outside * root(inside)


def _denested(square: Scalar) -> Scalar | None:
    """sqrt(a + r), with r^2 rational, as sqrt((a + s)/2) +- sqrt((a - s)/2) where s^2 = a^2 - r^2 is a
    square."""
    if square.denominator is not None or not any(
        each.name in square.generators() for each in square.ring.roots
    ):
        return None
    whole = [term.constant for term in monomials(square) if term.constant is not None]
    a = whole[0] if whole else Fraction(0)
    rest = square - a
    b = (rest * rest).constant
    if b is None or (gap := a * a - b) < 0:
        return None
    above, below = _exact_root(gap.numerator), _exact_root(gap.denominator)
    if above is None or below is None:
        return None
    first, second = (a + Fraction(above, below)) / 2, (a - Fraction(above, below)) / 2
    if min(first, second) < 0:
        return None
    return square_root(first) + (known_sign(rest) or 0) * square_root(second)


def _exact_root(n: int) -> int | None:
    found = isqrt(n)
    return found if found * found == n else None


def _enclosed(k: list[Scalar]) -> list[RealRoot]:
    """Isolated by FLINT: each ball certainly holds one root and no other."""
    numbers = [value.constant for value in k]
    if None in numbers:
        names = "parameters" if any(holds(v, v.ring.symbols) for v in k) else "square roots"
        raise NotDerivable(
            f"an equation of degree {len(k) - 1} with {names} in it has no roots in square roots alone"
        )
    whole = fmpq_poly([fmpq(n.numerator, n.denominator) for n in numbers if n is not None])
    with ctx.workprec(BITS):
        return [RealRoot(c.real) for c, _ in whole.numer().complex_roots() if c.imag == 0]


def _of_balls(k: list[arb]) -> list[RealRoot]:
    """Of a linear or quadratic equation whose coefficients are only enclosed."""
    with ctx.workprec(BITS):
        while len(k) > 1 and k[-1] == 0:
            k = k[:-1]
        if len(k) == 2 and not k[1].contains(0):
            return [RealRoot(-k[0] / k[1])]
        if len(k) == 3 and not k[2].contains(0):
            square = k[1] * k[1] - 4 * k[0] * k[2]
            if square < 0:
                return []
            if square > 0:
                away = square.sqrt()
                return [RealRoot((-k[1] + away) / (2 * k[2])), RealRoot((-k[1] - away) / (2 * k[2]))]
    raise NotDerivable("a numerical root leaves an equation whose roots cannot be told apart")
