"""Sums of what moves are written rate by rate, with the sums of rates that make them short."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from derive.expression import Expr, Sum, multiply
from tests.trees import formula, polynomials

RATES = ("x_dot^2", "x_dot y_dot", "(x_dot + y_dot)^2", "y_ddot", "1")


@given(st.lists(polynomials(4), min_size=len(RATES), max_size=len(RATES)))
def test_sums_over_rates_normalise_back(coefficients: list[Expr]) -> None:
    found = normal(Sum(tuple(map(multiply, coefficients, map(formula, RATES)))))
    assert normal(readable(found)) == found


@pytest.mark.parametrize(
    ("typed", "written"),
    [
        (
            "m l^2 x_dot^2/2 + m l a c x_dot (x_dot + y_dot) + (m a^2 + I) (x_dot + y_dot)^2/2",
            "(m*a**2 + I)*(x_dot + y_dot)**2/2 + m*a*c*l*x_dot*(x_dot + y_dot) + m*l**2*x_dot**2/2",
        ),
        ("(m d^2 + I) x_ddot + 2 m d y_dot x_dot", "(m*d**2 + I)*x_ddot + 2*m*d*x_dot*y_dot"),
        ("l cos(theta2) (2 x_ddot + y_ddot)", "l*cos(theta2)*(2*x_ddot + y_ddot)"),
        ("(m1 + m2) g l cos(theta1) + m2 g a cos(theta2)", "(m1 + m2)*g*l*cos(theta1) + m2*g*a*cos(theta2)"),
        ("(I - 3 J) b x_dot", "-(3*J - I)*b*x_dot"),
    ],
)
def test_as_in_a_textbook(typed: str, written: str) -> None:
    assert str(text(readable(normal(formula(typed))))) == written
