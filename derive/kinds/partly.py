"""Results with values for some of their symbols: numbers where all have one, else trees in those left."""

from __future__ import annotations

from fractions import Fraction

from flint import fmpq_mpoly

from derive.algebra.formulas.quantities import rational
from derive.algebra.infix import text
from derive.algebra.normal import Names, normal
from derive.algebra.numbers.floats import number, scalar_number
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomials import monomials
from derive.errors import DivisionByZero, NotDerivable, NotReal
from derive.expression import (
    ZERO,
    Approximate,
    Call,
    Expr,
    Number,
    Power,
    Product,
    add,
    free_symbols,
    multiply,
    rebuild,
    replace,
)

CIRCULAR = ("cos", "sin", "tan")
ROUNDING = 1e-13  # of the size of what cancels


def put_in(expr: Expr, values: Names, style: Style) -> Expr:
    """The tree with values put in. Where only rational numbers come in it is as short as any; else every
    number is rounded, and there is one before each product of symbols.

    Raises NotReal or DivisionByZero where there is no value.
    """
    try:
        value = normal(expr, values)
    except (NotReal, DivisionByZero):
        raise
    except NotDerivable:  # a rounded number in it has no normal form
        return _replaced(expr, values)
    if all(value.ring.letters(name) for name in value.generators()):
        return _rounded(readable(value, style), style)
    top = _flat(value, value.numerator, style)
    if value.denominator is None:
        return top
    return top / _flat(value, value.denominator, style)


def _replaced(expr: Expr, values: Names) -> Expr:
    """Until nothing is left to replace: values may hold names that have values themselves."""
    for _ in range(len(values)):
        if (after := replace(expr, values)) == expr:
            break
        expr = after
    return expr


def _flat(value: Scalar, polynomial: fmpq_mpoly, style: Style) -> Expr:
    """A sum of products of symbols, each with one rounded number before it."""
    home = value.ring
    open_ones = [name for name in home.names if home.letters(name)]
    groups = {
        tuple(zip(open_ones, powers, strict=True)): numbers
        for powers, numbers in home.grouped(polynomial, open_ones).items()
    }
    terms = [_term(home.polynomial([(powers, 1)]), rest, value, style) for powers, rest in groups.items()]
    return add(*sorted(terms, key=_place))


def _term(symbols: fmpq_mpoly, numbers: fmpq_mpoly, value: Scalar, style: Style) -> Expr:
    """A product of symbols times what the numbers before it come to; zero where only rounding is left."""
    home = value.ring
    parts = [scalar_number(each, {}) for each in monomials(Scalar(home, numbers))]
    total = sum(parts)
    if abs(total) <= ROUNDING * sum(map(abs, parts)):
        return ZERO
    whole = abs(total - round(total)) <= ROUNDING * abs(total)
    before = Number(Fraction(round(total))) if whole else Approximate(total)
    return multiply(before, _rounded(readable(Scalar(home, symbols), style), style))


def _place(term: Expr) -> tuple[bool, str]:
    """Plain numbers first, then by letters."""
    letters = multiply(*term.factors[1:]) if isinstance(term, Product) else term
    return bool(free_symbols(term)), text(letters)


def _rounded(expr: Expr, style: Style) -> Expr:
    """The tree with its numbers that are not rational as decimals; angles inside sines stay as they are."""
    if not free_symbols(expr):
        return expr if rational(expr) is not None else Approximate(number(expr, {}))
    match expr:
        case Call(function) if function in CIRCULAR:
            return expr
        case Call(function, arguments):
            return Call(function, tuple(put_in(argument, {}, style) for argument in arguments))
        case Power(base, exponent) if free_symbols(exponent):
            return put_in(base, {}, style) ** put_in(exponent, {}, style)
    return rebuild(expr, lambda part: _rounded(part, style))
