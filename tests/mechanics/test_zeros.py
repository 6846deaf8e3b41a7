"""Each value at which an equation vanishes is put back into it."""

from __future__ import annotations

import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.algebra.readable.form import readable
from derive.algebra.substitution import pinned
from derive.mechanics.zeros import zeros

VARIABLES = ("q1", "q2", "q3", "d4")
AT = {"q1": 0.4, "q2": 0.9, "q3": 1.7, "a": 0.8, "b": 1.3, "c": 0.6, "d4": 0.2}


@pytest.mark.parametrize(
    ("equation", "rule", "count"),
    [
        ("a sin(q2)", "sine", 2),
        ("a cos(q2)", "cosine", 2),
        ("1 - cos(q1)", "turn", 1),
        ("1 + cos(q1)", "turn", 1),
        ("a cos(q1) + b sin(q1)", "direction", 2),
        ("sin(q2 + q3)", "sum", 2),
        ("cos(q2 + q3)", "sum", 2),
        ("a cos(q2) + b cos(q2 + q3)", "direction", 2),
        ("a cos(q1) + b sin(q1) - c", "triangle", 2),
        ("b cos(q1) - c", "triangle", 2),
        ("a d4 + b", "slide", 1),
        ("a d4 - b sin(q1)", "slide", 1),
    ],
)
def test_the_value_solves_the_equation(equation: str, rule: str, count: int) -> None:
    tree = parse(equation)
    found = zeros(normal(tree), VARIABLES, readable)
    assert [zero.rule for zero in found] == [rule] * count
    for zero in found:
        at = {**AT, zero.variable: number(zero.value, AT)}
        assert number(tree, at) == pytest.approx(0, abs=1e-12)
        assert not pinned(normal(tree), zero.variable, zero.at)


def test_what_no_sub_problem_fits_is_left_alone() -> None:
    assert zeros(normal(parse("a sin(q1) + b sin(q1)^2 + c")), VARIABLES, readable) is None


def test_a_constant_has_no_zeros() -> None:
    assert zeros(normal(parse("a + b")), VARIABLES, readable) == ()
