from __future__ import annotations

import math

import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.readable.form import readable
from derive.errors import NotDerivable
from derive.expression import (
    Approximate,
    Call,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    cross,
    negate,
    number,
    transpose,
)
from tests.trees import (
    ANGLES,
    formula,
    fractions,
    matrix,
    points,
    polynomials,
    rewritten,
    same_value,
    sympy_of,
    value,
    with_tangents,
)

IDENTITIES = [
    ("cos(a)^2 + sin(a)^2", "1"),
    ("cos(a + b)", "cos(a) cos(b) - sin(a) sin(b)"),
    ("sin(a - b)", "sin(a) cos(b) - cos(a) sin(b)"),
    ("cos(a) cos(b)", "(cos(a - b) + cos(a + b))/2"),
    ("sin(2a)", "2 sin(a) cos(a)"),
    ("cos(3a)", "4 cos(a)^3 - 3 cos(a)"),
    ("sin(a/2)^2", "(1 - cos(a))/2"),
    ("sin(a)", "2 sin(a/4) cos(a/4) (cos(a/4)^2 - sin(a/4)^2) * 2"),
    ("tan(a)", "sin(a)/cos(a)"),
    ("tan(a + b)", "(tan(a) + tan(b))/(1 - tan(a) tan(b))"),
    ("tan(a/2)", "sin(a)/(1 + cos(a))"),
    ("tan(a/2)", "(1 - cos(a))/sin(a)"),
    ("1 + tan(a)^2", "1/cos(a)^2"),
    ("cos(a)", "(1 - tan(a/2)^2)/(1 + tan(a/2)^2)"),
    ("sin(a)", "2 tan(a/2)/(1 + tan(a/2)^2)"),
    ("cos(a + 30 deg)", "sqrt(3)/2 cos(a) - sin(a)/2"),
    ("cos(75 deg)", "(sqrt(6) - sqrt(2))/4"),
    ("sin(a + pi/2)", "cos(a)"),
    ("cos(a + b + c)", "cos(a + b) cos(c) - sin(a + b) sin(c)"),
    ("cos(a)^4 - sin(a)^4", "cos(2a)"),
    ("(1 - sin(a))/cos(a)", "cos(a)/(1 + sin(a))"),
    ("sin(a) + sin(b)", "2 sin((a + b)/2) cos((a - b)/2)"),
    ("sin(atan2(3, 4))", "3/5"),
    ("cos(atan2(y, x))", "x/sqrt(x^2 + y^2)"),
    ("sin(2 atan2(3, 4))", "24/25"),
    ("sin(a + atan2(3, 4))", "(4 sin(a) + 3 cos(a))/5"),
    ("cos(asin(3/5))", "4/5"),
    ("sin(acos(u/2))", "sqrt(4 - u^2)/2"),
    ("tan(atan(u))", "u"),
    ("sqrt(12)", "2 sqrt(3)"),
    ("1/sqrt(2)", "sqrt(2)/2"),
    ("1/(sqrt(2) + 1)", "sqrt(2) - 1"),
    ("sqrt(x^2 + 2 x y + y^2)", "abs(x + y)"),
    ("abs(-x)", "abs(x)"),
    ("abs(x)^2", "x^2"),
    ("(a^2 - b^2)/(a - b)", "a + b"),
    ("1/a + 1/b", "(a + b)/(a b)"),
    ("atan2(0, 1)", "0"),
    ("atan2(0, -1)", "pi"),
    ("x^-2", "1/x^2"),
    ("0.1 x", "x/10"),
    ("cos(omega t)^2", "1 - sin(omega t)^2"),
    ("cos(1)^2", "1 - sin(1)^2"),
    ("cos(2)", "2 cos(1)^2 - 1"),
]


@pytest.mark.parametrize(("left", "right"), IDENTITIES)
def test_what_is_equal_is_equal(left: str, right: str) -> None:
    assert same_value(formula(left), formula(right))
    assert normal(formula(left)) == normal(formula(right))


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("cos(a)", "sin(a)"), ("cos(a + b)", "cos(a) + cos(b)"), ("sin(2a)", "2 sin(a)"),
        ("sqrt(2)", "sqrt(3)"),
        ("abs(x)", "x"), ("sqrt(x^2)", "x"), ("cos(a/2)", "cos(a)/2"), ("tan(a)", "cos(a)/sin(a)"),
        ("atan2(x, y)", "atan2(y, x)"), ("cos(30 deg)", "cos(31 deg)"), ("cos(30)", "cos(30 deg)"),
        ("sqrt(a + b)", "sqrt(a) + sqrt(b)"), ("exp(a + b)", "exp(a) + exp(b)"), ("1/(a + b)", "1/a + 1/b"),
        ("cos(a)^3", "cos(3a)"), ("pi", "3.14159265358979"), ("sqrt(2)", "1.41421356237309505"),
        ("theta1", "theta2"), ("x^3", "x^2"), ("sin(a)^2", "1 + cos(a)^2"),
    ],
)  # fmt: skip
def test_what_differs_differs(left: str, right: str) -> None:
    assert normal(formula(left)) != normal(formula(right))


@given(st.data())
def test_any_rewriting_is_equal(data: st.DataObject) -> None:
    expr = data.draw(polynomials(5))
    other = data.draw(rewritten(expr))
    assert same_value(expr, other)
    assert normal(expr) == normal(other)


@given(polynomials(4))
def test_tangents_of_half_angles_are_equal(expr: Expr) -> None:
    other = with_tangents(expr)
    assert same_value(expr, other)
    assert normal(expr) == normal(other)
    assert normal(Sum((expr, number("1/1000000")))) != normal(other)


@given(polynomials(), polynomials())
def test_equality_is_equality_of_values(left: Expr, right: Expr) -> None:
    assert (normal(left) == normal(right)) == same_value(left, right)


@given(fractions(), fractions())
def test_equality_of_fractions_is_equality_of_values(left: Expr, right: Expr) -> None:
    assert (normal(left) == normal(right)) == same_value(left, right)


@given(st.one_of(polynomials(), fractions()), st.sampled_from((number("1/1000000"), ANGLES[0])))
def test_a_small_difference_is_a_difference(expr: Expr, more: Expr) -> None:
    assert normal(expr) != normal(Sum((expr, more)))


@given(st.one_of(polynomials(), fractions()))
def test_the_difference_with_itself_is_zero(expr: Expr) -> None:
    found = normal(Sum((expr, negate(expr))))
    assert found == 0
    assert not found


@given(st.one_of(polynomials(), fractions()))
def test_the_value_is_kept(expr: Expr) -> None:
    found = normal(expr)
    for at in points(expr):
        assert math.isclose(scalar_number(found, at), value(expr, at), rel_tol=1e-9, abs_tol=1e-9)


@given(polynomials())
def test_the_normal_form_is_idempotent(expr: Expr) -> None:
    once = normal(expr)
    again = normal(readable(once))
    assert again == once
    assert len(again.into(once.ring.union(again.ring)).numerator) == len(
        once.into(once.ring.union(again.ring)).numerator
    )


@given(polynomials(6), st.sampled_from(ANGLES))
def test_a_derivative_agrees_with_differences(expr: Expr, by: Symbol) -> None:
    slope, h = normal(Derivative(expr, by)), 1e-5
    for at in points(expr, by, count=2):
        ahead, behind = ({**at, by.name: at[by.name] + step} for step in (h, -h))
        differences = (value(expr, ahead) - value(expr, behind)) / (2 * h)
        assert math.isclose(scalar_number(slope, at), differences, rel_tol=1e-6, abs_tol=1e-5)


@pytest.mark.parametrize("text", ["x^3 y - 2 x/y", "sin(x)^2 cos(2x)", "x/(1 + cos(x))", "tan(x)"])
def test_a_derivative_agrees_with_sympy(text: str) -> None:
    assert_derivative(text)


@pytest.mark.parametrize(
    "text", ["sqrt(x^2 + y^2)", "cos(x y)", "sin(x^2)", "atan2(y, x)", "exp(x)", "abs(x - y)"]
)
def test_a_derivative_is_right_or_refused(text: str) -> None:
    try:
        normal(Derivative(formula(text), Symbol("x")))
    except NotDerivable:
        return
    assert_derivative(text)


def assert_derivative(text: str) -> None:
    ours = normal(Derivative(formula(text), Symbol("x")))
    theirs = sympy.diff(sympy_of(formula(text)), sympy.Symbol("x", real=True))
    for at in points(Symbol("x"), Symbol("y")):
        expected = theirs.subs({sympy.Symbol(name, real=True): number for name, number in at.items()})
        assert math.isclose(scalar_number(ours, at), float(expected), rel_tol=1e-9, abs_tol=1e-9)


def test_names_stand_for_what_they_are_given() -> None:
    names = {Symbol("L_c"): formula("L/2"), Symbol("beta"): formula("atan2(3, 4)")}
    assert normal(formula("2 L_c"), names) == normal(Symbol("L"))
    assert normal(formula("sin(beta)"), names) == normal(formula("3/5"))
    assert normal(formula("cos(a + beta)"), names) == normal(formula("(4 cos(a) - 3 sin(a))/5"))


def test_an_index_that_stands_for_nothing() -> None:
    with pytest.raises(NotDerivable):
        normal(Indexed("R", (Symbol("x"),)))


def test_a_rounded_number_has_no_normal_form() -> None:
    with pytest.raises(NotDerivable):
        normal(Approximate(0.5))


def test_a_matrix_is_no_scalar() -> None:
    with pytest.raises(NotDerivable):
        normal(matrix("a; b"))
    with pytest.raises(NotDerivable):
        normal(Sum((Symbol("a"), Call("det", (matrix("a; b\n c; d"),)), Call("sqrt", (matrix("1; 2"),)))))


def test_division_by_what_is_zero() -> None:
    with pytest.raises(ZeroDivisionError):
        normal(Quotient(number(1), formula("cos(a)^2 + sin(a)^2 - 1")))


def test_products_of_matrices() -> None:
    R = matrix("cos(a); -sin(a)\n sin(a); cos(a)")
    assert normal_matrix(Product((R, R))) == normal_matrix(matrix("cos(2a); -sin(2a)\n sin(2a); cos(2a)"))
    assert normal_matrix(Product((transpose(R), R))) == normal_matrix(matrix("1; 0\n 0; 1"))
    assert normal_matrix(Power(R, number(-1))) == normal_matrix(transpose(R))
    assert normal(Call("det", (R,))) == 1


def test_blocks_are_joined() -> None:
    column = matrix("a\n b\n c")
    whole = Matrix(((column, number(0)), (number(1), Symbol("d"))))
    assert normal_matrix(whole) == normal_matrix(matrix("a; 0\n b; 0\n c; 0\n 1; d"))


def test_a_vector_product() -> None:
    found = normal_matrix(cross(matrix("a\n b\n c"), matrix("d\n e\n f")))
    assert found == normal_matrix(matrix("b*f - c*e\n c*d - a*f\n a*e - b*d"))


def test_decimals_are_exact() -> None:
    assert normal(formula("0.1 + 0.2")) == normal(formula("0.3"))
    assert normal(Number(number("1/3").value)) != normal(formula("0.333333333333333333"))


def test_names_defined_by_names_however_many() -> None:
    names = {Symbol(f"b{k}"): formula(f"b{k - 1} + 1") for k in range(1, 900)}
    assert normal(formula("b899 b898"), names) == normal(formula("(b0 + 899) (b0 + 898)"))
    assert normal(formula("cos(b899)"), names) == normal(formula("cos(b0 + 899)"))


def test_a_name_that_rests_on_itself_is_named() -> None:
    names = {Symbol("D"): formula("C + 1"), Symbol("C"): formula("2 D")}
    with pytest.raises(NotDerivable, match=r"the sheet's own '[CD]' is also a name of this answer"):
        normal(formula("D + x"), names)
