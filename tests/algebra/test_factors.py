"""Products of sines and cosines are found again, whichever way they were multiplied out."""

from __future__ import annotations

import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import common_factor, depends, factored, primitive_column

ANGLES = ("q1", "q2", "q3")


def scalar(text: str) -> Scalar:
    return normal(parse(text))


@pytest.mark.parametrize(
    ("product", "factors"),
    [
        ("sin(q1)", ["sin(q1)"]),
        ("sin(q1)^2", ["sin(q1)"]),
        ("sin(q1) cos(q1)", ["sin(q1)", "cos(q1)"]),
        ("1 - cos(q1)", ["1 - cos(q1)"]),
        ("sin(q1) (1 + cos(q1))", ["sin(q1)", "1 + cos(q1)"]),
        ("a sin(q3) (a cos(q2) + b cos(q2 + q3))", ["sin(q3)", "a cos(q2) + b cos(q2 + q3)"]),
        ("sin(q2) sin(q3) sin(q2 + q3)", ["sin(q2)", "sin(q3)", "sin(q2 + q3)"]),
        ("(a + b cos(q1)) (c + d sin(q2))", ["a + b cos(q1)", "c + d sin(q2)"]),
        ("d3^2 sin(q2)", ["d3", "sin(q2)"]),
        ("sin(q1) cos(q2) - cos(q1) sin(q2)", ["sin(q1 - q2)"]),
    ],
)
def test_factors(product: str, factors: list[str]) -> None:
    value = scalar(product)
    found = factored(value, (*ANGLES, "d3"))
    assert found.value == value
    wanted = [scalar(each) for each in factors]
    for factor, _ in found.factors:
        assert any(depends_only_by_number(factor, each) for each in wanted), str(factor)
    assert len(found.factors) == len(wanted)


def depends_only_by_number(one: Scalar, other: Scalar) -> bool:
    """Whether two are multiples of each other."""
    return (one / other).constant is not None if one and other else False


def test_a_sum_without_factors_is_one() -> None:
    value = scalar("a cos(q1) + b cos(q1 + q2) + c cos(q1 + q2 + q3)")
    found = factored(value, ANGLES)
    assert len(found.factors) == 1
    assert found.value == value


def test_parameters_stand_in_front() -> None:
    found = factored(scalar("a b sin(q2)"), ANGLES)
    assert found.constant == scalar("a b")
    assert not depends(found.constant, ANGLES)


def test_zero_and_constants() -> None:
    assert factored(scalar("0"), ANGLES).value == 0
    assert factored(scalar("a + b"), ANGLES).factors == ()


def test_what_several_share() -> None:
    shared, (one, two) = common_factor([scalar("a sin(q1) cos(q2)"), scalar("b sin(q1)^2")], ANGLES)
    assert shared * one == scalar("a sin(q1) cos(q2)")
    assert shared * two == scalar("b sin(q1)^2")
    assert not (one / two).constant


def test_a_direction_without_fractions() -> None:
    column = ScalarMatrix.column([scalar("cos(q1)/sin(q1)"), scalar("1")])
    found = primitive_column(column, ANGLES)
    assert found == ScalarMatrix.column([scalar("cos(q1)"), scalar("sin(q1)")])
