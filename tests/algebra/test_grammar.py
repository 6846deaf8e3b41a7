"""What an author types against the tree it must give, worked out by hand."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from derive.algebra.formulas.grammar import parse, parse_equation, parse_starred
from derive.algebra.formulas.units import ACCELERATION, ANGLE, ANY, FORCE, INERTIA, LENGTH, MASS, Wanted
from derive.errors import FormulaError
from derive.expression import (
    PI,
    Call,
    Degrees,
    Expr,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    number,
    symbols,
)

a, b, c, m, g, L, s, t = symbols("a b c m g L s t")
TWO = number(2)
MINUS = number(-1)


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("a + b - c", Sum((a, b, Product((MINUS, c))))),
        ("a - (b - c)", Sum((a, Product((MINUS, Sum((b, Product((MINUS, c))))))))),
        ("-a*b + c", Sum((Product((MINUS, a, b)), c))),
        ("a/-b*c", Product((Quotient(a, Product((MINUS, b))), c))),
        ("a/b/c", Quotient(Quotient(a, b), c)),
        ("-a^2", Product((MINUS, Power(a, TWO)))),
        ("a^b^c", Power(a, Power(b, c))),
        ("a**2", Power(a, TWO)),
        ("2 L", Product((TWO, L))),
        ("2 m L", Product((TWO, m, L))),
        ("2(a + b)", Product((TWO, Sum((a, b))))),
        ("a (b + c)", Product((a, Sum((b, c))))),
        ("1/2 a", Product((Quotient(number(1), TWO), a))),
        ("2*(a + b)", Product((TWO, Sum((a, b))))),
        ("0.10", Number(Fraction(1, 10), decimal=True)),
        ("1.5e-3", Number(Fraction(3, 2000), decimal=True)),
        ("sqrt(3)/2", Quotient(Call("sqrt", (number(3),)), TWO)),
        ("atan2(a, b)", Call("atan2", (a, b))),
        ("pi/2", Quotient(PI, TWO)),
        ("cos(30 deg)", Call("cos", (Degrees(Fraction(30)),))),
        ("θ_1 \N{MULTIPLICATION SIGN} L₂", Product((Symbol("theta_1"), Symbol("L2")))),
        ("a \N{MINUS SIGN} π", Sum((a, Product((MINUS, PI))))),
        ("a²", Power(a, TWO)),
        ("lambda", Symbol("lambda")),
    ],
)  # fmt: skip
def test_tree(text: str, tree: Expr) -> None:
    assert parse(text) == tree


@pytest.mark.parametrize(
    ("text", "dimension", "tree"),
    [
        ("0.1 m", LENGTH, Number(Fraction(1, 10), decimal=True)),
        ("100mm", LENGTH, number("1/10", True)),
        ("1e-3 km", LENGTH, Number(Fraction(1), decimal=True)),
        ("1/2 m", LENGTH, Quotient(number(1), TWO)),
        ("1000 mm", LENGTH, number(1)),
        ("(1/3) mm", LENGTH, number("1/3000")),
        ("22.5 deg", ANGLE, Degrees(Fraction(45, 2))),
        ("(1/2) mm", LENGTH, number("1/2000", True)),
        ("L*2 mm", LENGTH, Product((L, number("1/500", True)))),
        ("-30 deg", ANGLE, Degrees(Fraction(-30))),
        ("90°", ANGLE, Degrees(Fraction(90))),
        ("2*30 deg", ANGLE, Product((TWO, Degrees(Fraction(30))))),
        ("90", ANGLE, number(90)),
        ("9.81 m/s^2", ACCELERATION, Number(Fraction(981, 100), decimal=True)),
        ("9.81 m / s^2", ACCELERATION, Number(Fraction(981, 100), decimal=True)),
        ("2 kg*m^2", INERTIA, TWO),
        ("20 g", MASS, number("1/50", True)),
        ("3 N m", ANY, number(3)),
        ("30 deg/s", ANY, Degrees(Fraction(30))),
        # where a letter is a symbol all the same
        ("2*m", LENGTH, Product((TWO, m))),
        ("2 m L", LENGTH, Product((TWO, m, L))),
        ("2 m g", FORCE, Product((TWO, m, g))),
        ("m*g*L", ANY, Product((m, g, L))),
        ("5 kg * g", FORCE, Product((number(5), g))),
        ("L*cos(2 m)", LENGTH, Product((L, Call("cos", (Product((TWO, m)),))))),
        ("2 s", None, Product((TWO, s))),
        ("2 m^a", ANY, Product((TWO, Power(m, a)))),
        # an arc is an angle times a radius
        ("atan2(a, b) * 1 m", LENGTH, Product((Call("atan2", (a, b)), number(1)))),
    ],
)  # fmt: skip
def test_units(text: str, dimension: Wanted, tree: Expr) -> None:
    assert parse(text, dimension=dimension) == tree


@pytest.mark.parametrize(
    ("text", "dimension", "tree"),
    [
        ("2 m", LENGTH, TWO),
        ("2 m", MASS, Product((TWO, m))),
        ("2 g", MASS, number("1/500", True)),
        ("2 g", ACCELERATION, Product((TWO, g))),
        ("L*2 m", LENGTH, Product((L, TWO, m))),
        ("9.81 m/s^2", ANY, Number(Fraction(981, 100), decimal=True)),
        ("2*m", ANY, Product((TWO, m))),
    ],
)
def test_declared_names(text: str, dimension: Wanted, tree: Expr) -> None:
    assert parse(text, dimension=dimension, names=frozenset("mg")) == tree


def test_what_could_be_both_is_a_fault() -> None:
    with pytest.raises(FormulaError, match="could be a unit or a symbol"):
        parse("2 m", dimension=ANY, names=frozenset("m"))


@pytest.mark.parametrize(
    ("text", "dimension", "message", "offset"),
    [
        ("30 deg", LENGTH, "this is an angle", 3),
        ("3 m", MASS, "this is a length (m), but a mass (kg) is wanted", 2),
        ("0.1 m + 3 kg", LENGTH, "cannot be added", 6),
        ("30 deg + 1 m", ANY, "cannot be added", 7),
        ("2 m/s", LENGTH, "this is a speed", 2),
        ("cos(a) + sin(1 kg)", ANGLE, "no unit can stand here", 15),
        ("2 kg", None, "no unit can stand here", 2),
        ("2^(3 m)", LENGTH, "an exponent is a plain number", 1),
    ],
)  # fmt: skip
def test_wrong_units(text: str, dimension: Wanted, message: str, offset: int) -> None:
    with pytest.raises(FormulaError) as caught:
        parse(text, dimension=dimension)
    assert message in caught.value.message
    assert caught.value.offset == offset


@pytest.mark.parametrize(
    ("text", "message", "offset", "hint"),
    [
        ("__import__('os')", "this is not a formula", 0, ""),
        ("a.b", "this is not a formula", 1, ""),
        ("a[0]", "this is not a formula", 1, ""),
        ("lambda x: x", "this is not a formula", 8, ""),
        ("import os", "this is not a formula", 0, ""),
        ("'a'", "this is not a formula", 0, ""),
        ("a; b", "this is not a formula", 1, ""),
        ("x__y", "this is not a formula", 0, ""),
        ("sine(x)", "no function 'sine'", 0, "did you mean sin?"),
        ("arctan2(y, x)", "no function", 0, "did you mean atan2?"),
        ("I_a(s)", "reads as a function", 0, "write I_a alone"),
        ("L(a + b)", "no function 'L'", 0, "write L*(...)"),
        ("sin x", "'sin' is a function", 0, "sin(x)"),
        ("atan2(x)", "takes 2 arguments", 0, ""),
        ("2 3", "a sign is missing", 2, ""),
        ("a +", "ends too early", 3, ""),
        ("", "a formula is missing", 0, ""),
        ("(a", "never closed", 0, ""),
        ("a)", "')' cannot stand here", 1, ""),
        ("1..2", "one decimal point", 2, ""),
        ("1/0", "division by zero", 1, ""),
        ("a*", "a star marks a joint variable", 1, ""),
        ("a == b", "'=' cannot stand here", 2, ""),
    ],
)  # fmt: skip
def test_fault(text: str, message: str, offset: int, hint: str) -> None:
    with pytest.raises(FormulaError) as caught:
        parse(text)
    assert message in caught.value.message
    assert caught.value.offset == offset
    assert hint in caught.value.hint


@pytest.mark.parametrize(
    "text",
    [
        "a" * 2001, "9" * 41, "1e100", "(" * 100 + "a" + ")" * 100, "-" * 100 + "a", "a/" * 200 + "b",
        "a^65", "9^9^9", "(a+b+c+d+e+f)^60", "((a+b)^60)^60", "(a+b)" * 20, "2^2^2^2^2^2",
    ],
)  # fmt: skip
def test_bombs_are_refused(text: str) -> None:
    with pytest.raises(FormulaError):
        parse(text)


@pytest.mark.parametrize(
    ("text", "tree", "variable"),
    [
        ("theta1*", Symbol("theta1"), "theta1"),
        ("theta1 *", Symbol("theta1"), "theta1"),
        ("theta2* + 90 deg", Sum((Symbol("theta2"), Degrees(Fraction(90)))), "theta2"),
        ("theta2*-90 deg", Sum((Symbol("theta2"), Degrees(Fraction(-90)))), "theta2"),
        ("-q* + pi/2", Sum((Product((MINUS, Symbol("q"))), Quotient(PI, TWO))), "q"),
        ("a*b", Product((a, b)), None),
        ("a* b", Product((a, b)), None),
        ("0", number(0), None),
    ],
)  # fmt: skip
def test_star(text: str, tree: Expr, variable: str | None) -> None:
    assert parse_starred(text, dimension=ANGLE) == (tree, variable)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a* + b*", "two stars"),
        ("2*theta1*", "a term of its own"),
        ("cos(q*)", "a term of its own"),
        ("q* + q", "a term of its own"),
    ],
)
def test_wrong_star(text: str, message: str) -> None:
    with pytest.raises(FormulaError, match=message):
        parse_starred(text, dimension=ANGLE)


def test_equation() -> None:
    assert parse_equation("a = b*s + 2 c") == (a, Sum((Product((b, s)), Product((TWO, c)))))


@pytest.mark.parametrize("text", ["a", "a =", "a = b = c", "= a", "a == b"])
def test_wrong_equation(text: str) -> None:
    with pytest.raises(FormulaError):
        parse_equation(text)


@given(st.text(alphabet="ab2m .*/^+-()=,θ°'_e", max_size=30))
def test_any_text_is_a_tree_or_a_fault(text: str) -> None:
    for read in (parse, parse_starred, parse_equation):
        try:
            read(text, dimension=LENGTH)
        except FormulaError as error:
            assert 0 <= error.offset <= len(text)


@pytest.mark.parametrize(("text", "unit"), [("100 mm", "m"), ("-0.1 m", "m"), ("0.1", ""), ("2 kg", "kg")])
def test_a_number_remembers_its_unit(text: str, unit: str) -> None:
    tree = parse(text, dimension="any")
    assert isinstance(tree, Number)
    assert tree.unit == unit


@pytest.mark.parametrize("text", ["3 ft", "2 Nm", "90 degrees", "5 lb"])
def test_a_foreign_unit_is_no_symbol(text: str) -> None:
    with pytest.raises(FormulaError, match="is not known") as caught:
        parse(text, dimension="any")
    assert re.match(r"the units are m, mm|did you mean (deg|N m)\?", caught.value.hint)
    assert parse(text, dimension="any", names=frozenset({text.split()[1]})) == parse(text.replace(" ", "*"))


@pytest.mark.parametrize(("typed", "hint"), [("d3'", "d3_dot"), ("m*(d3'' - 1)", "d3_ddot"), ("x′", "x_dot")])
def test_a_prime_is_told_how_a_derivative_is_written(typed: str, hint: str) -> None:
    with pytest.raises(FormulaError) as caught:
        parse(typed)
    assert caught.value.hint.endswith(hint)
