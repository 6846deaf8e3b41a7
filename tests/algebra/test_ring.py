from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from derive.algebra.angles import Form, combination
from derive.algebra.exact_values import square_root
from derive.algebra.generators import PI
from derive.algebra.normal import normal
from derive.algebra.ring import ring
from derive.algebra.scalar import Scalar
from derive.expression import Expr
from tests.trees import formula, polynomials

X, Y = Form.of({"x": 1}), Form.of({"y": 1})


def test_rings_of_the_same_generators_are_the_same() -> None:
    assert ring(angles=(X, Y), symbols=("a",)) is ring(angles=(X, Y), symbols=("a",))
    assert ring(angles=(X,)) != ring(angles=(Y,))


def test_the_relation_of_an_angle() -> None:
    home = ring(angles=(X,))
    c, s = home.pair(0)
    assert home.reduce(s * s) == 1 - c * c
    assert home.reduce(s**5) == home.reduce(s * (1 - c * c) ** 2)
    assert home.reduce(s * s + c * c) == home.one


def test_the_relation_of_a_root() -> None:
    two = square_root(Fraction(2))
    (gen,) = (two.ring.gen(name) for name in two.ring.names)
    assert two.ring.reduce(gen**3) == 2 * gen


@given(polynomials(6))
def test_reduction_is_idempotent(expr: Expr) -> None:
    found = normal(expr)
    assert found.ring.reduce(found.numerator) == found.numerator


@given(polynomials(6))
def test_a_reduced_polynomial_has_no_square_of_a_sine(expr: Expr) -> None:
    found = normal(expr)
    degrees = dict(zip(found.ring.names, found.numerator.degrees(), strict=True))
    assert all(degree <= 1 for name, degree in degrees.items() if name.startswith(("sin(", "sqrt(")))


@given(polynomials(5), polynomials(5))
def test_a_scalar_carried_into_a_union_and_compared_is_itself(left: Expr, right: Expr) -> None:
    a, b = normal(left), normal(right)
    home = a.ring.union(b.ring)
    assert a.into(home) == a
    assert b.into(home) == b


def test_a_half_angle_refines_the_ring() -> None:
    home = ring(angles=(X,)).with_angle(X.scaled(Fraction(1, 2)))
    assert home.trig(X) is not None
    assert home.trig(X.scaled(Fraction(1, 2))) is not None
    assert ring(angles=(X,)).trig(X.scaled(Fraction(1, 2))) is None


def test_sums_of_angles_are_generators() -> None:
    sums = ring(angles=(X, X + Y))
    c, s = sums.trig(Y) or (None, None)
    assert c is not None
    assert Scalar(sums, c) == normal(formula("cos(y)"))
    assert Scalar(sums, s) == normal(formula("sin(y)"))


forms = st.dictionaries(st.sampled_from("xyz"), st.integers(-3, 3), max_size=3).map(Form.of)


@given(st.lists(st.integers(-3, 3), min_size=2, max_size=2))
def test_a_combination_is_found(numbers: list[int]) -> None:
    basis = (X, X + Y)
    form = basis[0].scaled(numbers[0]) + basis[1].scaled(numbers[1])
    assert combination(form, basis) == tuple(map(Fraction, numbers))


def test_what_is_no_combination() -> None:
    assert combination(Form.of({"z": 1}), (X, X + Y)) is None


@given(forms, forms)
def test_forms_add_like_vectors(a: Form, b: Form) -> None:
    assert a + b == b + a
    assert a + b + b.scaled(-1) == a
    assert (a + b).of_atom("x") == a.of_atom("x") + b.of_atom("x")
    assert (a + b).without("x").of_atom("x") == 0


@pytest.mark.parametrize("names", [("a", "b"), ("b", "a")], ids=["in order", "the other way round"])
def test_the_order_of_symbols_does_not_matter(names: tuple[str, str]) -> None:
    a, b = (Scalar(home, home.gen(name)) for name, home in ((n, ring(symbols=names)) for n in names))
    assert a * b - b * a == 0
    assert a == Scalar.symbol(names[0])


def test_fixed_angles_have_pairs_of_their_own() -> None:
    home = (normal(formula("cos(25 deg)")) * normal(formula("cos(36 deg)"))).ring
    assert len(home.angles) == 2
    assert normal(formula("cos(-25 deg) + cos(205 deg) + sin(385 deg)")).ring.angles == (
        Form.of({PI: Fraction(5, 36)}),
    )


def test_an_offset_stays_in_its_angle() -> None:
    shifted = normal(formula("cos(x + 25 deg)"))
    assert len(shifted.ring.angles) == 1
    assert shifted == normal(formula("cos(x) cos(25 deg) - sin(x) sin(25 deg)"))
    assert shifted.diff("x") == -normal(formula("sin(x + 25 deg)"))
    assert normal(formula("cos(x/2 + 25 deg)")) ** 2 * 2 - 1 == normal(formula("cos(x + 50 deg)"))
