"""Conditions as they are printed beside a branch, `a > 0 and b^2 >= c`, at a point."""

from __future__ import annotations

import re

import mpmath

from derive.audit.asked import Asked
from derive.audit.points import NEAR, Point, floating
from derive.audit.putting_back import is_real
from derive.audit.text import Unreadable

SIGN = re.compile(r"\s*(<=|>=|<|>|=)\s*")
BETWEEN = re.compile(r" and |, ")


def holds(text: str, asked: Asked, point: Point) -> bool | None:
    """Whether all conditions in a text hold; None where one of them is no relation of formulas, or not of
    real numbers at the point."""
    verdicts = [_relation(part, asked, point) for part in BETWEEN.split(text)]
    return None if None in verdicts else all(verdicts)


def _relation(text: str, asked: Asked, point: Point) -> bool | None:
    """One relation, or a chain of them: 0 <= t <= 1."""
    parts = SIGN.split(text.strip().replace("^", "**"))
    try:
        values = [point.at(asked.read(side)) for side in parts[::2]]
    except Unreadable:
        return None
    if len(values) < 2 or not all(map(is_real, values)):
        return None
    sides = [mpmath.re(floating(each)) for each in values]
    return all(map(_compared, sides, parts[1::2], sides[1:]))


def _compared(left: mpmath.mpf, sign: str, right: mpmath.mpf) -> bool:
    """Numbers that differ by what their digits leave are equal."""
    if abs(left - right) <= NEAR * max(abs(left), abs(right)):
        return "=" in sign
    return bool(left < right if "<" in sign else left > right if ">" in sign else False)
