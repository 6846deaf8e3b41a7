from __future__ import annotations

from fractions import Fraction

import pytest
import sympy

from derive.algebra.infix import text
from derive.expression import (
    MINUS_ONE,
    Approximate,
    Degrees,
    Expr,
    Matrix,
    Power,
    Product,
    Quotient,
    Sum,
    atan2,
    cos,
    negate,
    number,
    sqrt,
    squared,
    symbols,
)

a, b, c, theta1, rate = symbols("a b c theta1 theta1_dot")


@pytest.mark.parametrize(
    ("expr", "written"),
    [
        (cos(theta1), "cos(theta1)"),
        (atan2(a, b), "atan2(a, b)"),
        (Quotient(sqrt(number(3)), number(2)), "sqrt(3)/2"),
        (Product((number("1/2"), sqrt(number(3)))), "sqrt(3)/2"),
        (number("0.35", decimal=True), "7/20"),
        (Degrees(Fraction(30)), "pi/6"),
        (Degrees(Fraction(-90)), "-pi/2"),
        (Degrees(Fraction(180)), "pi"),
        (Degrees(Fraction(0)), "0"),
        (squared(rate), "theta1_dot**2"),
        (Sum((a, negate(b), negate(Product((number(2), c))))), "a - b - 2*c"),
        (Product((Sum((a, b)), c)), "(a + b)*c"),
        (Quotient(a, Product((b, c))), "a/(b*c)"),
        (Power(Product((a, b)), number(-1)), "(a*b)**(-1)"),
        (Product((MINUS_ONE, Sum((a, negate(b))))), "-(a - b)"),
        (Approximate(0.5), "0.5"),
        (Matrix(((a, b),)), "Matrix([[a, b]])"),
    ],
)
def test_a_tree_is_written_in_sympys_syntax(expr: Expr, written: str) -> None:
    assert text(expr) == written


NESTED = [
    Quotient(negate(a), Sum((a, b))),
    Quotient(a, Quotient(b, c)),
    Product((a, Quotient(b, c), Power(c, number("1/2")))),
    Power(Power(a, b), c),
    Power(negate(a), number(2)),
    Power(number(-2), number(3)),
    Power(number("1/2"), a),
    Product((a, number("-1/2"), negate(b))),
    Sum((a, Sum((b, negate(c))), negate(Sum((a, c))))),
    Product((number("-3/4"), Sum((a, b)), Quotient(a, b))),
    Product((Quotient(a, b), Degrees(Fraction(45)))),
    Power(Degrees(Fraction(45)), number(2)),
]


@pytest.mark.parametrize("expr", NESTED, ids=text)
def test_sympy_reads_the_text_as_the_same_value(expr: Expr) -> None:
    values = {"a": sympy.Rational(2, 3), "b": sympy.Rational(5, 7), "c": sympy.Rational(3, 2)}
    assert sympy.N(sympy.sympify(text(expr), locals=values) - value(expr, values)) == 0


def value(expr: Expr, values: dict[str, sympy.Expr]) -> sympy.Expr:
    """The meaning of a tree, node by node, without its text."""
    match expr:
        case Sum(terms):
            return sum((value(term, values) for term in terms), sympy.Integer(0))
        case Product(factors):
            return sympy.prod(value(factor, values) for factor in factors)
        case Quotient(top, bottom):
            return value(top, values) / value(bottom, values)
        case Power(base, exponent):
            return value(base, values) ** value(exponent, values)
        case Degrees(turn):
            return sympy.Rational(turn) * sympy.pi / 180
        case _:
            return values[text(expr)] if text(expr) in values else sympy.Rational(text(expr))
