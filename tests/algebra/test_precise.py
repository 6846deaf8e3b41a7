"""Numbers of many digits."""

from __future__ import annotations

import math

import pytest
from flint import arb, ctx

from derive.algebra.formulas.grammar import parse
from derive.algebra.precise import BITS, precise, slope
from tests.trees import value

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
