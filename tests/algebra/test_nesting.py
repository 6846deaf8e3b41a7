from __future__ import annotations

import time
from math import prod

import pytest

from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.readable.factoring import factors_of, is_irreducible
from derive.algebra.readable.form import readable
from derive.algebra.readable.operation_count import operations
from derive.algebra.readable.terms import Alphabet, terms_of
from derive.algebra.scalar import Scalar
from tests.algebra.test_angle_sums import expression
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
    scale, factors = factors_of(terms)
    parts = [normal(expression(factor, alphabet)) ** power for factor, power in factors]
    assert prod(parts, start=Scalar.of(scale)) == normal(formula(typed))
    assert not is_irreducible(terms) or len(factors) == 1


PRINTED = [
    # a length is not taken out of some terms only, nor a number out of terms of several masses
    ("m (L^2 + 2 L_c^2 + 2 L L_c cos(x)) + 2 I_zz", "m*(L**2 + 2*L_c**2 + 2*L*L_c*cos(x)) + 2*I_zz"),
    ("m (a cos(x) + b cos(x + y))^2", "m*(a*cos(x) + b*cos(x + y))**2"),
    ("(x^2 + y^2)/2 - 1", "(x**2 + y**2)/2 - 1"),
    # squares of sums, whatever stands in front
    ("m (d^2 + 2 d z + z^2)", "m*(z + d)**2"),
    ("-m (d^2 + 2 d z + z^2) - I", "-m*(z + d)**2 - I"),
    ("m (d + z)^2 sin(x)^2 + n (d - y)^2", "n*(d - y)**2 + m*(z + d)**2*sin(x)**2"),
    ("m (d + z) (d + z + a cos(x))", "m*(z + d)*(z + d + a*cos(x))"),
    ("I - I cos(x)^2 + m", "m + I*sin(x)**2"),
    # one sign, in front
    ("-m (d + z) sin(y) (a sin(x) + b)", "-m*(z + d)*(b + a*sin(x))*sin(y)"),
]  # fmt: skip


@pytest.mark.parametrize(("typed", "printed"), PRINTED)
def test_what_a_person_would_write(typed: str, printed: str) -> None:
    found = readable(normal(formula(typed)))
    assert normal(found) == normal(formula(typed))
    assert text(found) == printed


def test_a_long_sum_is_written_in_a_moment() -> None:
    start = time.process_time()
    long = formula("(a + b cos(x) + c sin(y) + d cos(z))^4 (1 + e sin(x + y))")
    found = normal(long)
    assert normal(readable(found)) == found
    assert time.process_time() - start < 2
