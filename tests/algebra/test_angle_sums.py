from __future__ import annotations

import pytest
from hypothesis import given

from derive.algebra.normal import normal
from derive.algebra.readable.angle_sums import contracted
from derive.algebra.readable.terms import Alphabet, Terms, terms_of
from derive.expression import Expr, Power, Sum, multiply
from derive.expression import number as exact
from tests.trees import formula, polynomials


def expression(terms: Terms, alphabet: Alphabet) -> Expr:
    """The sum that terms stand for, written without any search."""
    parts = []
    for monomial, coefficient in terms.items():
        powers = [Power(alphabet.expression(atom), exact(power)) for atom, power in monomial]
        parts.append(multiply(exact(coefficient), *powers))
    return Sum((exact(0), *parts))


def contract(expr: Expr) -> tuple[Terms, Terms, Alphabet]:
    alphabet = Alphabet()
    terms = terms_of(normal(expr), alphabet)
    return terms, contracted(terms, alphabet), alphabet


@given(polynomials())
def test_contracted_terms_are_equal(expr: Expr) -> None:
    before, after, alphabet = contract(expr)
    assert normal(expression(before, alphabet)) == normal(expr)
    assert normal(expression(after, alphabet)) == normal(expr)


@given(polynomials())
def test_contraction_never_adds_a_term(expr: Expr) -> None:
    before, after, _ = contract(expr)
    assert len(after) <= len(before)


@given(polynomials(5))
def test_the_terms_given_are_left_as_they_are(expr: Expr) -> None:
    alphabet = Alphabet()
    terms = terms_of(normal(expr), alphabet)
    kept = dict(terms)
    contracted(terms, alphabet)
    assert terms == kept


@pytest.mark.parametrize(
    ("typed", "count"),
    [
        ("cos(x) cos(y) - sin(x) sin(y)", 1),
        ("cos(x) cos(y) + sin(x) sin(y)", 1),
        ("sin(x) cos(y) + cos(x) sin(y)", 1),
        ("sin(x) cos(y) - cos(x) sin(y)", 1),
        ("a cos(x) cos(y) - a sin(x) sin(y) + b", 2),
        ("cos(x) cos(y) - 2 sin(x) sin(y)", 2),
        ("a - a cos(x)^2", 1),
        ("cos(x) - cos(x)^3", 1),
        ("cos(x) cos(y) cos(z) - sin(x) sin(y) cos(z) - sin(x) cos(y) sin(z) - cos(x) sin(y) sin(z)", 1),
    ],
)
def test_how_many_terms_are_left(typed: str, count: int) -> None:
    _, after, _ = contract(formula(typed))
    assert len(after) == count
