"""What a listener is told of a formula, as one says it at the board."""

from __future__ import annotations

import pytest

from derive.expression import (
    Expr,
    Indexed,
    Matrix,
    Quotient,
    Symbol,
    atan2,
    cos,
    number,
    sqrt,
    squared,
    symbols,
)
from derive.render.aloud import aloud
from derive.render.formula.spoken import spoken, words
from derive.render.formula.tex import boxes
from derive.render.latex import latex
from derive.render.layout import Display, Link
from derive.render.notation import Notation
from tests.render.shapes import nested

x, y, r, phi, theta1, T_10, r_12 = symbols("x y r phi theta1 T_1^0 r_12")
TOLD: dict[str, Expr] = {
    "theta 1 equals the arctangent of y over x": atan2(y, x),
    "theta 1 equals r 1 2 squared": squared(r_12),
    "theta 1 equals cap T 1 upper 0": T_10,
    "theta 1 equals the square root of x squared plus y squared end root": sqrt(squared(x) + squared(y)),
    "theta 1 equals the fraction x plus y over r end fraction": Quotient(x + y, r),
    "theta 1 equals 1 over 2": number("1/2"),
    "theta 1 equals cosine phi": cos(phi),
    "theta 1 equals the 2 by 2 matrix row 1: x, minus y; row 2: y, x end matrix": Matrix(((x, -y), (y, x))),
    "theta 1 equals the column x, y end column": Matrix(((x,), (y,))),
    "theta 1 equals cap R sub z, phi end sub": Indexed("R", (Symbol("z"), phi)),
}
TYPED = {
    r"\dot{\theta}_1": "theta 1 dot",
    r"R^T R = I": "cap R transpose cap R equals cap I",
    r"J^{-1}": "cap J inverse",
    r"T_1^0": "cap T 1 upper 0",
    r"\lvert x \rvert \leq 1": "the absolute value of x end absolute value is at most 1",
    r"\sum_{i=1}^{n} m_i": "the sum from i equals 1 to n m i",
    r"0_{3 \times 1}": "0 3 by 1",
    r"90^\circ": "90 degrees",
    r"a = 1 \qquad b = -2": "a equals 1; b equals minus 2",
    r"l_{cl} l": "l sub c l end sub l",
    r"\frac{2}{a b}": "the fraction 2 over a b end fraction",
    r"\frac{\partial f}{\partial x}": "partial f over partial x",
}


@pytest.mark.parametrize("said", TOLD)
def test_a_tree_is_told(said: str) -> None:
    written, name = latex(TOLD[said], Notation()), latex(theta1, Notation())
    chain = (Link("=", name, theta1), Link("=", written, TOLD[said]))
    assert aloud(Display((f"{name} = {written}",), chains=(chain,))) == said


@pytest.mark.parametrize("typed", TYPED)
def test_what_was_typed_is_told(typed: str) -> None:
    assert spoken(boxes(typed)) == TYPED[typed]


def test_different_trees_sound_different() -> None:
    """And nothing of TeX is left in what is said."""
    heard: dict[str, str] = {}
    for _, tree in nested():
        written = latex(tree, Notation())
        said = aloud(Display((written,), chains=((Link("=", written, tree),),)))
        assert not set(said) & set("\\{}^_$&")
        assert heard.setdefault(said, written) == written
    assert len(heard) > 400


def test_every_word_is_said_in_the_language_of_the_templates() -> None:
    assert words()["="] == "equals"
    assert all(line.strip() for line in words().values())
