"""Values of symbols at which a profile is looked at."""

from __future__ import annotations

from collections.abc import Iterator
from math import exp, log
from random import Random

from derive.algebra.numbers.floats import Point
from derive.kinds.checks import random_points

TRIES, WIDER = 60, 200


def places(symbols: frozenset[str]) -> Iterator[Point]:
    """Random ones, then ones of any size and ones of any sign, for what is possible at few of them."""
    yield from random_points(symbols, TRIES)
    draw = Random(" ".join(sorted(symbols)))
    for _ in range(WIDER if symbols else 0):
        yield {name: exp(draw.uniform(log(1e-3), log(1e3))) for name in sorted(symbols)}
    for _ in range(WIDER if symbols else 0):
        yield {name: draw.choice((-1, 1)) * exp(draw.uniform(log(0.1), log(30))) for name in sorted(symbols)}
