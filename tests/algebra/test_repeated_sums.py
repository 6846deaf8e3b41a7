from __future__ import annotations

import pytest
from hypothesis import given

from derive.algebra.normal import normal
from derive.algebra.readable.repeated_sums import lumped
from derive.algebra.readable.terms import Alphabet, terms_of
from derive.expression import Expr
from tests.algebra.test_angle_sums import expression
from tests.trees import formula, polynomials


@given(polynomials())
def test_terms_with_sums_as_letters_are_equal(expr: Expr) -> None:
    alphabet = Alphabet()
    found = lumped(terms_of(normal(expr), alphabet), alphabet)
    assert normal(expression(found, alphabet)) == normal(expr)


@pytest.mark.parametrize(
    ("typed", "count"),
    [
        ("(a + b)^2", 1),
        ("(a - b)^2 c", 1),
        ("(a + b + c)^2", 1),
        ("(a + b)^3 cos(x) + (a + b) d", 2),
        ("(a + 2 b)^2", 3),  # no sum with the numbers 1 and -1
        ("a + b", 2),  # nothing is gained
        ("a^2 + b^2", 2),
        ("(a + b)^2 + a", 4),
    ],
)
def test_how_many_terms_are_left(typed: str, count: int) -> None:
    alphabet = Alphabet()
    assert len(lumped(terms_of(normal(formula(typed)), alphabet), alphabet)) == count
