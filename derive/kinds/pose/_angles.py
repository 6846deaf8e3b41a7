"""Angles of known sine and cosine as a person writes them: 30 deg, pi/6, or atan2 of exact numbers."""

from __future__ import annotations

import math
from fractions import Fraction

from derive.algebra.normal import normal, trig_of
from derive.algebra.numbers.floats import number
from derive.algebra.scalar import Scalar
from derive.expression import PI, ZERO, Call, Degrees, Expr, Product, atan2, multiply
from derive.expression import number as exact
from derive.kinds.problem import Problem

STEP = Fraction(1, 180)  # of pi: whole degrees are recognised
NEARLY = 1e-9  # rad, so that only a likely angle is compared exactly


def known_angle(expr: Expr, problem: Problem) -> Expr:
    """A sum of atan2 of numbers, each written as an angle where it is a whole number of degrees."""
    match expr:
        case Call("atan2", (y, x)):
            return _direction(y, x, problem)
        case Product((factor, Call("atan2", (y, x)))):
            return multiply(factor, _direction(y, x, problem))
    return expr


def fixed_angle(turns: Fraction, problem: Problem) -> Expr:
    """`turns * pi`, in degrees where the author writes degrees."""
    if not turns:
        return ZERO
    if problem.style.degrees:
        return Degrees(180 * turns)
    return multiply(exact(turns), PI)


def turns_of(angle: Expr) -> Fraction:
    """The multiple of pi of a fixed angle."""
    return Fraction(round(number(angle, {}) / math.pi / STEP)) * STEP


def _direction(y: Expr, x: Expr, problem: Problem) -> Expr:
    angle = math.atan2(number(y, {}), number(x, {}))
    turns = Fraction(round(angle / math.pi / STEP)) * STEP
    if abs(angle - math.pi * turns) > NEARLY:
        return atan2(y, x)
    c, s = trig_of(Scalar.symbol("pi") * turns)
    return fixed_angle(turns, problem) if normal(y) * c == normal(x) * s else atan2(y, x)
