"""Exact numbers as a person writes them: an angle of known sine and cosine as 30 deg, pi/6, psi or an atan2;
a square root as 2 where it is 2, else as the root of a short number."""

from __future__ import annotations

import math
from collections.abc import Collection
from fractions import Fraction
from itertools import product

from derive.algebra.normal import normal, trig_of
from derive.algebra.numbers.floats import number
from derive.algebra.rationals import as_fraction
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar
from derive.expression import (
    MINUS_ONE,
    PI,
    ZERO,
    Call,
    Degrees,
    Expr,
    Matrix,
    Number,
    Product,
    Symbol,
    add,
    atan2,
    column,
    free_symbols,
    multiply,
    sqrt,
    walk,
)
from derive.expression import number as exact
from derive.kinds.problem import Problem

STEP = Fraction(1, 180)  # of pi: whole degrees are recognised
LONGEST = 10**6  # a number that stands in a sentence
NEARLY = 1e-9  # rad, so that only a likely angle is compared exactly


def known_angle(expr: Expr, problem: Problem) -> Expr:
    """A sum of atan2 of numbers, each written as an angle where it is a whole number of degrees."""
    match expr:
        case Call("atan2", (y, x)):
            return _direction(y, x, problem)
        case Product((factor, Call("atan2", (y, x)))):
            angle = _direction(y, x, problem)
            return -angle if factor == MINUS_ONE else multiply(factor, angle)
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
    if names := free_symbols(y) | free_symbols(x):
        return _by_name(y, x, names, problem) or atan2(y, x)
    angle = math.atan2(number(y, {}), number(x, {}))
    turns = Fraction(round(angle / math.pi / STEP)) * STEP
    if abs(angle - math.pi * turns) > NEARLY:
        return atan2(y, x)
    c, s = trig_of(Scalar.symbol("pi") * turns)
    return fixed_angle(turns, problem) if normal(y) * c == normal(x) * s else atan2(y, x)


def _by_name(y: Expr, x: Expr, names: Collection[str], problem: Problem) -> Expr | None:
    """The angle, up to whole turns, where it is a name or its opposite and some right angles more."""
    sine, cosine = normal(y), normal(x)
    for name, sign, turns in product(names, (1, -1), (0, 2, 1, -1)):
        quarter = Fraction(turns, 2)
        if trig_of(Scalar.symbol(name) * sign + Scalar.symbol("pi") * quarter) == (cosine, sine):
            return add(Symbol(name) if sign > 0 else -Symbol(name), fixed_angle(quarter, problem))
    return None


def size(square: Scalar, problem: Problem) -> Expr:
    """The root of a number: taken where it is a number itself, else as a root of what stands below it."""
    taken = root(square)
    return problem.readable(taken) if is_plain(taken) else sqrt(problem.readable(square))


def over(part: Scalar, square: Scalar, problem: Problem) -> Expr:
    """A number divided by the root of another; its own denominator stands before the root."""
    taken = root(square)
    if is_plain(taken) or not part:
        return problem.readable(part / taken)
    below = math.lcm(*(as_fraction(each).denominator for each in part.numerator.coeffs()))
    return problem.readable(part * below) / multiply(exact(below), size(square, problem))


def along(axis: Matrix) -> Matrix:
    """A vector (n by 1) along one of numbers, in whole numbers where there are some."""
    entries = [entry for (entry,) in axis.rows]
    largest = max(entries, key=lambda entry: abs(number(entry, {})))
    found = [(normal(entry) / normal(largest)).constant for entry in entries]
    ratios = [ratio for ratio in found if ratio is not None]
    if len(ratios) < len(found):
        return axis
    sign = 1 if number(largest, {}) > 0 else -1
    whole = math.lcm(*(ratio.denominator for ratio in ratios))
    return column(exact(ratio * sign * whole) for ratio in ratios)


def shortened(expr: Expr, problem: Problem) -> Expr:
    """A number in its shortest form; a root of roots keeps its sign outside and a short number inside."""
    match expr:
        case Product((factor, Call("sqrt", (inside,)))):
            return multiply(factor, size(normal(inside), problem))
        case Call("sqrt", (inside,)):
            return size(normal(inside), problem)
    return problem.readable(normal(expr))


def is_short(value: Expr) -> bool:
    """Whether no number in it has more digits than anyone reads."""
    numbers_in = (node.value for node in walk(value) if isinstance(node, Number))
    return all(max(abs(each.numerator), each.denominator) < LONGEST for each in numbers_in)


def is_plain(value: Scalar) -> bool:
    """Whether no root stands for the root of an expression; a size |x| may be left."""
    return not any(name.startswith("sqrt((") for name in value.generators())
