"""Exact random points, and the value of a SymPy expression at one.

A name stands for a rational number; an angle is given by a rational t = tan(theta/2), so that its cosine and
sine are rational too. As long as nothing irrational is met everything is a `Fraction`, and equal means equal.
What is irrational (`Irrational` is raised) sends the engine to the same point in numbers of 60 digits.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from hashlib import sha256
from math import isqrt
from typing import TypeAlias

import mpmath
import sympy

from derive.audit.budget import spend

Number: TypeAlias = "Fraction | mpmath.mpf | mpmath.mpc"
Value: TypeAlias = "Number | Sequence[Value]"

DIGITS = 60
NEAR = mpmath.mpf(10) ** -35  # of numbers with 60 digits
LEAST = mpmath.mpf(10) ** -12  # numbers smaller than this are compared as if they were as large
ROUNDED = mpmath.mpf(10) ** -9  # where one of them is a float


class Irrational(Exception):
    """A number that no fraction is."""


class Point:
    """A place drawn by its seed: each name has its value there, whoever asks and in whatever order.

    `angles` are the names whose sine and cosine are rational, `fixed` those whose value is given, and
    `assumptions` say which are positive or whole. Not `exact`: everything is a number of 60 digits.
    """

    def __init__(
        self,
        seed: int,
        exact: bool = True,
        angles: Collection[str] = (),
        assumptions: Mapping[str, str] | None = None,
        fixed: Mapping[str, sympy.Expr | Number] | None = None,
    ) -> None:
        self.seed, self.exact = seed, exact
        self.angles, self.assumptions, self.fixed = frozenset(angles), assumptions or {}, fixed or {}
        self._known: dict[sympy.Expr, Number] = {}

    def where(self, **fixed: sympy.Expr | Number) -> Point:
        """The same point with the values of some names given."""
        return Point(self.seed, self.exact, self.angles, self.assumptions, {**self.fixed, **fixed})

    def in_digits(self) -> Point:
        """The same point in numbers of 60 digits."""
        return Point(self.seed, False, self.angles, self.assumptions, self.fixed)

    def __getitem__(self, name: str) -> Number:
        """The value of a name."""
        return self.at(sympy.Symbol(name))

    def number(self, value: Fraction | int) -> Number:
        """A rational number as this point has its numbers."""
        return Fraction(value) if self.exact else mpmath.mpf(value.numerator) / value.denominator

    def at(self, expr: sympy.Expr) -> Number:
        """The value of an expression. Raises Irrational, ZeroDivisionError, Exhausted."""
        if expr not in self._known:
            spend(1)
            self._known[expr] = self._value(expr)
        return self._known[expr]

    def vector(self, exprs: Sequence[sympy.Expr]) -> list[Number]:
        """The values of a list of expressions."""
        return [self.at(expr) for expr in exprs]

    def matrix(self, rows: Sequence[Sequence[sympy.Expr]]) -> list[list[Number]]:
        """The values of rows of expressions."""
        return [self.vector(row) for row in rows]

    def each(self, exprs: object) -> Value:
        """The values of nested lists (or a SymPy matrix) of expressions."""
        if isinstance(exprs, sympy.MatrixBase):
            return [[self.at(entry) for entry in row] for row in exprs.tolist()]
        if isinstance(exprs, list | tuple):
            return [self.each(part) for part in exprs]
        return self.at(exprs)

    def turn(self, angle: sympy.Expr) -> tuple[Number, Number]:
        """Cosine and sine of an angle: rational for whole multiples of angles and of a right angle."""
        if not self.exact:
            value = self.at(angle)
            return mpmath.cos(value), mpmath.sin(value)
        c, s = Fraction(1), Fraction(0)
        for part, times in angle.as_coefficients_dict().items():
            if not times.is_Rational:
                raise Irrational
            c1, s1 = self._whole_turn(part, Fraction(int(times.p), int(times.q)))
            c, s = c * c1 - s * s1, s * c1 + c * s1
        return c, s

    def _whole_turn(self, part: sympy.Expr, times: Fraction) -> tuple[Fraction, Fraction]:
        if part == sympy.pi:
            times, c, s = 2 * times, Fraction(0), Fraction(1)
        elif part.is_Symbol and part.name in self.fixed:
            c, s = self.turn(self.fixed[part.name])
        elif part.is_Symbol and part.name in self.angles:
            t = self._drawn(part.name)
            c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        elif isinstance(part, sympy.atan2):
            y, x = (self.at(argument) for argument in part.args)
            c, s = x / _root(x * x + y * y), y / _root(x * x + y * y)
        else:
            raise Irrational
        if times.denominator != 1:
            raise Irrational
        if times < 0:
            s = -s
        turned = Fraction(1), Fraction(0)
        for _ in range(abs(times.numerator)):
            turned = turned[0] * c - turned[1] * s, turned[1] * c + turned[0] * s
        return turned

    def seed_of(self, name: str) -> int:
        """What the value of a name is drawn by."""
        return self.seed

    def _drawn(self, name: str) -> Fraction:
        """A rational number for a name, the same whenever it is asked for."""
        digest = sha256(f"{self.seed_of(name)}:{name}".encode()).digest()
        top, bottom = 2 + int.from_bytes(digest[:4], "big") % 41, 1 + int.from_bytes(digest[4:8], "big") % 23
        known = self.assumptions.get(name, "")
        negative = digest[8] % 2 and known not in ("positive", "nonnegative")
        top += top == bottom  # a half-angle tangent of 1 is a right angle
        value = Fraction(top) if known == "integer" else Fraction(top, bottom)
        return -value if negative else value

    def _value(self, expr: sympy.Expr) -> Number:
        if expr.is_Rational:
            return self.number(Fraction(int(expr.p), int(expr.q)))
        if expr.is_Symbol:
            return self._named(expr.name)
        if expr.is_Add:
            return sum((self.at(term) for term in expr.args), self.number(0))
        if expr.is_Mul:
            product = self.number(1)
            for factor in expr.args:
                product = product * self.at(factor)
            return product
        if expr.is_Pow:
            return self._power(expr.base, expr.exp)
        if isinstance(expr, sympy.cos | sympy.sin | sympy.tan):
            c, s = self.turn(expr.args[0])
            return c if isinstance(expr, sympy.cos) else s if isinstance(expr, sympy.sin) else s / c
        if isinstance(expr, sympy.Abs):
            return abs(self.at(expr.args[0]))
        if isinstance(expr, sympy.sign):
            value = self.at(expr.args[0])
            return self.number((value > 0) - (value < 0))
        if isinstance(expr, sympy.Max | sympy.Min):
            return (max if isinstance(expr, sympy.Max) else min)(map(self.at, expr.args))
        return self._irrational(expr)

    def _named(self, name: str) -> Number:
        if name in self.fixed:
            known = self.fixed[name]
            return self.at(known) if isinstance(known, sympy.Basic) else known
        if name not in self.angles:
            return self.number(self._drawn(name))
        if self.exact:
            raise Irrational
        return 2 * mpmath.atan(self.number(self._drawn(name)))

    def _power(self, base: sympy.Expr, exponent: sympy.Expr) -> Number:
        if exponent.is_Integer:
            spend(abs(int(exponent)))
            return self.at(base) ** int(exponent)
        value = self.at(base)
        if exponent.is_Rational and exponent.q == 2:
            return _root(value) ** int(exponent.p)
        if self.exact:
            raise Irrational
        return mpmath.power(value, self.at(exponent))

    def _irrational(self, expr: sympy.Expr) -> Number:
        """Functions whose values no fraction is. Raises Irrational in exact numbers, TypeError for what is no
        number at all."""
        if expr in (sympy.nan, sympy.zoo):
            raise ZeroDivisionError
        if self.exact:
            raise Irrational
        if expr is sympy.I:
            return mpmath.mpc(0, 1)
        if expr.is_Float or expr.is_NumberSymbol:
            return mpmath.mpf(
                getattr(sympy.N(expr, mpmath.mp.dps), "_mpf_", 0)
            )  # a float that is zero has none
        function = getattr(mpmath, type(expr).__name__, None)
        if function is None:
            raise TypeError(f"no value is known of {type(expr).__name__}")
        arguments = self.vector(expr.args)
        if isinstance(expr, sympy.atan2) and any(isinstance(part, mpmath.mpc) for part in arguments):
            raise ValueError("the direction of a point that is not real")
        return function(*arguments)


def _root(value: Number) -> Number:
    """A square root: of a fraction exact, or Irrational."""
    if not isinstance(value, Fraction):
        return mpmath.sqrt(value)
    top, bottom = isqrt(abs(value.numerator)), isqrt(value.denominator)
    if value < 0 or top * top != value.numerator or bottom * bottom != value.denominator:
        raise Irrational
    return Fraction(top, bottom)


def agree(ours: Number, theirs: Number, scale: Number = 1, near: mpmath.mpf = NEAR) -> bool:
    """Whether two numbers are one: fractions must be equal, others agree to `near` times the `scale` of the
    numbers beside them."""
    if isinstance(ours, Fraction | int) and isinstance(theirs, Fraction | int):
        return ours == theirs
    size = max(abs(floating(scale)), abs(floating(theirs)), LEAST)
    return bool(abs(floating(ours) - floating(theirs)) <= near * size)


def floating(value: Number) -> mpmath.mpf:
    """The number with 60 digits, a complex one as it is."""
    return (
        mpmath.mpf(value.numerator) / value.denominator
        if isinstance(value, Fraction)
        else mpmath.mpmathify(value)
    )


def shown(value: Value) -> str:
    """Ten digits of numbers, to be told."""
    if isinstance(value, list):
        return "[" + ", ".join(map(shown, value)) + "]"
    return str(mpmath.nstr(floating(value), 10))
