from __future__ import annotations

import math

import pytest

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.roots_and_functions import absolute, canonical, opaque, root
from derive.algebra.scalar import Scalar
from tests.trees import formula, points, value


def scalar(text: str) -> Scalar:
    return normal(formula(text))


SQUARES = [
    "x^2",
    "(x - y)^2",
    "4 x^2 y^4",
    "x^2 + y^2",
    "2 x^2",
    "x^2/y^2",
    "(x + y)^3 (x + y)",
    "3/4",
    "8 x^2 (1 + x^2)",
]


@pytest.mark.parametrize("text", SQUARES)
def test_a_root_squares_to_its_radicand(text: str) -> None:
    found = root(scalar(text))
    assert found * found == scalar(text)


@pytest.mark.parametrize("text", SQUARES)
@pytest.mark.parametrize("signs", [(1, 1), (-1, 1), (1, -1), (-1, -1)])
def test_a_root_is_the_one_that_is_not_negative(text: str, signs: tuple[int, int]) -> None:
    found = root(scalar(text))
    for at in points(formula("x + y")):
        here = {"x": signs[0] * at["x"], "y": signs[1] * at["y"]}
        assert math.isclose(scalar_number(found, here), math.sqrt(value(formula(text), here)))


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("sqrt(4 x^2)", "2 abs(x)"), ("abs(-3 x)", "3 abs(x)"), ("abs(x)/abs(x)", "1"),
        ("abs(x) abs(x)", "x^2"), ("sqrt(x^2 + y^2)^2", "x^2 + y^2"), ("sqrt(8)", "2 sqrt(2)"),
        ("sqrt(2 x^2)", "sqrt(2) abs(x)"), ("sqrt(sin(x)^2 + cos(x)^2)", "1"),
        ("1/(sqrt(3) - sqrt(2))", "sqrt(3) + sqrt(2)"), ("sqrt(x^2 + 2 x + 1)", "abs(1 + x)"),
    ],
)  # fmt: skip
def test_roots_that_are_equal(left: str, right: str) -> None:
    assert scalar(left) == scalar(right)


def test_the_absolute_value_of_a_number() -> None:
    assert absolute(Scalar.of(-3)) == 3
    assert absolute(scalar("-2 x")) == 2 * absolute(scalar("x"))


def test_an_opaque_function_is_equal_where_its_arguments_are() -> None:
    assert scalar("atan2(y, x + x)") == scalar("atan2(y, 2 x)")
    assert scalar("exp(cos(x)^2)") == scalar("exp(1 - sin(x)^2)")
    assert scalar("atan2(y, x)") != scalar("atan2(y, -x)")
    assert opaque("f", (scalar("x"),)) != opaque("g", (scalar("x"),))


def test_arguments_in_different_rings_are_the_same_argument() -> None:
    assert canonical(scalar("a + b")) == canonical(scalar("b + a"))
    assert opaque("f", (scalar("a b + c - c"),)) == opaque("f", (scalar("b a"),))


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("abs(x - y)", "abs(y - x)"),
        ("sqrt(1/(1 + x^2))", "1/sqrt(1 + x^2)"),
        ("sqrt(1 - cos(x)^2)", "abs(sin(x))"),
        ("exp(cos(x + y))", "exp(cos(x) cos(y) - sin(x) sin(y))"),
        ("sqrt(3 + 2 sqrt(2))", "1 + sqrt(2)"),
        ("abs(cos(x) - cos(x + y))", "abs(cos(x) cos(y) - sin(x) sin(y) - cos(x))"),
        ("sqrt(a^2 - a^2 cos(x + y)^2)", "abs(a sin(x + y))"),
        ("sqrt(4 - 4 cos(x)^2) sqrt(1 - cos(y)^2)", "2 abs(sin(x)) abs(sin(y))"),
        ("abs(1 - sqrt(2))", "sqrt(2) - 1"),
        ("abs(x^2 + 1)", "x^2 + 1"),
        ("abs(x/y)", "abs(x)/abs(y)"),
        ("abs(x/y)^2", "x^2/y^2"),
        ("abs(-2 x y)", "2 abs(y) abs(x)"),
        ("sqrt(1 - cos(36 deg)^2)", "sin(36 deg)"),
        ("exp(cos(x/2 + y))", "exp(cos(x/2) cos(y) - sin(x/2) sin(y))"),
    ],
)
def test_one_writing_of_what_is_equal(left: str, right: str) -> None:
    assert scalar(left) == scalar(right)


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("abs(x)", "x"), ("abs(x + y)", "abs(x - y)"), ("sqrt(1 - cos(x)^2)", "sin(x)"),
        ("sqrt(1 - cos(x)^2)", "abs(cos(x))"), ("exp(cos(x + y))", "exp(cos(x - y))"),
        ("sqrt(x y)", "sqrt(x) sqrt(y) + 1"), ("abs(x - 1)", "abs(x) - 1"),
    ],
)  # fmt: skip
def test_what_differs(left: str, right: str) -> None:
    assert scalar(left) != scalar(right)
