"""Evaluated angles on the page: in degrees, or in radians with multiples of a right angle as such."""

from __future__ import annotations

import math
from fractions import Fraction

from derive.expression import PI, Approximate, Expr, multiply, number
from derive.render.latex import Printer, parenthesised
from derive.render.layout import Link
from derive.render.numbers import rounded_latex

WHOLE_WITHIN = 1e-7  # degrees
EXACT = 1e-12  # radians


def in_degrees(angle: float, digits: int) -> Link:
    """An angle in radians, written in degrees; whole ones exactly."""
    value = math.degrees(angle)
    whole = round(value)
    if abs(value - whole) < WHOLE_WITHIN:
        return Link("=", rf"{whole}^\circ" if whole else "0")
    written = rounded_latex(value, digits)
    return Link(r"\approx", rf"{parenthesised(written) if '^' in written else written}^\circ")


def in_radians(angle: float, printer: Printer) -> Link:
    """Written in radians; a multiple of a right angle by pi."""
    quarters = round(2 * angle / math.pi)
    if abs(angle - quarters * math.pi / 2) < EXACT:
        exact: Expr = multiply(number(Fraction(quarters, 2)), PI)
        return Link("=", printer.write(exact))
    return Link(r"\approx", printer.write(Approximate(angle)))
