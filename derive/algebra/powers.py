"""Powers with exponents that are no whole numbers: x^(2/3), 2^(x + 1)."""

from __future__ import annotations

from fractions import Fraction

from derive.algebra.exact_values import factored
from derive.algebra.rationals import as_fraction, measure
from derive.algebra.roots_and_functions import generator, opaque, root
from derive.algebra.scalar import Scalar
from derive.errors import NotReal

MAX_DEGREE = 64  # of a root; beyond it, as in x^1.570796, a power is left as it is


def power(base: Scalar, exponent: Scalar) -> Scalar:
    """base^exponent. What can be taken out of the exponent is: x^(7/3) is x^2 x^(1/3), and 2^(1 - 2 x) is
    2/(2^x)^2. Raises NotReal where a number has no such power that is real."""
    if base.constant == 1:
        return base
    if exponent.denominator is not None:
        times = _content(exponent)
        return opaque("pow", (base, exponent / times.numerator)) ** times.numerator
    found = Scalar.of(1)
    for powers, coefficient in exponent.numerator.terms():
        times = as_fraction(coefficient)
        if any(powers):
            part = Scalar(exponent.ring, exponent.ring.context.from_dict({powers: 1})) / times.denominator
            found = found * opaque("pow", (base, part)) ** times.numerator
        else:
            whole, rest = divmod(times, 1)
            found = found * base ** int(whole) * _broken(base, rest)
    return found


def _content(exponent: Scalar) -> Fraction:
    """The greatest number of which all coefficients above the line are multiples, signed as the first."""
    numbers = [as_fraction(k) for k in exponent.numerator.coeffs()]
    return measure(numbers) if numbers[0] > 0 else -measure(numbers)


def _broken(base: Scalar, exponent: Fraction) -> Scalar:
    """base^exponent for an exponent between 0 and 1."""
    if exponent.denominator > MAX_DEGREE:
        return opaque("pow", (base, Scalar.of(exponent)))
    return _radical(base, exponent.denominator) ** exponent.numerator


def _radical(base: Scalar, degree: int) -> Scalar:
    """base^(1/degree); of a number one generator for each prime below it, and x^(1/6) is sqrt(x^(1/3))."""
    if degree == 1:
        return base
    if degree % 2 == 0:
        return root(_radical(base, degree // 2))
    if base.denominator is not None:
        return opaque("pow", (base, Scalar.of(Fraction(1, degree))))
    number = base.constant
    if number is None:
        return generator("pow", (base, Scalar.of(Fraction(1, degree))), base, degree)
    if number < 0:
        raise NotReal(f"{number} to the power of 1/{degree} is not real")
    found = Scalar.of(Fraction(1, number.denominator))
    for prime, times in factored(number.numerator * number.denominator ** (degree - 1)):
        whole, rest = divmod(times, degree)
        of = Scalar.of(prime)
        under = generator("pow", (of, Scalar.of(Fraction(1, degree))), of, degree) if rest else of
        found = found * prime**whole * under**rest
    return found
