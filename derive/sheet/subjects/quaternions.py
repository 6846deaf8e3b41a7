"""A quaternion as an author writes it, `{quaternion: [1, 0, 0, 1]}`, as a turn about its vector part."""

from __future__ import annotations

import math
from fractions import Fraction

from derive.algebra.formulas.quantities import rational
from derive.algebra.numbers.floats import number as value
from derive.algebra.rationals import decimal_places
from derive.expression import Degrees, Expr, Number, add, atan2, free_symbols, number, sqrt, walk

NEARLY = 1e-12


def turn_of(quaternion: tuple[Expr, Expr, Expr, Expr]) -> tuple[tuple[Expr, Expr, Expr] | None, Expr]:
    """(axis, angle): None where nothing is turned. The angle is 2 atan2(|v|, w), in degrees where it is a
    whole number of them (Siciliano et al., eqs. 2.30, 2.31); the length of the quaternion plays no part."""
    w, *vector = quaternion
    x, y, z = vector
    square = add(*(part**2 for part in vector))
    known = rational(square)
    length = sqrt(square if known is None else number(known))
    if not any(map(free_symbols, quaternion)):
        if value(length, {}) < NEARLY:
            return None, number(0)
        degrees = Fraction(round(2 * math.degrees(math.atan2(value(length, {}), value(w, {})))))
        if _is_half_of(degrees, quaternion):
            return (x, y, z), Degrees(degrees)
    return (x, y, z), 2 * atan2(length, w)


def length_of(quaternion: tuple[Expr, Expr, Expr, Expr]) -> float | None:
    """Its length, where it is a number that is not one to the digits typed."""
    if any(map(free_symbols, quaternion)):
        return None
    decimals = (
        node for part in quaternion for node in walk(part) if isinstance(node, Number) and node.decimal
    )
    places = max((decimal_places(node.value) or 0 for node in decimals), default=15)
    length = math.hypot(*(value(part, {}) for part in quaternion))
    return None if abs(length - 1) <= 2 * 10.0**-places else length


def _is_half_of(degrees: Fraction, quaternion: tuple[Expr, Expr, Expr, Expr]) -> bool:
    """Whether w is exactly the cosine of half this angle."""
    from derive.algebra.normal import normal  # heavy, and seldom needed
    from derive.expression import cos

    w = normal(quaternion[0])
    whole = normal(add(*(part**2 for part in quaternion)))
    half = normal(cos(Degrees(degrees) / 2))
    return (
        w * w == half * half * whole and value(quaternion[0], {}) * math.cos(math.radians(degrees / 2)) >= 0
    )
