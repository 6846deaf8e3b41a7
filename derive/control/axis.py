"""Where the roots of a polynomial lie at random values of its symbols: what conditions are tried on."""

from __future__ import annotations

import random
from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction

from derive.algebra.numeric import scalar_number
from derive.algebra.scalar import Scalar
from derive.control.roots import roots

PARTS = 16  # values are whole multiples of 1/PARTS, so that coefficients are exact


def points(names: Sequence[str], positive: Collection[str], count: int) -> Iterator[dict[str, float]]:
    """Values anyone gets again; every second point has negative ones too, `positive` names apart."""
    draw = random.Random(" ".join(names))
    for k in range(count):
        yield {
            name: draw.randint(1, 6 * PARTS)
            / PARTS
            * (1 if name in positive or k % 2 else draw.choice((1, -1)))
            for name in names
        }


def roots_at(polynomial: Sequence[Scalar], point: Mapping[str, float]) -> tuple[complex, ...]:
    """Every root there; () where the leading coefficient is zero."""
    values = [Fraction(scalar_number(k, point)) if k else Fraction(0) for k in polynomial]
    return roots([Scalar.of(value) for value in values]) if values[0] else ()
