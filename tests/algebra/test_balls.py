"""Numbers of many digits; signs of numbers that floats do not tell from zero, the digits from tables."""

from __future__ import annotations

import math

import pytest
from flint import arb, ctx

from derive.algebra.ball_arithmetic import BITS, precise, slope
from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.balls import number_sign
from tests.trees import value


@pytest.mark.parametrize(
    ("typed", "sign"),
    [
        ("sqrt(2) - 1.41421356237309504880168872420969807", 1),
        ("sqrt(2) - 1.41421356237309504880168872420969808", -1),
        ("pi - 3.14159265358979323846264338327950288", 1),
        ("cos(60 deg) - 1/2", 0),
        ("sqrt(3 + 2*sqrt(2)) - sqrt(2) - 1", 0),
        ("exp(1) - 2.71828182845904523536028747135266250", -1),
    ],
)
def test_signs(typed: str, sign: int) -> None:
    assert number_sign(normal(parse(typed))) == sign


def test_symbols_have_none() -> None:
    with pytest.raises(KeyError):
        number_sign(normal(parse("a - 1")))


TEXTS = [
    "x^2 + 3*x/7",
    "sin(x)*exp(-x)",
    "atan2(x, 2) + sqrt(x)",
    "acos(x/2) - log(x)",
    "30 deg + pi",
    "abs(-x)",
]


@pytest.mark.parametrize("text", TEXTS)
def test_it_is_the_value_of_the_tree(text: str) -> None:
    with ctx.workprec(BITS):
        assert float(precise(parse(text), {"x": arb(0.75)}).mid()) == pytest.approx(
            value(parse(text), {"x": 0.75})
        )


def test_a_difference_of_a_difference_keeps_its_digits() -> None:
    with ctx.workprec(BITS):
        second = slope(lambda x: slope(lambda y: y.sin(), x), arb(1))
    assert float(second.mid()) == pytest.approx(-math.sin(1), abs=1e-15)
