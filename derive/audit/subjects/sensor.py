"""Sensors: an encoder counted edge by edge, a switched voltage integrated over its period."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import sympy
from sympy.combinatorics.graycode import bin_to_gray, gray_to_bin

from derive.audit.algebra import solution
from derive.audit.asked import Asked, Same, Test
from derive.audit.points import Point
from derive.mechanics.sensing import Encoder, Incremental

SAMPLES = 8  # of one line
TURN = 2 * sympy.pi


def resolution(asked: Asked, point: Point) -> Iterator[Test]:
    """What is left of a turn for each count, at the disc and behind the gear."""
    counts, gear = _counts(asked), _gear(asked)
    yield Same("counts", point.at(counts))
    yield Same("resolution", point.at(TURN / counts / gear))
    if asked.subject.gear is not None:
        yield Same("resolution_motor", point.at(TURN / counts))


def multi_turn(asked: Asked, point: Point) -> Iterator[Test]:
    """As many turns, each with its counts, as a second disk behind a gear tells."""
    bits, turn_bits = asked.formula(asked.subject.disc.bits), asked.formula(asked.subject.disc.turn_bits)
    turns = sympy.Integer(2) ** turn_bits
    yield Same("turns", point.at(turns))
    yield Same("bits", point.at(sympy.log(turns * 2**bits) / sympy.log(2)))
    yield Same("counts", point.at(turns * _counts(asked)))
    yield Same("range_motor", point.at(turns * TURN))
    if asked.subject.gear is not None:
        yield Same("range", point.at(turns * TURN / _gear(asked)))


def gray_code(asked: Asked, point: Point) -> Iterator[Test]:
    """SymPy's own Gray code, and the angle at that place."""
    bits = int(asked.formula(asked.subject.disc.bits))
    told = asked.options.code
    position = asked.options.position if told is None else int(gray_to_bin(told), 2)
    binary = format(position, f"0{bits}b")
    yield Same("position", point.number(position))
    yield Same("binary", [point.number(int(digit)) for digit in binary])
    yield Same("gray", [point.number(int(digit)) for digit in bin_to_gray(binary)])
    yield Same("angle", point.at(position * TURN / _counts(asked) / _gear(asked)))


def encoder_size(asked: Asked, point: Point) -> Iterator[Test]:
    """By logarithms, rounded up."""
    gear, options = _gear(asked), asked.options
    if options.resolution is not None:
        counts = TURN / gear / asked.formula(options.resolution)
        disc = asked.subject.disc
        if isinstance(disc, Incremental):
            each = _edges_of_a_line(int(asked.formula(disc.edges)))
            yield Same("lines", point.number(int(sympy.ceiling(counts / each))))
        else:
            yield Same("bits", point.number(max(1, int(sympy.ceiling(sympy.log(counts, 2))))))
    if options.range is not None:
        turns = gear * asked.formula(options.range) / TURN
        yield Same("turn_bits", point.number(max(1, int(sympy.ceiling(sympy.log(turns, 2))))))


def speed(asked: Asked, point: Point) -> Iterator[Test]:
    """The turns that were counted, in the time they took; one count more or less."""
    counted, period = asked.formula(asked.options.counts), asked.formula(asked.options.period)
    one = TURN / _counts(asked) / period
    yield Same("omega", point.at(counted * one / _gear(asked)))
    yield Same("quantum", point.at(one / _gear(asked)))
    yield Same("relative", point.at(1 / sympy.Abs(counted)))
    if asked.subject.gear is not None:
        yield Same("omega_motor", point.at(counted * one))


def mean_voltage(asked: Asked, point: Point) -> Iterator[Test]:
    """The integral over a period, in parts of the period; and the duty that has a wanted mean."""
    pulse, t, D = asked.subject, sympy.Symbol("_t"), sympy.Symbol("_D")
    high, low = asked.formula(pulse.high), asked.formula(pulse.low)
    mean = sympy.integrate(high, (t, 0, D)) + sympy.integrate(low, (t, D, 1))
    if pulse.duty is not None:
        duty = asked.formula(pulse.duty)
    else:
        (duty,) = solution([mean - asked.formula(pulse.mean)], [D])
    yield Same("duty", point.at(duty))
    yield Same("mean", point.at(mean.subs(D, duty)))
    if pulse.frequency is not None:
        yield Same("t_on", point.at(duty / asked.formula(pulse.frequency)))


def _gear(asked: Asked) -> sympy.Expr:
    encoder: Encoder = asked.subject
    return sympy.Integer(1) if encoder.gear is None else asked.formula(encoder.gear)


def _counts(asked: Asked) -> sympy.Expr:
    """Of a whole turn of the disc."""
    disc = asked.subject.disc
    if not isinstance(disc, Incremental):
        return 2 ** asked.formula(disc.bits)
    edges = asked.formula(disc.edges)
    return asked.formula(disc.lines) * (_edges_of_a_line(int(edges)) if edges.is_Integer else edges)


def _edges_of_a_line(counted: int) -> int:
    """Edges met while one line passes two tracks a quarter of it apart: those up of one track, all of that
    track, or all of both."""
    tracks = [[(k + shift) % SAMPLES < SAMPLES // 2 for k in range(SAMPLES + 1)] for shift in (0, 2)]
    edges = [list(pairwise(track)) for track in tracks]
    up = sum(after > before for before, after in edges[0])
    each = [sum(after != before for before, after in track) for track in edges]
    return {1: up, 2: each[0], 4: sum(each)}[counted]


KINDS = {
    "multi-turn": multi_turn,
    "gray-code": gray_code,
    "encoder-size": encoder_size,
    "resolution": resolution,
    "speed": speed,
    "mean-voltage": mean_voltage,
}
