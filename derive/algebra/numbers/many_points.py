"""Many polynomials in floats at many points: each generator is evaluated once a point for all of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from derive.algebra.numbers.floats import Point, scalar_number
from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar

Term: TypeAlias = tuple[float, tuple[tuple[int, int], ...]]  # coefficient, (generator, power) of each factor


@dataclass(frozen=True, slots=True)
class Quick:
    """Terms of polynomials in common generators."""

    generators: tuple[Scalar, ...]
    polynomials: tuple[tuple[Term, ...], ...]

    @staticmethod
    def of(values: Sequence[Scalar]) -> Quick:
        """Of normal forms without denominators."""
        numbers: dict[tuple[object, str], int] = {}
        generators: list[Scalar] = []
        polynomials = []
        for value in values:
            home, terms = value.ring, []
            for exponents, coefficient in value.numerator.terms():
                factors = []
                for name, power in zip(home.names, exponents, strict=True):
                    if power:
                        key = home, name
                        if key not in numbers:
                            numbers[key] = len(generators)
                            generators.append(Scalar(home, home.context.gen(home.index[name])))
                        factors.append((numbers[key], int(power)))
                terms.append((float(as_fraction(coefficient)), tuple(factors)))
            polynomials.append(tuple(terms))
        return Quick(tuple(generators), tuple(polynomials))

    def at(self, point: Point) -> list[float | None]:
        """The values at a point; None where a generator has none."""
        known = [_value(each, point) for each in self.generators]
        return [_sum(terms, known) for terms in self.polynomials]


def _value(generator: Scalar, point: Point) -> float | None:
    try:
        return scalar_number(generator, point)
    except KeyError:
        return None


def _sum(terms: Sequence[Term], known: Sequence[float | None]) -> float | None:
    total = []
    for coefficient, factors in terms:
        product = coefficient
        for place, power in factors:
            value = known[place]
            if value is None:
                return None
            product *= value**power
        total.append(product)
    return math.fsum(total)
