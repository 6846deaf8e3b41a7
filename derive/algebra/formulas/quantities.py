"""Trees in the making, each with what is known of its dimension and of its size.

The limits guard against formulas that are short to type and endless to expand, as (a + b + c)^99^9.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from math import comb, log10

from derive.algebra.fold import Domain, fold
from derive.algebra.formulas.functions import INVERSE, TRIGONOMETRIC
from derive.algebra.formulas.undefined import always_zero, negative, undefined
from derive.algebra.formulas.units import ANGLE, PLAIN, Dimension, Unit, agree, power, spoken, times
from derive.algebra.rationals import decimal_places
from derive.errors import NotDerivable, Unfit
from derive.expression import (
    PI,
    Call,
    Degrees,
    Expr,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    is_negative,
    negate,
    terms_of,
    walk,
)

MAX_POWER = 64
MAX_TERMS = 20_000  # of the formula multiplied out
MAX_DEPTH = 60  # of the tree
FLAT = (Sum, Product)


@dataclass(frozen=True, slots=True)
class Quantity:
    """A tree; `dimension` is None where it depends on symbols, `numeric` where there are none.

    `terms` bounds the number of terms of the formula multiplied out, `depth` is that of the tree.
    """

    expr: Expr
    dimension: Dimension | None = PLAIN
    numeric: bool = True
    terms: int = 1
    depth: int = 1


def summed(left: Quantity, right: Quantity, at: int) -> Quantity:
    """left + right. Raises FormulaError where a length would be added to an angle."""
    if left.dimension and right.dimension and not agree(left.dimension, right.dimension):
        message = f"{spoken(left.dimension)} and {spoken(right.dimension)} cannot be added"
        raise Unfit(message, at, "check the units on both sides of this sign")
    known = [dimension for dimension in (left.dimension, right.dimension) if dimension not in (None, PLAIN)]
    unclear = None if None in (left.dimension, right.dimension) else PLAIN
    expr = Sum(terms_of(left.expr) + terms_of(right.expr))
    return _joined(expr, known[0] if known else unclear, left, right, left.terms + right.terms, at)


def multiplied(left: Quantity, right: Quantity, at: int) -> Quantity:
    """left * right, a product of products written as one. Raises FormulaError where it is too large."""
    first = left.expr.factors if isinstance(left.expr, Product) else (left.expr,)
    dimension = _combined(left.dimension, right.dimension, 1)
    return _joined(
        Product(first + _factors(right.expr)), dimension, left, right, left.terms * right.terms, at
    )


def divided(left: Quantity, right: Quantity, at: int) -> Quantity:
    """left / right. Raises FormulaError for a division by zero."""
    if rational(right.expr) == 0:
        raise Unfit("a division by zero", at)
    if isinstance(right.expr, Sum) and always_zero(right.expr):
        raise Unfit("a division by an expression that is always zero", at, "check its signs")
    dimension = _combined(left.dimension, right.dimension, -1)
    return _joined(Quotient(left.expr, right.expr), dimension, left, right, left.terms * right.terms, at)


def raised(base: Quantity, exponent: Quantity, at: int) -> Quantity:
    """base ^ exponent. Raises FormulaError for exponents that are quantities, or far too large."""
    if exponent.dimension not in (None, PLAIN):
        raise Unfit("an exponent is a plain number", at)
    value = rational(exponent.expr)
    if value is not None and abs(value) > MAX_POWER:
        raise Unfit(f"the exponent is too large (at most {MAX_POWER})", at, "use a smaller exponent")
    if value is not None and value < 0 and rational(base.expr) == 0:
        raise Unfit("a division by zero", at)
    size = max(1, int(abs(value))) if value is not None else 1
    terms = comb(base.terms + size - 1, size)
    dimension = _raised_dimension(base.dimension, value)
    if base.numeric and not exponent.numeric and negative(base.expr):
        raise Unfit("a negative number to the power of a symbol is not real", at)
    found = _joined(Power(base.expr, exponent.expr), dimension, base, exponent, terms, at)
    return _defined(found, at)


def negated(quantity: Quantity) -> Quantity:
    """The opposite."""
    depth = quantity.depth + 1
    return Quantity(negate(quantity.expr), quantity.dimension, quantity.numeric, quantity.terms, depth)


def called(function: str, arguments: tuple[Quantity, ...], at: int) -> Quantity:
    """function(arguments). Raises FormulaError where an argument has an impossible dimension or no value is
    real."""
    if function in TRIGONOMETRIC and not agree(arguments[0].dimension or PLAIN, ANGLE):
        raise Unfit(f"{function} of {spoken(arguments[0].dimension or PLAIN)}", at, "an angle is wanted")
    if function == "atan2" and not agree(*(argument.dimension or PLAIN for argument in arguments)):
        raise Unfit("atan2 of two quantities of different units", at)
    expr = Call(function, tuple(argument.expr for argument in arguments))
    dimension = _call_dimension(function, arguments[0].dimension)
    return _defined(_joined(expr, dimension, arguments[0], arguments[-1], 1, at), at)


def _defined(quantity: Quantity, at: int) -> Quantity:
    """The quantity. Raises FormulaError where it is no real number."""
    if quantity.numeric and (reason := undefined(quantity.expr)):
        raise Unfit(reason, at)
    return quantity


def measured(quantity: Quantity, unit: Unit, at: int) -> Quantity:
    """A number with its unit: the last factor, if it is rational, takes the size of the unit."""
    before, last = _split(quantity.expr)
    value = rational(last)
    if value is None or (unit.size == 1 and not unit.degrees):
        factors = (*before, last, *_scale(unit))
    elif unit.degrees == 1:
        places = last.places if isinstance(last, Number) and unit.size == 1 else 0
        factors = (*before, Degrees(value * unit.size, places, unit=unit.name))
    else:
        factors = (
            *before,
            _converted(value * unit.size / Fraction(180) ** unit.degrees, last),
            *_turns(unit.degrees),
        )
    expr = factors[0] if len(factors) == 1 else Product(factors)
    if isinstance(expr, Number) and unit.dimension != ANGLE:
        expr = replace(expr, unit=unit.name)
    dimension = _combined(quantity.dimension, unit.dimension, 1)
    return _joined(expr, dimension, quantity, quantity, quantity.terms, at)


def ends_in_number(quantity: Quantity) -> bool:
    """Whether a unit may follow: it, or its last factor, is made of numbers alone."""
    return quantity.numeric or rational(_split(quantity.expr)[1]) is not None


class _Rationals(Domain[Fraction]):
    """Rational numbers, whose powers are no longer than a formula may be."""

    def number(self, value: Fraction) -> Fraction:
        return value

    def quotient(self, top: Fraction, bottom: Fraction) -> Fraction:
        return top / bottom if bottom else self.refuse("a division by zero")

    def power(self, base: Fraction, exponent: Fraction) -> Fraction:
        whole = exponent.denominator == 1 and abs(exponent) <= MAX_POWER
        return base ** int(exponent) if whole and (base or exponent > 0) else self.refuse("this power")

    def call(self, function: str, arguments: list[Fraction]) -> Fraction:
        match function:
            case "abs":
                return abs(arguments[0])
            case "max":
                return max(arguments)
            case "sign":
                return Fraction((arguments[0] > 0) - (arguments[0] < 0))
        return self.refuse(function)


def rational(expr: Expr) -> Fraction | None:
    """The value of a tree of rational numbers, None for any other."""
    try:
        return fold(expr, _Rationals())
    except NotDerivable:
        return None


def _joined(
    expr: Expr, dimension: Dimension | None, left: Quantity, right: Quantity, terms: int, at: int
) -> Quantity:
    depth = max(left.depth, right.depth) + 1
    if isinstance(expr, FLAT):  # a flat chain of signs is no deeper than its parts
        depth = max(left.depth, right.depth + 1)
    if depth > MAX_DEPTH:
        raise Unfit("the formula is nested too deeply", at, "give a part of it a name under 'where'")
    if terms > MAX_TERMS:
        raise Unfit("the formula is too large multiplied out", at, "give a part of it a name under 'where'")
    return Quantity(expr, dimension, left.numeric and right.numeric, terms, depth)


def _factors(expr: Expr) -> tuple[Expr, ...]:
    """The factors that may join a product on its right: a signed product stays one, for its sign."""
    return expr.factors if isinstance(expr, Product) and not is_negative(expr) else (expr,)


def _split(expr: Expr) -> tuple[tuple[Expr, ...], Expr]:
    """The factors before the last one, and the last."""
    if isinstance(expr, Product):
        return expr.factors[:-1], expr.factors[-1]
    return (), expr


def _converted(value: Fraction, typed: Expr) -> Number:
    """A number in SI units; where a conversion made it a fraction, a decimal if it ends: 100 mm is 0.1."""
    ends = value.denominator > 1 and decimal_places(value) is not None
    return Number(value, _is_decimal(typed) or ends, places=_places(value, typed))


def _places(value: Fraction, typed: Expr) -> int:
    """Those of a typed decimal after a conversion by a power of ten: 12.50 mm has five as a length in m."""
    if not isinstance(typed, Number) or not typed.places or not value:
        return 0
    shift = round(log10(typed.value / value))
    return max(typed.places + shift, 0) if typed.value == value * Fraction(10) ** shift else 0


def _is_decimal(expr: Expr) -> bool:
    return any(isinstance(node, Number) and node.decimal for node in walk(expr))


def _scale(unit: Unit) -> tuple[Expr, ...]:
    size = unit.size / Fraction(180) ** unit.degrees
    return (*((Number(size),) if size != 1 else ()), *_turns(unit.degrees))


def _turns(degrees: int) -> tuple[Expr, ...]:
    if not degrees:
        return ()
    return (PI,) if degrees == 1 else (Power(PI, Number(Fraction(degrees))),)


def _combined(left: Dimension | None, right: Dimension | None, sign: int) -> Dimension | None:
    return times(left, power(right, sign)) if left is not None and right is not None else None


def _raised_dimension(base: Dimension | None, exponent: Fraction | None) -> Dimension | None:
    if base is None or base == PLAIN:
        return base
    return power(base, int(exponent)) if exponent is not None and exponent.denominator == 1 else None


def _call_dimension(function: str, argument: Dimension | None) -> Dimension | None:
    if function in INVERSE:
        return ANGLE
    if function == "abs":
        return argument
    if function == "sqrt" and argument is not None:
        half = power(argument, 1)
        m, kg, s, a, rad = (exponent // 2 for exponent in half)
        return (m, kg, s, a, rad) if all(exponent % 2 == 0 for exponent in half) else None
    return None if function == "sqrt" else PLAIN
