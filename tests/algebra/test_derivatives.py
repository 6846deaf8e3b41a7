"""Derivatives through functions of functions, against SymPy."""

from __future__ import annotations

import random

import pytest
import sympy

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.algebra.readable.form import readable
from derive.errors import NotDerivable
from derive.expression import Derivative, Expr, Symbol
from tests.trees import sympy_of

X = Symbol("x")
AT = {"x": 0.8, "y": 1.7, "t": 0.4}
TEXTS = [
    "exp(2*x)", "log(x*y)", "atan(x^2)", "asin(x/3)", "acos(x/3)", "atan2(y, x^2)", "exp(log(1 + x^2))",
    "x*exp(x)*log(y)", "exp(x)/log(1 + x)", "sin(cos(x))", "cos(exp(x))", "sin(sqrt(x^2 + y^2))", "sin(x/y)",
    "cos(1/x + 1/(x + y))", "sin(y*sin(x*t))", "x^(1/3)", "(x^2 + y)^(5/3)", "2^x", "x^x", "x^(y/2 + 1)",
    "tan(sin(x))", "sqrt(1 + cos(x)^2)", "sqrt(1 + sin(sin(x)))", "abs(sin(x) - 2)", "sin(x + exp(-x))^2",
]  # fmt: skip


@pytest.mark.parametrize("text", TEXTS)
def test_it_is_what_sympy_says(text: str) -> None:
    assert _is_sympys(parse(text))


def _is_sympys(tree: Expr) -> bool:
    x = sympy.Symbol("x", real=True)
    names = {sympy.Symbol(name, real=True): here for name, here in AT.items()}
    ours = readable(normal(Derivative(tree, X)))
    theirs = complex(sympy_of(tree).diff(x).subs(names).evalf())
    return number(ours, AT) == pytest.approx(theirs.real, rel=1e-8, abs=1e-8)


def _random_text(draw: random.Random, depth: int) -> str:
    """Positive everywhere that matters, so that every root and logarithm is real."""
    if depth == 0:
        return draw.choice(["x", "y", "t", "2", "0.3", "x"])
    inner = [_random_text(draw, depth - 1) for _ in range(2)]
    form = draw.choice(
        ["({0} + {1})", "({0} - {1})", "({0})*({1})", "({0})/(2 + sin({1}))", "sin({0})", "cos({0})",
         "exp(sin({0}))", "sqrt(1 + ({0})^2)", "log(2 + cos({0}))", "atan({0})", "(1 + ({0})^2)^(1/3)"]
    )  # fmt: skip
    return form.format(*inner)


@pytest.mark.parametrize("seed", range(60))
def test_random_functions_of_functions(seed: int) -> None:
    assert _is_sympys(parse(_random_text(random.Random(seed), 3)))


def test_equal_powers_are_equal() -> None:
    for left, right in [
        ("x^(1/3) x^(2/3)", "x"), ("2^(x + 1)", "2*2^x"), ("2^(-x)", "1/2^x"), ("(2^x)^2", "2^(2*x)"),
        ("12^(1/3)", "2^(2/3)*3^(1/3)"), ("(8/27)^(1/3)", "2/3"), ("x^(1/6)", "sqrt(x^(1/3))"),
    ]:  # fmt: skip
        assert normal(parse(left)) == normal(parse(right)), left


def test_equal_arguments_in_different_angles_are_equal() -> None:
    assert normal(parse("cos(sin(x + y))")) == normal(parse("cos(sin(x) cos(y) + cos(x) sin(y))"))


def test_what_has_no_rule_says_so() -> None:
    with pytest.raises(NotDerivable, match="sign"):
        normal(Derivative(parse("sign(x)"), X))
