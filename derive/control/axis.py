"""Where the roots of a polynomial lie at random values of its symbols: what conditions are tried on."""

from __future__ import annotations

import random
from collections.abc import Collection, Iterator, Sequence
from fractions import Fraction

PARTS = 16  # values are whole multiples of 1/PARTS, so that coefficients are exact


def points(names: Sequence[str], positive: Collection[str], count: int) -> Iterator[dict[str, Fraction]]:
    """Values anyone gets again; every second point has negative ones too, `positive` names apart."""
    draw = random.Random(" ".join(names))
    for k in range(count):
        yield {
            name: Fraction(draw.randint(1, 6 * PARTS), PARTS)
            * (1 if name in positive or k % 2 else draw.choice((1, -1)))
            for name in names
        }
