"""Exact values of fixed angles and of square roots of numbers; cosines and sines come as pairs."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from functools import lru_cache, reduce
from math import isqrt
from typing import TypeAlias

from flint import fmpz

from derive.algebra.angles import Form
from derive.algebra.generators import PI, Root
from derive.algebra.ring import ring
from derive.algebra.scalar import Scalar, trig
from derive.errors import NotReal

Pair: TypeAlias = tuple[Scalar, Scalar]  # (cosine, sine)

LARGEST = 10**36  # that is factored in a moment
TRIED = 10**4


@lru_cache(maxsize=256)
def square_root(value: Fraction) -> Scalar:
    """The root of a number, with one generator for each prime below it. Raises NotReal where the number is
    negative."""
    if value < 0:
        raise NotReal(f"the square root of {value} is not real")
    if value == 0:
        return Scalar.of(0)
    outside, primes = _split(value.numerator * value.denominator)
    result = Scalar.of(Fraction(outside, value.denominator))
    for prime in primes:
        result = result * _prime_root(prime)
    return result


def added(a: Pair, b: Pair) -> Pair:
    """The pair of the sum of two angles, by the addition theorem."""
    return a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]


def multiple(pair: Pair, n: int) -> Pair:
    """The pair of n times the angle."""
    base = pair if n >= 0 else (pair[0], -pair[1])
    return reduce(added, [base] * abs(n), (Scalar.of(1), Scalar.of(0)))


def form_trig(form: Form) -> Pair:
    """(cosine, sine) of a form."""
    kept = with_offset(form)
    turns = (form + kept.scaled(-1)).of_atom(PI)
    if not kept.parts:
        return fixed_trig(turns)
    return added(trig(kept), fixed_trig(turns)) if turns else trig(kept)


def with_offset(form: Form) -> Form:
    """What moves, and the offset that stays with it: theta + 25 deg is one angle; multiples of 15 degrees,
    which have roots for their sines, stand apart, and so do fixed angles in degrees that nothing moves."""
    turns, rest = form.of_atom(PI), form.without(PI)
    if not rest.moving.parts or _simple(turns):
        return rest
    return rest + Form.of({PI: turns - 2 * round(turns / 2)})


@lru_cache(maxsize=256)
def fixed_trig(turns: Fraction) -> Pair:
    """(cosine, sine) of `turns * pi`: with square roots for multiples of 15 degrees.

    Any other fixed angle becomes a generator pair of its own, of which its ring knows c^2 + s^2 = 1 only;
    what else holds between fixed angles and roots, `fixed_angles.zero_recognition` knows.
    """
    return _fifteenths(int(12 * turns) % 24) if _simple(turns) else trig(Form.of({PI: turns}))


def _simple(turns: Fraction) -> bool:
    return (12 * turns).denominator == 1


def _fifteenths(steps: int) -> Pair:
    """Multiples of 15 degrees from those of the first quarter."""
    quarter, rest = divmod(steps, 6)
    c, s = _of_quarter(rest)
    return ((c, s), (-s, c), (-c, -s), (s, -c))[quarter]


def _of_quarter(steps: int) -> Pair:
    """15 and 75 degrees by the addition theorem from 45 and 30."""
    half = Fraction(1, 2)
    match steps:
        case 0:
            return Scalar.of(1), Scalar.of(0)
        case 2:
            return square_root(Fraction(3, 4)), Scalar.of(half)
        case 3:
            return square_root(half), square_root(half)
        case 4:
            return Scalar.of(half), square_root(Fraction(3, 4))
    (c1, s1), (c2, s2) = _of_quarter(3), _of_quarter(2)
    sign = 1 if steps == 5 else -1
    return c1 * c2 - sign * s1 * s2, s1 * c2 + sign * c1 * s2


def _prime_root(prime: int) -> Scalar:
    name = f"sqrt({prime})"
    home = ring().with_root(Root(name, (((), Fraction(prime)),)))
    return Scalar(home, home.gen(name))


def factored(n: int) -> list[tuple[int, int]]:
    """(prime, power) of a positive number: first the small primes, then those of the rest, which counts as
    one where it is too large to be factored. It is the same whatever small primes stand with it."""
    if n < LARGEST:
        return _whole(fmpz(n).factor())
    pairs = _whole(fmpz(n).factor(TRIED))
    return [
        (prime, power * outer)
        for base, outer in pairs
        for prime, power in (_whole(fmpz(base).factor()) if TRIED < base < LARGEST else [(base, 1)])
    ]


def _whole(found: Iterable[tuple[fmpz, fmpz]]) -> list[tuple[int, int]]:
    return [(int(prime), int(power)) for prime, power in found]


def _split(n: int) -> tuple[int, tuple[int, ...]]:
    """n = outside^2 * product of the distinct primes, as far as it is factored."""
    outside, primes = 1, []
    for base, power in factored(n):
        if (square := isqrt(base)) ** 2 == base:  # only of what was left unfactored
            base, power = square, 2 * power
        outside *= base ** (power // 2)
        if power % 2:
            primes.append(base)
    return outside, tuple(sorted(primes))
