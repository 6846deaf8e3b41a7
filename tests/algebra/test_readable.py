from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from hypothesis import given

from derive.algebra.infix import text
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.readable.form import readable, readable_matrix
from derive.algebra.readable.operation_count import operations
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.expression import Degrees, Expr, Sum, multiply, number, walk
from tests.trees import formula, fractions, matrix, polynomials, same_value, sympy_letters


@given(polynomials())
def test_the_readable_form_normalises_back(expr: Expr) -> None:
    found = normal(expr)
    assert normal(readable(found)) == found


@given(polynomials(5))
def test_the_readable_form_has_the_value(expr: Expr) -> None:
    assert same_value(readable(normal(expr)), expr)


def test_an_angle_with_a_leading_minus() -> None:
    found = normal(formula("cos(-y) sin(x - y) sin(-y) + cos(x + y)^2 cos(-y)"))
    assert normal(readable(found)) == found


@given(fractions())
def test_a_readable_fraction_normalises_back(expr: Expr) -> None:
    found = normal(expr)
    assert normal(readable(found)) == found


@given(polynomials())
def test_decimals_change_the_writing_and_not_the_value(expr: Expr) -> None:
    found = normal(expr)
    assert normal(readable(found, Style(decimals=True, degrees=True))) == found


@given(polynomials(6))
def test_it_is_not_much_longer_than_the_expanded_normal_form(expr: Expr) -> None:
    found = normal(expr)
    expanded = Sum(tuple(readable(term) for term in _monomials(found)))
    if len(expanded.terms) > 1:
        assert operations(readable(found)) <= 2 * operations(expanded) + 1


def _monomials(found: Scalar) -> list[Scalar]:
    home = found.ring
    terms = found.numerator.to_dict().items()
    return [Scalar(home, home.context.from_dict({powers: number})) for powers, number in terms]


@pytest.mark.parametrize(
    ("typed", "printed"),
    [
        ("cos(x) cos(y) - sin(x) sin(y)", "cos(x + y)"),
        ("sin(x) cos(y) + cos(x) sin(y)", "sin(x + y)"),
        ("cos(x) cos(y) + sin(x) sin(y)", "cos(x - y)"),
        ("a - a cos(x)^2", "a*sin(x)**2"),
        ("x^2 + 2 x y + y^2", "(x + y)**2"),
        ("a m + b m", "m*(a + b)"),
        ("cos(x)^2 + sin(x)^2", "1"),
        ("x - x", "0"),
        ("-x", "-x"),
        ("-(a + b)", "-a - b"),
        ("b - a", "b - a"),
        ("a cos(x) cos(y) - a sin(x) sin(y) + b cos(x)", "b*cos(x) + a*cos(x + y)"),
        ("x/2", "x/2"),
        ("sqrt(3)/2", "sqrt(3)/2"),
        ("cos(45 deg) x", "sqrt(2)*x/2"),
        ("a/(b + c)", "a/(b + c)"),
        ("(a^2 - b^2)/(a + b)", "a - b"),
    ],
)
def test_what_a_person_would_write(typed: str, printed: str) -> None:
    assert normal(readable(normal(formula(typed)))) == normal(formula(typed))
    assert text(readable(normal(formula(typed)))) == printed


def test_decimals_come_back_where_they_were_typed() -> None:
    found = readable(normal(formula("0.1 cos(x)")), Style(decimals=True))
    assert found == multiply(number("0.1", decimal=True), formula("cos(x)"))
    assert text(readable(normal(formula("cos(x)/3")), Style(decimals=True))) == "cos(x)/3"


def test_the_order_of_the_author() -> None:
    found = normal(formula("cos(b) cos(a) - sin(a) sin(b)"))
    assert text(readable(found, Style(order=("b", "a")))) == "cos(b + a)"
    assert text(readable(found, Style(order=("a", "b")))) == "cos(a + b)"


def test_a_matrix_is_written_entry_by_entry() -> None:
    R = matrix("cos(x); -sin(x)\n sin(x); cos(x)")
    assert readable_matrix(normal_matrix(R)) == R


COUNTED = [
    "a", "a + b", "a - b", "a b", "a b + c", "a/b", "a^2", "2 a", "a/2", "cos(x)", "cos(x + y)",
    "a cos(x + y) + b sin(x)", "a (b + c (d - cos(x)))", "m (L^2 + 2 L_c^2)", "sin(x)^2", "-a - b",
    "a/(b + c)", "3/4", "2 a/3",
]  # fmt: skip


@pytest.mark.parametrize("typed", COUNTED)
def test_operations_are_counted_as_sympy_counts_them(typed: str) -> None:
    assert operations(formula(typed)) == sympy.count_ops(sympy_letters(formula(typed)), visual=False)


def test_angles_in_degrees() -> None:
    written = readable(normal(formula("cos(x + 10 deg)")), Style(degrees=True))
    assert any(node == Degrees(Fraction(10)) for node in walk(written))
    assert normal(written) == normal(formula("cos(x + 10 deg)"))
