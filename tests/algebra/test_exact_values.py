from __future__ import annotations

import math
from fractions import Fraction

import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from derive.algebra.exact_values import fixed_trig, square_root
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from tests.trees import formula

FIFTEENTHS = range(-30, 31)


@pytest.mark.parametrize("steps", FIFTEENTHS)
def test_multiples_of_fifteen_degrees_are_those_of_sympy(steps: int) -> None:
    c, s = fixed_trig(Fraction(steps, 12))
    angle = sympy.Rational(steps, 12) * sympy.pi
    assert c == normal(formula(str(sympy.radsimp(sympy.cos(angle))).replace("**", "^")))
    assert s == normal(formula(str(sympy.radsimp(sympy.sin(angle))).replace("**", "^")))


@given(st.fractions(min_value=-4, max_value=4, max_denominator=40))
def test_any_fixed_angle_has_its_value(turns: Fraction) -> None:
    c, s = fixed_trig(turns)
    assert math.isclose(scalar_number(c, {}), math.cos(math.pi * turns), abs_tol=1e-12)
    assert math.isclose(scalar_number(s, {}), math.sin(math.pi * turns), abs_tol=1e-12)
    assert c * c + s * s == 1


@given(st.fractions(min_value=-4, max_value=4, max_denominator=40))
def test_whole_turns_and_half_turns_of_any_angle(turns: Fraction) -> None:
    c, s = fixed_trig(turns)
    assert fixed_trig(turns + 2) == (c, s)
    assert fixed_trig(turns + 1) == (-c, -s)
    assert fixed_trig(turns + Fraction(1, 2)) == (-s, c)


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("cos(100 deg)", "2 cos(50 deg)^2 - 1"),
        ("sin(36 deg)", "cos(54 deg)"),
        ("cos(60 deg)", "4 cos(20 deg)^3 - 3 cos(20 deg)"),
    ],
)
def test_relations_between_fixed_angles(left: str, right: str) -> None:
    assert normal(formula(left)) == normal(formula(right))


@pytest.mark.parametrize("degrees", [7, 10, 18, 20, 40])
def test_the_double_of_a_fixed_angle(degrees: int) -> None:
    left, right = formula(f"cos({2 * degrees} deg)"), formula(f"2 cos({degrees} deg)^2 - 1")
    assert normal(left) == normal(right)


@given(st.fractions(min_value=0, max_value=200, max_denominator=50))
def test_a_square_root_squares_to_its_radicand(value: Fraction) -> None:
    found = square_root(value)
    assert found * found == value
    assert math.isclose(scalar_number(found, {}), math.sqrt(value))


@given(st.integers(1, 60), st.integers(1, 60))
def test_roots_multiply(p: int, q: int) -> None:
    assert square_root(Fraction(p)) * square_root(Fraction(q)) == square_root(Fraction(p * q))
    assert square_root(Fraction(p)) / square_root(Fraction(q)) == square_root(Fraction(p, q))


def test_a_negative_number_has_no_root() -> None:
    with pytest.raises(ValueError, match="not real"):
        square_root(Fraction(-2))


@pytest.mark.parametrize("rest", [5 * 72211 * 2766942732083370015550723, 10**33 + 61 * 10**17 + 7])
@pytest.mark.parametrize("small", [1, 2**90, 3 * 10**40])
def test_a_large_number_has_the_same_root_beside_small_primes(rest: int, small: int) -> None:
    assert square_root(Fraction(rest * small)) == square_root(Fraction(rest)) * square_root(Fraction(small))
    assert square_root(Fraction(rest, small**2)) == square_root(Fraction(rest)) / small
