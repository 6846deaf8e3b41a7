"""Directions of fixed angles: atan2(sin 36 deg, -cos 36 deg) is 144 deg."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.expression import (
    PI,
    Call,
    Degrees,
    Expr,
    Product,
    add,
    atan2,
    cos,
    free_symbols,
    multiply,
    sin,
    walk,
)
from derive.expression import number as exact

NEARLY = 1e-9  # rad, so that only a likely angle is compared exactly


def direction(y: Expr, x: Expr) -> Expr:
    """atan2(y, x), or the angle that it is: made of one that stands in a sine or cosine there, or a
    multiple of 15 degrees."""
    if free_symbols(y) | free_symbols(x):
        return atan2(y, x)
    value = math.atan2(number(y, {}), number(x, {}))
    twelfths = multiply(exact(Fraction(round(12 * value / math.pi), 12)), PI)
    for angle in (*_angles(y, x), twelfths):
        if abs(number(angle, {}) - value) < NEARLY:
            crossed = normal(Product((y, cos(angle)))) == normal(Product((x, sin(angle))))
            return angle if crossed else atan2(y, x)
    return atan2(y, x)


def sum_of_squares(y: Expr, x: Expr) -> Expr | None:
    """y^2 + x^2 where it is a rational number."""
    if free_symbols(y) | free_symbols(x):
        return None
    value = (normal(y) * normal(y) + normal(x) * normal(x)).constant
    return None if value is None else exact(value)


def _angles(*exprs: Expr) -> Iterator[Expr]:
    """Those that stand in sines and cosines, and what quarter turns make of them, in (-pi, pi]."""
    calls = (node for expr in exprs for node in walk(expr) if isinstance(node, Call))
    for angle in dict.fromkeys(call.arguments[0] for call in calls if call.function in ("cos", "sin")):
        for sign in (1, -1):
            for quarters in (0, 1, 2, 3):
                yield _turned(angle, sign, quarters)


def _turned(angle: Expr, sign: int, quarters: int) -> Expr:
    """sign * angle + quarters * 90 deg."""
    if isinstance(angle, Degrees):
        degrees = (sign * angle.value + 90 * quarters) % 360
        return Degrees(degrees - 360 if degrees > 180 else degrees)
    at = sign * number(angle, {}) + quarters * math.pi / 2
    whole = -2 * round((at - 1e-12) / (2 * math.pi)) + Fraction(quarters, 2)
    return add(multiply(exact(sign), angle), multiply(exact(whole), PI))
