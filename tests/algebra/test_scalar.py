from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from derive.algebra.angles import Form
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.scalar import Scalar, common_ring, trig
from derive.expression import Expr
from tests.trees import formula, fractions, points, polynomials

scalars = st.one_of(polynomials(5), fractions()).map(normal)
rationals = st.fractions(min_value=-9, max_value=9, max_denominator=12)


def scalar(text: str) -> Scalar:
    return normal(formula(text))


@given(rationals, rationals)
def test_numbers_are_those_of_python(p: Fraction, q: Fraction) -> None:
    a, b = Scalar.of(p), Scalar.of(q)
    assert (a + b).constant == p + q
    assert (a - b).constant == p - q
    assert (a * b).constant == p * q
    assert (a**3).constant == p**3
    if q:
        assert (a / b).constant == p / q


@given(scalars, scalars, scalars)
def test_the_laws_of_a_field(a: Scalar, b: Scalar, c: Scalar) -> None:
    assert a + b == b + a
    assert (a + b) + c == a + (b + c)
    assert a * b == b * a
    assert (a * b) * c == a * (b * c)
    assert a * (b + c) == a * b + a * c
    assert a - a == 0
    assert a + 0 == a * 1 == a
    if a:
        assert a / a == 1
        assert b / a * a == b


@given(scalars, st.integers(0, 4))
def test_powers_are_repeated_products(a: Scalar, n: int) -> None:
    assert a**n == math.prod([a] * n, start=Scalar.of(1))


def test_negative_powers() -> None:
    a = scalar("2 + cos(x)")
    assert a**-2 * a * a == 1
    with pytest.raises(ZeroDivisionError):
        (a - a) ** -1


@given(polynomials(5), polynomials(5))
def test_sums_and_products_have_their_values(left: Expr, right: Expr) -> None:
    a, b = normal(left), normal(right)
    for at in points(left, right):
        p, q = scalar_number(a, at), scalar_number(b, at)
        assert math.isclose(scalar_number(a + b, at), p + q, rel_tol=1e-9, abs_tol=1e-9)
        assert math.isclose(scalar_number(a * b, at), p * q, rel_tol=1e-9, abs_tol=1e-9)


@given(scalars, scalars)
def test_the_rules_of_differentiation(a: Scalar, b: Scalar) -> None:
    assert (a + b).diff("x") == a.diff("x") + b.diff("x")
    assert (a * b).diff("x") == a.diff("x") * b + a * b.diff("x")
    if b:
        assert (a / b).diff("x") == (a.diff("x") * b - a * b.diff("x")) / (b * b)


@pytest.mark.parametrize(
    ("text", "by", "slope"),
    [
        ("cos(x)", "x", "-sin(x)"),
        ("sin(2x + y)", "x", "2 cos(2x + y)"),
        ("sin(x + y)", "y", "cos(x + y)"),
        ("tan(x)", "x", "1 + tan(x)^2"),
        ("a^3 b", "a", "3 a^2 b"),
        ("1/a", "a", "-1/a^2"),
        ("cos(x) a", "b", "0"),
    ],
)
def test_derivatives(text: str, by: str, slope: str) -> None:
    assert scalar(text).diff(by) == scalar(slope)


def test_scalars_of_different_rings_mix() -> None:
    assert scalar("cos(x + y)") + scalar("sin(x)") * scalar("sin(y)") == scalar("cos(x) cos(y)")
    assert scalar("cos(x)") == 1 - 2 * scalar("sin(x/2)") ** 2
    assert 1 - scalar("a") == -(scalar("a") - 1)
    assert 1 / scalar("a") * scalar("a") == 1


def test_comparison() -> None:
    assert scalar("a") != "a"
    assert scalar("3/4") == Fraction(3, 4)
    assert not scalar("a - a")
    with pytest.raises(TypeError):
        hash(scalar("a"))


def test_a_fraction_is_reduced() -> None:
    assert scalar("(a^2 - b^2)/(a + b)").denominator is None
    assert scalar("(2 a)/(4 b)").denominator is not None
    assert scalar("a/b").constant is None


@given(polynomials(5))
def test_substitution_replaces_symbols(expr: Expr) -> None:
    found = normal(expr).substitute({"a": scalar("cos(x) + 1"), "b": scalar("L_c/2")})
    for at in points(expr, formula("x + L_c + a + b")):
        known = {**at, "a": math.cos(at["x"]) + 1, "b": at["L_c"] / 2}
        expected = scalar_number(normal(expr), known)
        assert math.isclose(scalar_number(found, at), expected, rel_tol=1e-9, abs_tol=1e-9)


def test_the_cosine_and_sine_of_a_form() -> None:
    c, s = trig(Form.of({"x": 1, "y": Fraction(1, 2)}))
    assert c == scalar("cos(x + y/2)")
    assert s == scalar("sin(x + y/2)")


def test_the_common_ring_holds_all() -> None:
    parts = [scalar("cos(x)"), scalar("sqrt(2) a"), scalar("b")]
    home = common_ring(parts)
    assert all(part.into(home) == part for part in parts)


def test_generators_are_those_that_occur() -> None:
    assert set((scalar("a cos(x) + b") - scalar("b")).generators()) == {"a", "cos(x)"}
