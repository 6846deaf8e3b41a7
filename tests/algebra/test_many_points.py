"""Polynomials in floats at many points, against their exact values."""

from __future__ import annotations

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.numbers.many_points import Polynomials


def test_values_are_those_of_the_normal_form() -> None:
    values = [normal(parse(each)) for each in ("a*cos(q)^2 - b*sin(q + p)", "sqrt(2)*a + 3", "0", "cos(p)")]
    quick = Polynomials.of(values)
    for point in ({"a": 0.3, "b": 1.1, "q": 0.4, "p": -2.0}, {"a": 2.0, "b": -1.0, "q": 3.0, "p": 0.1}):
        found = quick.at(point)
        assert all(
            abs((one or 0.0) - scalar_number(v, point)) < 1e-14 for one, v in zip(found, values, strict=True)
        )


def test_what_has_no_value_is_none() -> None:
    quick = Polynomials.of([normal(parse("a*b")), normal(parse("a + 1"))])
    assert quick.at({"a": 2.0}) == [None, 3.0]
