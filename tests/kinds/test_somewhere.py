"""Chains in floats: what is wrong on both sides of a link is contradicted; nothing agrees with no number."""

from __future__ import annotations

from fractions import Fraction
from math import nan

import pytest

from derive.expression import Call, Degrees, Expr, Matrix, Symbol, number, sqrt, symbols, transpose
from derive.kinds.chain_rule import chain_rule
from derive.kinds.meanings import farthest
from derive.kinds.somewhere import Somewhere, contradicted

x, y, s, s_dot, s_ddot, p_s, p_ss = symbols("x y s s_dot s_ddot p_s p_ss")
A = Matrix(((x, y), (number(0), number(2))))


def cos(degrees: int) -> Expr:
    return Call("cos", (Degrees(Fraction(degrees)),))


@pytest.mark.parametrize(
    "chain",
    [
        (cos(120), number("-1/2")),
        (Symbol("a"), x * x + y),
        (transpose(A) * A, Matrix(((x**2, x * y), (x * y, y**2 + number(4))))),
        (sqrt(number(2)) * sqrt(number(2)), number(2)),
    ],
)
def test_what_is_equal_is_not_contradicted(chain: tuple[Expr, ...]) -> None:
    assert not contradicted(chain, Somewhere({Symbol("a"): x**2 + y}))


@pytest.mark.parametrize(
    "chain", [(cos(120), sqrt(number(3))), (Symbol("a"), x * x - y), (A, transpose(A)), (x, x, y)]
)
def test_what_differs_is_contradicted(chain: tuple[Expr, ...]) -> None:
    assert contradicted(chain, Somewhere({Symbol("a"): x**2 + y}))


def test_a_name_that_rests_on_itself_has_no_value() -> None:
    names: dict[Expr, Expr] = {x: y + number(1), y: x + number(1)}
    assert not contradicted((x, number(7)), Somewhere(names))


def test_what_is_no_number_agrees_with_nothing() -> None:
    assert farthest([(x, y)], {x: 1.0, y: nan}) == 1.0
    assert farthest([(x, y)], {x: 1.0, y: 1.0}) == 0.0


def test_the_chain_rule_is_tried_where_the_second_derivative_counts() -> None:
    velocity, acceleration = p_s * s_dot, p_s * s_ddot + p_ss * s_dot**2
    slopes, rates = (p_s, p_ss), (s, s_dot, s_ddot)
    assert all(chain_rule((velocity, acceleration), slopes, rates))
    assert [*chain_rule((velocity, p_s * s_ddot), slopes, rates)] == [True, False]
