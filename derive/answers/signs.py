"""The signs of normal forms at a point."""

from __future__ import annotations

import math
from collections.abc import Mapping

from derive.algebra.numbers.floats import generator_numbers
from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable

ZERO = 1e-9  # as against the size of the terms: a sign that rounding could turn is none


def sign_at(of: Scalar, point: Mapping[str, float]) -> int:
    """1 or -1. Raises NotDerivable for what is as good as zero, KeyError for what has no value there."""
    generators = generator_numbers(of, point)
    total = 1
    for polynomial in (of.numerator, of.denominator):
        if polynomial is not None:
            terms = [
                float(as_fraction(k))
                * math.prod(value ** int(e) for value, e in zip(generators, powers, strict=True) if e)
                for powers, k in polynomial.terms()
            ]
            value = math.fsum(terms)
            if abs(value) <= ZERO * math.fsum(map(abs, terms)):
                raise NotDerivable("a sign that is not known")
            total *= 1 if value > 0 else -1
    return total
