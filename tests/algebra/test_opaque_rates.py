"""Derivatives through exp, log and the inverse functions, against SymPy."""

from __future__ import annotations

import pytest
import sympy

from derive.algebra.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numeric import number
from derive.algebra.readable import readable
from derive.errors import NotDerivable
from derive.expression import Derivative, Symbol
from tests.trees import sympy_of

X = Symbol("x")
TEXTS = [
    "exp(2*x)", "log(x*y)", "atan(x^2)", "asin(x/3)", "acos(x/3)", "atan2(y, x^2)", "exp(log(1 + x^2))",
    "x*exp(x)*log(y)", "exp(x)/log(1 + x)",
]  # fmt: skip


@pytest.mark.parametrize("text", TEXTS)
def test_it_is_what_sympy_says(text: str) -> None:
    at = {"x": 0.8, "y": 1.7}
    ours = readable(normal(Derivative(parse(text), X)))
    names = {sympy.Symbol(name, real=True): here for name, here in at.items()}
    theirs = sympy_of(parse(text)).diff(sympy.Symbol("x", real=True)).subs(names)
    assert number(ours, at) == pytest.approx(float(theirs))


def test_what_has_no_rule_says_so() -> None:
    with pytest.raises(NotDerivable, match="sign"):
        normal(Derivative(parse("sign(x)"), X))
