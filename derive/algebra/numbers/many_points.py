"""Many polynomials in floats at many points: each generator is evaluated once a point for all of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from flint import fmpq

from derive.algebra.numbers.floats import Point, scalar_number
from derive.algebra.rationals import as_fraction
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar

Term: TypeAlias = tuple[float, tuple[tuple[int, int], ...]]  # coefficient, (generator, power) of each factor


@dataclass(frozen=True, slots=True)
class Polynomials:
    """Terms of polynomials in common generators."""

    generators: tuple[Scalar, ...]
    polynomials: tuple[tuple[Term, ...], ...]

    @staticmethod
    def of(values: Sequence[Scalar]) -> Polynomials:
        """Of normal forms without denominators."""
        numbers: dict[tuple[Ring, int], int] = {}

        def term(home: Ring, powers: Sequence[int], k: fmpq) -> Term:
            used = (((home, place), int(power)) for place, power in enumerate(powers) if power)
            return float(as_fraction(k)), tuple((numbers.setdefault(key, len(numbers)), n) for key, n in used)

        found = tuple(tuple(term(value.ring, *each) for each in value.numerator.terms()) for value in values)
        return Polynomials(tuple(Scalar(home, home.context.gen(place)) for home, place in numbers), found)

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
