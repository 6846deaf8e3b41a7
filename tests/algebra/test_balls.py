"""Signs of numbers that floats do not tell from zero; digits from tables."""

from __future__ import annotations

import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.balls import number_sign


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
