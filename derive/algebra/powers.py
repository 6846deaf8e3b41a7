"""Powers with exponents that are no whole numbers: x^(2/3), 2^(x + 1)."""

from __future__ import annotations

from fractions import Fraction

from derive.algebra.fixed import factored
from derive.algebra.kernels import generator, opaque, root
from derive.algebra.scalar import Scalar, as_fraction
from derive.errors import NotReal


def power(base: Scalar, exponent: Scalar) -> Scalar:
    """base^exponent. What can be taken out of the exponent is: x^(7/3) is x^2 x^(1/3), and 2^(1 - 2 x) is
    2/(2^x)^2. Raises NotReal where a number has no such power that is real."""
    if base.constant == 1 or exponent.denominator is not None:
        return opaque("pow", (base, exponent)) if base.constant != 1 else base
    found = Scalar.of(1)
    for powers, coefficient in exponent.numerator.to_dict().items():
        times = as_fraction(coefficient)
        if any(powers):
            part = Scalar(exponent.ring, exponent.ring.context.from_dict({powers: 1})) / times.denominator
            found = found * opaque("pow", (base, part)) ** times.numerator
        else:
            whole, rest = divmod(times, 1)
            found = found * base ** int(whole) * _radical(base, rest.denominator) ** rest.numerator
    return found


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
