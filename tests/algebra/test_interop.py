"""Into SymPy and back, against SymPy's own numbers and equality by normal form."""

from __future__ import annotations

import subprocess
import sys

import pytest
import sympy

from derive.algebra.formulas.grammar import parse
from derive.algebra.interop import from_sympy, to_sympy
from derive.algebra.normal import normal, normal_matrix
from derive.errors import NotDerivable
from derive.expression import Indexed, Matrix, Symbol

FORMULAS = [
    "a*cos(x + y)^2 - 2*b/(3 + a)",
    "sqrt(a^2 + b^2)*sin(2*x) - sin(30 deg)",
    "atan2(b, a) + abs(a - b)",
    "0.25*exp(a) + 3/4",
    "sqrt(3)/2 + pi*a",
    "a^(-2) + (a + b)^3",
]


@pytest.mark.parametrize("formula", FORMULAS)
def test_there_and_back_is_the_same_by_normal_form(formula: str) -> None:
    tree = parse(formula)
    assert normal(from_sympy(to_sympy(tree))) == normal(tree)
    assert normal(from_sympy(to_sympy(normal(tree)))) == normal(tree)


@pytest.mark.parametrize("formula", FORMULAS)
def test_the_numbers_are_sympys(formula: str) -> None:
    from derive.algebra.numbers.floats import number

    point = {"a": 0.7, "b": 1.3, "x": 0.4, "y": 1.1}
    theirs = to_sympy(parse(formula)).subs({sympy.Symbol(n, real=True): v for n, v in point.items()})
    assert float(theirs) == pytest.approx(number(parse(formula), point))


def test_what_sympy_rewrites_is_still_equal() -> None:
    x, a = sympy.symbols("x a", real=True)
    assert normal(from_sympy(sympy.sin(x) ** 2)) == normal(from_sympy((1 - sympy.cos(2 * x)) / 2))
    assert normal(from_sympy(sympy.expand((a + x) ** 3))) == normal(parse("(a + x)^3"))
    assert normal(from_sympy(a ** sympy.Rational(3, 2))) == normal(parse("a*sqrt(a)"))


def test_matrices() -> None:
    rotation = Matrix(((parse("cos(t)"), parse("-sin(t)")), (parse("sin(t)"), parse("cos(t)"))))
    theirs = to_sympy(rotation)
    assert sympy.trigsimp(theirs.T * theirs) == sympy.eye(2)
    assert normal_matrix(from_sympy(theirs)) == normal_matrix(rotation)


def test_what_has_no_counterpart_is_said() -> None:
    with pytest.raises(NotDerivable, match="zeta"):
        from_sympy(sympy.zeta(sympy.Symbol("s")))
    with pytest.raises(NotDerivable, match="Indexed"):
        to_sympy(Indexed("R", (Symbol("x"),)))


def test_a_build_does_not_import_sympy() -> None:
    code = (
        "import sys; from pathlib import Path; from derive.build import build;"
        "build([Path('exercises/week6.yaml')], ['md', 'tex', 'json'], None); sys.exit('sympy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
