"""Encoders that are turned in numbers, and a voltage whose wave is integrated.

Nothing here knows how many counts a turn has: the waves of the tracks are looked at, and their edges counted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import islice, pairwise
from math import cos, isclose, sin, tau

from derive.algebra.numbers.floats import number as at
from derive.expression import ONE, Expr, free_symbols
from derive.kinds.checks import random_points
from derive.mechanics.sensing import Absolute, Encoder

DRAWS, POINTS = 200, 3
STEPS = 64  # places within a line at which the tracks are looked at
MOST_BITS = 8  # of a disc all of whose readings are told apart one by one
SAMPLES = 1000  # of a period
READ = {1: "rising", 2: "both", 4: "quadrature"}  # edges of a line: how the tracks are read
Point = Mapping[str, float]


def counts_of_a_line(edges: int) -> int:
    """How often the counter steps while one line passes two tracks a quarter of a line apart."""
    first = [sin(tau * (k + 0.5) / STEPS) > 0 for k in range(STEPS + 1)]
    second = [cos(tau * (k + 0.5) / STEPS) > 0 for k in range(STEPS + 1)]
    rising = sum(b and not a for a, b in pairwise(first))
    both = sum(a != b for a, b in pairwise(first))
    other = sum(a != b for a, b in pairwise(second))
    return {"rising": rising, "both": both, "quadrature": both + other}[READ[edges]]


def readings(bits: int) -> int:
    """How many readings a disc has in a turn whose tracks are each half as wide as the one before."""
    if bits > MOST_BITS:
        return readings(bits - MOST_BITS) * readings(MOST_BITS)
    fine = 4 << bits
    turn = [(k + 0.5) / fine for k in range(fine)]
    return len({tuple(int(place * 2**track * 2) % 2 for track in range(bits)) for place in turn})


def turned(
    encoder: Encoder, symbols: Iterable[str], final: Callable[[Expr], Expr]
) -> Iterator[tuple[Point, float, float]]:
    """Points at which the disc can be built, with the counts of a turn of the motor and the gear. What sizes
    that are whole numbers are made of is a power of two. `final` puts in the values of `where`."""
    disc = encoder.disc
    sizes = [disc.bits] if isinstance(disc, Absolute) else [disc.lines, disc.edges]
    whole = frozenset[str]().union(*map(free_symbols, map(final, sizes)))
    gear = final(encoder.gear or ONE)
    found = (
        (place, counts, at(gear, place))
        for point in random_points(symbols, DRAWS)
        if (counts := _counts(encoder, place := _rounded(point, whole), final)) is not None
    )
    return islice(found, POINTS)


def _rounded(point: Point, whole: frozenset[str]) -> Point:
    return {name: float(1 << round(value)) if name in whole else value for name, value in point.items()}


def _counts(encoder: Encoder, point: Point, final: Callable[[Expr], Expr]) -> float | None:
    """Of a turn of the motor; None where the sizes are no whole numbers, or no disc is read so."""
    disc = encoder.disc
    if isinstance(disc, Absolute):
        bits = at(final(disc.bits), point)
        return float(readings(round(bits))) if _is_whole(bits) else None
    lines, edges = at(final(disc.lines), point), at(final(disc.edges), point)
    if not _is_whole(lines) or not _is_whole(edges) or round(edges) not in READ:
        return None
    return float(round(lines) * counts_of_a_line(round(edges)))


def _is_whole(size: float) -> bool:
    return size > 0.5 and isclose(size, round(size))


def mean_of_wave(high: float, low: float, on: float, period: float) -> float:
    """The area under a period over its length, sample by sample: high up to `on`, then low."""
    width = period / SAMPLES
    shares = (min(1.0, max(0.0, on / width - k)) for k in range(SAMPLES))
    return sum(share * high + (1 - share) * low for share in shares) / SAMPLES
