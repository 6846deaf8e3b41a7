"""Lagrange's equations as operations on normal forms."""

from __future__ import annotations

from derive.algebra.formulas.grammar import parse
from derive.algebra.function import Constraint
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.mechanics.lagrangian import (
    LagrangianSystem,
    by_rates,
    conditions,
    energy,
    inertial_side,
    mass_matrix,
    on_accelerations,
    rate,
)

PLANE = LagrangianSystem(("r", "phi"), constraints=(Constraint(parse("r"), parse("a*phi")),))


def scalar(text: str) -> Scalar:
    return normal(parse(text))


def test_rates_follow_the_chain_rule() -> None:
    assert rate(scalar("r^2*cos(phi) + t*r"), PLANE) == scalar(
        "2*r*r_dot*cos(phi) - r^2*phi_dot*sin(phi) + r + t*r_dot"
    )


def test_polar_coordinates() -> None:
    L = scalar("m/2*(r_dot^2 + r^2*phi_dot^2) - U*r")
    sides = inertial_side(L, PLANE)
    assert sides[0] == scalar("m*r_ddot - m*r*phi_dot^2 + U")
    assert sides[1] == scalar("m*r^2*phi_ddot + 2*m*r*r_dot*phi_dot")
    assert mass_matrix(sides, PLANE).det() == scalar("m^2*r^2")
    assert energy(L, PLANE) == scalar("m/2*(r_dot^2 + r^2*phi_dot^2) + U*r")


def test_terms_by_products_of_rates() -> None:
    found = by_rates(scalar("a*x_dot^2 + b*x_dot*y_dot + 3*x_dot^2 - c"), ("x_dot", "y_dot"))
    assert [powers for powers, _ in found] == [{"x_dot": 2}, {"x_dot": 1, "y_dot": 1}, {}]
    assert [factor == scalar(text) for (_, factor), text in zip(found, ("a + 3", "b", "-c"), strict=True)]


def test_a_constraint_is_differentiated_until_accelerations_stand_in_it() -> None:
    (holonomic,) = conditions(PLANE, {})
    assert holonomic.sort == "holonomic"
    assert on_accelerations(holonomic, PLANE) == scalar("r_ddot - a*phi_ddot")
    rolling = LagrangianSystem(("x", "y"), constraints=(Constraint(parse("x_dot"), parse("y*y_dot")),))
    (velocity,) = conditions(rolling, {})
    assert velocity.sort == "velocity"
    assert on_accelerations(velocity, rolling) == scalar("x_ddot - y_dot^2 - y*y_ddot")
