"""Trees put together by operators: as they are written, and nothing more."""

from __future__ import annotations

import pytest

from derive.algebra.infix import text
from derive.expression import ONE, ZERO, Expr, Power, Product, Quotient, Sum, negate, number, symbols

a, b, c = symbols("a b c")


@pytest.mark.parametrize(
    ("written", "tree"),
    [
        (a + b + c, Sum((a, b, c))),
        (a + (b + c), Sum((a, Sum((b, c))))),
        (a - b, Sum((a, negate(b)))),
        (a * b * c, Product((a, b, c))),
        (a * (b * c), Product((a, Product((b, c))))),
        (2 * (a + b) / c**2, Quotient(Product((number(2), Sum((a, b)))), Power(c, number(2)))),
        (1 - a, Sum((ONE, negate(a)))),
        (1 / a, Quotient(ONE, a)),
        (3 + a, Sum((number(3), a))),
        (-(a * b), Product((number(-1), a, b))),
        (ONE * a, Product((ONE, a))),
    ],
)
def test_a_tree_keeps_what_was_written(written: Expr, tree: Expr) -> None:
    assert written == tree


def test_zeros_are_left_out_of_sums_only() -> None:
    assert a + ZERO == a
    assert ZERO + a - ZERO == a
    assert text(ZERO * a) == "0*a"
