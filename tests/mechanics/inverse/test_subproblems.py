"""The named sub-problems, each recognised in a hand-made equation."""

from __future__ import annotations

import pytest

from derive.algebra.angles import Form
from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.mechanics.inverse.paul import Between, Equation
from derive.mechanics.inverse.subproblems import (
    TrigEquation,
    elbow,
    reach,
    slide,
    split,
    trig_equation,
    two_equations,
)

Q = Form.of({"q": 1})
SOMEWHERE = Equation(Between(0, None), 0, 3, Scalar.of(0), Scalar.of(0))


def row(text: str) -> TrigEquation | None:
    return trig_equation(normal(parse(text)), Q, SOMEWHERE)


def test_one_equation() -> None:
    found = row("a*cos(q) - 2*b*sin(q) - c")
    assert found is not None
    assert (found.a, found.b, found.c) == (normal(parse("a")), normal(parse("-2*b")), normal(parse("c")))


@pytest.mark.parametrize("text", ["a - b", "cos(q)^2 - a", "cos(q)*sin(q) - a"])
def test_what_is_not_of_that_form(text) -> None:
    value = normal(parse(f"{text} + 0*cos(q)")) + normal(parse("cos(q)")) - normal(parse("cos(q)"))
    home = value.ring.union(normal(parse("cos(q)")).ring)
    assert trig_equation(value.into(home), Q, SOMEWHERE) is None


@pytest.mark.parametrize(
    ("first", "second", "kind"),
    [
        ("d*cos(q) - x", "d*sin(q) - y", "direction"),
        ("d*sin(q) - y", "h*cos(q) - x", "direction"),
        ("k*cos(q) - m*sin(q) - x", "m*cos(q) + k*sin(q) - y", "difference"),
        ("k*cos(q) - m*sin(q) - x", "y - m*cos(q) - k*sin(q)", "difference"),
        ("k*cos(q) + m*sin(q) - x", "n*cos(q) + k*sin(q) - y", "determinant"),
    ],
)
def test_two_equations(first, second, kind) -> None:
    rows = row(first), row(second)
    assert rows[0] and rows[1]
    found = two_equations(Q, rows[0], rows[1])
    assert found.method == kind
    assert found.determinant


UNKNOWN = frozenset({"cos(p)", "sin(p)", "cos(q)", "sin(q)", "d"})


def parts(*texts: str):
    return tuple(split(SOMEWHERE, normal(parse(text)), UNKNOWN) for text in texts)


def test_the_law_of_cosines() -> None:
    found = elbow(Q, parts("a*cos(p) + b*cos(p)*cos(q) - b*sin(p)*sin(q) - x + h",
                           "a*sin(p) + b*sin(p)*cos(q) + b*cos(p)*sin(q) - y"), UNKNOWN)  # fmt: skip
    assert found is not None
    assert [part.known for part in found.coordinates] == [normal(parse("x - h")), normal(parse("y"))]
    assert found.row.a == normal(parse("2*a*b"))
    assert found.row.b == 0
    assert -found.row.c == normal(parse("a^2 + b^2"))


def test_two_angles_do_not_go_by_squares() -> None:
    assert elbow(Q, parts("a*cos(p) + b*cos(q) - x", "c*sin(p) + b*sin(q) - y"), UNKNOWN) is None


def test_the_length_of_a_slide() -> None:
    found = reach("d", parts("d*cos(p) - h*sin(p) - x", "d*sin(p) + h*cos(p) - y"), UNKNOWN)
    assert found is not None
    assert (found.square, found.linear) == (Scalar.of(1), Scalar.of(0))
    assert found.constant == normal(parse("h^2"))


def test_a_linear_slide() -> None:
    found = slide(normal(parse("2*d*sin(a) - z + h")), "d", SOMEWHERE)
    assert found is not None
    assert found.slope == normal(parse("2*sin(a)"))
    assert found.value == normal(parse("z - h"))
    assert slide(normal(parse("d^2 - z")), "d", SOMEWHERE) is None
