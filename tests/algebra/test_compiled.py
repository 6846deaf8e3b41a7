"""Compiled trees against the plain evaluation."""

from __future__ import annotations

import math

import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import number
from derive.errors import NotDerivable
from derive.expression import Degrees, Matrix, Sum, Symbol, sqrt, subtract
from derive.expression import number as exact

AT = {"x": 0.7, "y": -1.3, "a": 2.0}


@pytest.mark.parametrize(
    "text",
    ["x^2 + y*a - 3/4", "atan2(y, x) - sqrt(a)", "cos(x)*sin(y)/a", "pi*x", "x^(1/2)", "abs(y) + exp(x)"],
)
def test_the_same_values(text) -> None:
    tree = parse(text)
    assert math.isclose(compiled(tree)(AT), number(tree, AT), rel_tol=1e-15)


def test_degrees() -> None:
    assert math.isclose(compiled(Degrees(exact(90).value))({}), math.pi / 2)


def test_a_shared_part_is_computed_once() -> None:
    calls = []

    class Counting(dict[str, float]):
        def __getitem__(self, name: str) -> float:
            calls.append(name)
            return 1.0

    shared = Symbol("x")
    assert compiled(Sum((shared, shared, shared)))(Counting()) == 3.0
    assert calls == ["x"]


def test_a_root_of_nearly_zero() -> None:
    root = compiled(sqrt(subtract(Symbol("x"), exact(1))))
    assert root({"x": 1 - 1e-12}) == 0.0
    with pytest.raises(ValueError, match="math domain error"):
        root({"x": 0.9})


def test_a_name_without_a_value() -> None:
    with pytest.raises(KeyError):
        compiled(Symbol("z"))(AT)


def test_a_matrix_has_no_number() -> None:
    with pytest.raises(NotDerivable):
        compiled(Matrix(((exact(1),),)))
