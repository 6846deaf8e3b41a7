from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    Approximate,
    Call,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    atan2,
    cos,
    cross,
    negate,
    number,
    sin,
    sqrt,
    squared,
    subtract,
    symbols,
    transpose,
)
from derive.render.latex import is_approximate, latex
from derive.render.notation import Notation
from derive.render.trig import alike_letters, meant_indices

theta1, theta2, phi, psi, m, L, a, b, z = symbols("theta1 theta2 phi psi m L a b z")
NOTATION = Notation()


@pytest.mark.parametrize(
    ("expr", "short", "long"),
    [
        (cos(theta1), "c_1", r"\cos \theta_1"),
        (sin(Sum((theta1, theta2))), "s_{12}", r"\sin(\theta_1 + \theta_2)"),
        (squared(cos(theta2)), "c_2^2", r"\cos^2 \theta_2"),
        (cos(subtract(theta1, theta2)), r"\cos(\theta_1 - \theta_2)", r"\cos(\theta_1 - \theta_2)"),
        (cos(phi), r"\cos \phi", r"\cos \phi"),
        (cos(Symbol("q_2")), "c_2", r"\cos q_2"),
        (cos(Symbol("alpha1")), r"\cos \alpha_1", r"\cos \alpha_1"),
        (cos(Degrees(Fraction(30))), r"\cos 30^\circ", r"\cos 30^\circ"),
        (Product((cos(theta1), sin(theta2))), "c_1 s_2", r"\cos \theta_1 \sin \theta_2"),
        (Product((cos(theta1), b)), "c_1 b", r"\cos(\theta_1) b"),
        (Product((squared(cos(theta1)), b)), "c_1^2 b", r"\cos^2(\theta_1) b"),
    ],
)
def test_sines_and_cosines_in_both_notations(expr: Expr, short: str, long: str) -> None:
    assert latex(expr, NOTATION) == short
    assert latex(expr, replace(NOTATION, trig="long")) == long


def test_angles_the_problem_lists_are_abbreviated_by_name() -> None:
    listed = Notation(short_names=frozenset({"phi", "theta1"}))
    assert latex(Product((cos(phi), sin(theta1))), listed) == r"c_\phi s_{\theta_1}"


def test_atan2_in_both_orders() -> None:
    expr = atan2(Symbol("y"), Symbol("x"))
    assert latex(expr, NOTATION) == r"\mathrm{atan2}(y, x)"
    assert latex(expr, Notation(atan2="xy")) == r"\mathrm{Atan2}(x, y)"


@pytest.mark.parametrize(
    ("expr", "printed"),
    [
        (Product((number("-1/2"), m, squared(L), sin(theta2))), r"-\frac{m L^2}{2} s_2"),
        (Product((number("1/2"), Sum((a, b)))), r"\frac{1}{2} (a + b)"),
        (Product((number("1/2"), transpose(a), b)), r"\frac{1}{2} a^T b"),
        (Product((number("1/2"), m, Symbol("theta1_ddot"))), r"\frac{m}{2} \ddot{\theta}_1"),
        (Product((number("101/1200"), m)), r"\frac{101 m}{1200}"),
        (Sum((negate(a), negate(b), number("0.1", True))), "-a - b + 0.1"),
        (Sum((a, Sum((b, negate(m))))), "a + (b - m)"),
        (Product((MINUS_ONE, Sum((a, b)))), "-(a + b)"),
        (Product((a, negate(b))), "a (-b)"),
        (Product((number(2), number(3), a, number(4))), r"2 \cdot 3 a \cdot 4"),
        (Quotient(negate(m), Sum((a, b))), r"-\frac{m}{a + b}"),
        (Power(Quotient(a, b), number(2)), r"\left( \frac{a}{b} \right)^2"),
        (Power(a, number("1/2")), r"\sqrt{a}"),
        (Power(Sum((a, b)), number(-1)), "(a + b)^{-1}"),
        (sqrt(Sum((squared(a), squared(b)))), r"\sqrt{a^2 + b^2}"),
        (Derivative(Symbol("d_11"), theta1), r"\frac{\partial d_{11}}{\partial \theta_1}"),
        (Derivative(Symbol("D"), Symbol("t")), r"\frac{dD}{dt}"),
        (cross(Symbol("z_0"), subtract(Symbol("o_2"), Symbol("o_0"))), r"z_0 \times (o_2 - o_0)"),
        (transpose(Symbol("T_1^0")), "(T_1^0)^T"),
        (Call("inverse", (Symbol("J"),)), "J^{-1}"),
        (Indexed("R", (z, Degrees(Fraction(30)))), r"R_{z,30^\circ}"),
        (Call("Rot_z", (theta1,)), r"\mathrm{Rot}_z(\theta_1)"),
        (Call("V_a", (Symbol("s"),)), "V_a(s)"),
        (Call("abs", (a,)), r"\lvert a \rvert"),
        (Call("exp", (negate(a),)), "e^{-a}"),
        (Matrix(((a, ZERO), (ONE, b))), r"\begin{bmatrix} a & 0 \\ 1 & b \end{bmatrix}"),
        (number("0.10", True), "0.1"),
        (number("1.0", True), "1"),
        (number("1/3", True), r"\frac{1}{3}"),
        (Degrees(Fraction(-90)), r"-90^\circ"),
    ],
)
def test_a_tree_prints_as_a_person_writes_it(expr: Expr, printed: str) -> None:
    assert latex(expr, NOTATION) == printed


@pytest.mark.parametrize(
    ("value", "printed"),
    [(0.43301, "0.433"), (0.75, "0.75"), (1e-17, "0"), (-2.0, "-2"), (1234.5, "1230"),
     (0.0012345, "0.00123"), (1.25e-7, r"1.25 \cdot 10^{-7}"), (-3.2e8, r"-3.2 \cdot 10^{8}"),
     (9.9996, "10.0")],
)  # fmt: skip
def test_rounded_numbers(value: float, printed: str) -> None:
    assert latex(Approximate(value), NOTATION) == printed


def test_rounded_numbers_are_found_at_any_depth() -> None:
    assert is_approximate(Matrix(((a, Product((b, Approximate(0.5)))),)))
    assert not is_approximate(Matrix(((a, b),)))


def test_an_inverse_sine_is_no_sine_below_a_fraction() -> None:
    assert latex(Power(sin(phi), number(-1)), NOTATION) == r"(\sin \phi)^{-1}"


def test_a_name_of_the_sheet_is_no_cosine() -> None:
    both = Product((Symbol("c1"), cos(theta1), cos(theta2)))
    assert latex(both, replace(NOTATION, meant=meant_indices({"c1"}))) == r"c_1 \cos \theta_1 \, c_2"


@pytest.mark.parametrize(
    ("factors", "printed"),
    [
        ((cos(phi), a + b), r"\cos \phi \, (a + b)"),  # one way to write a function
        ((cos(phi), Symbol("phi_dot")), r"\cos \phi \, \dot{\phi}"),
        ((cos(phi), sin(phi)), r"\cos \phi \sin \phi"),
        ((Symbol("L"), cos(theta1)), r"L \, c_1"),  # beside L_c
        ((a, cos(theta1)), "a c_1"),
        ((Indexed("Trans", (Symbol("x"), a)), Indexed("Rot", (Symbol("z"), phi))),
         r"\mathrm{Trans}_{x,a} \, \mathrm{Rot}_{z,\phi}"),
    ],
)  # fmt: skip
def test_room_where_factors_look_like_something_else(factors: tuple[Expr, ...], printed: str) -> None:
    assert latex(Product(factors), replace(NOTATION, alike=alike_letters({"L", "L_c", "a"}))) == printed
