"""Numbers of other programs, as a sheet writes them: simple angles in degrees, others with their digits."""

from __future__ import annotations

import math
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from typing import TypeAlias

Value: TypeAlias = Fraction | float  # exact as long as it can be

NOISE = 1e-12  # what is smaller is what an exporter's rounding left of a zero
ROUNDING = 1e-15  # of the value: what a sum or a product in floating point is off
SURE = 1e-6  # rad: nearer than this, no half degree is met by chance
EXACT = 1e-9  # an angle this near to a simple one (rad) is that one


def exact(text: str) -> Fraction:
    """The value of a decimal number. Raises ValueError for what is none, or beyond any length or mass."""
    if len(text) > 60:
        raise ValueError(text)
    try:
        value = Decimal(text)
    except InvalidOperation as error:
        raise ValueError(text) from error
    if not value.is_finite() or value.adjusted() > 30:
        raise ValueError(text)
    return Fraction(value) if value.adjusted() > -40 else Fraction(0)


def written(value: Value, unit: str = "") -> str:
    """A number with its unit; a zero has none."""
    if math.fabs(value) < NOISE:
        return "0"
    return f"{plain(value)} {unit}".rstrip()


def plain(value: Value) -> str:
    """A number as it is, without a unit; what floating point made of a short decimal is that one."""
    short = f"{float(value):.12g}"
    if math.fabs(exact(short) - value) <= ROUNDING * math.fabs(value):
        value = exact(short)
    return _decimal(value) if isinstance(value, Fraction) else repr(float(value))


def moment(value: Value) -> str:
    """An element of an inertia matrix: they may be small, and none is noise."""
    return f"{plain(value)} kg m^2" if value else "0"


def _decimal(value: Fraction) -> str:
    rest = value.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    if rest == 1:
        text = f"{Decimal(value.numerator) / Decimal(value.denominator):f}"
        if Fraction(text) == value and len(text) < 24:
            return text.rstrip("0").rstrip(".") if "." in text else text
    return repr(float(value))


def degrees_of(angle: Value, within: float = EXACT) -> Fraction | None:
    """The whole or half number of degrees that an angle (rad) is, a multiple of 5 where it may be far off;
    None where it is no such."""
    step = Fraction(1, 2) if within <= SURE else Fraction(5)
    found = round(math.degrees(float(angle)) / step) * step
    return found if abs(float(angle) - math.radians(found)) <= within else None


def written_angle(angle: Value, within: float = EXACT) -> str:
    """An angle (rad), in degrees where it is a simple one."""
    found = degrees_of(angle, within)
    if found is None:
        return written(angle, "rad")
    return f"{_decimal(found)} deg" if found else "0"


def cosine_and_sine(angle: Value, within: float = EXACT) -> tuple[Value, Value]:
    """Of an angle (rad): exact for quarters of a turn."""
    found = degrees_of(angle, within)
    if found is not None and found % 90 == 0:
        k = int(found // 90) % 4
        return Fraction((1, 0, -1, 0)[k]), Fraction((0, 1, 0, -1)[k])
    precise = float(angle) if found is None else math.radians(found)
    return math.cos(precise), math.sin(precise)
