from __future__ import annotations

import time
from math import prod

import pytest

from derive.algebra.nesting import factors_of
from derive.algebra.normal import normal
from derive.algebra.operations import operations
from derive.algebra.readable import readable
from derive.algebra.scalar import Scalar
from derive.algebra.terms import Alphabet, terms_of
from tests.algebra.test_contraction import expression
from tests.trees import formula


@pytest.mark.parametrize(
    ("typed", "most"),
    [
        ("a c + a d + b c + b d", 3),
        ("m L^2 + 2 m L L_c cos(x) + m L_c^2 + I", 9),
        ("cos(x) cos(y) cos(z) - cos(x) sin(y) sin(z) - a", 3),
        ("m (L^2 + 2 L_c^2 + 2 L L_c cos(theta2)) + 2 I_zz", 12),
        ("(2002 + 1200 cos(theta2)) m L^2/1200", 6),
    ],
)
def test_few_operations_are_found(typed: str, most: int) -> None:
    found = readable(normal(formula(typed)))
    assert normal(found) == normal(formula(typed))
    assert operations(found) <= most


@pytest.mark.parametrize(
    "typed",
    ["(a + b) (c + d)", "(a + b)^2", "(a - b) (a + 2 b)^2", "(a + cos(x)) (b - sin(y))", "a + b c + 1"],
)
def test_the_factors_multiply_to_the_whole(typed: str) -> None:
    alphabet = Alphabet()
    terms = terms_of(normal(formula(typed)), alphabet)
    parts = [normal(expression(factor, alphabet)) ** power for factor, power in factors_of(terms)]
    assert prod(parts, start=Scalar.of(1)) == normal(formula(typed))


def test_a_long_sum_is_written_in_a_moment() -> None:
    start = time.process_time()
    long = formula("(a + b cos(x) + c sin(y) + d cos(z))^4 (1 + e sin(x + y))")
    found = normal(long)
    assert normal(readable(found)) == found
    assert time.process_time() - start < 2
