"""Unit vectors of symbolic directions: of length 1, along the vector, and as short as a person has them."""

from __future__ import annotations

import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from derive.algebra.solving.unit_vectors import unit

SHORT = {
    ("0", "-L", "0"): ("0", "-1", "0"),
    ("3*L", "0", "4*L"): ("3/5", "0", "4/5"),
    ("1", "1", "0"): ("sqrt(2)/2", "sqrt(2)/2", "0"),
    ("(L - c)*sin(beta)^2", "0", "(c - L)*cos(beta)*sin(beta)"): ("sin(beta)", "0", "-cos(beta)"),
    ("a/b", "0", "0"): ("1", "0", "0"),
    ("cos(q)", "sin(q)", "0"): ("cos(q)", "sin(q)", "0"),
}


def column(entries: tuple[str, ...]) -> ScalarMatrix:
    return ScalarMatrix.column([normal(parse(entry)) for entry in entries])


@pytest.mark.parametrize("typed", SHORT)
def test_short(typed: tuple[str, ...]) -> None:
    found = unit(column(typed))
    assert found == column(SHORT[typed])
    assert [len(text(readable(entry))) for entry in found.entries] == [len(each) for each in SHORT[typed]]


@pytest.mark.parametrize("typed", [*SHORT, ("a", "b", "c"), ("a + b", "2*a", "1"), ("a/b", "b/a", "1")])
def test_a_unit_vector_along_it(typed: tuple[str, ...]) -> None:
    vector = column(typed)
    found = unit(vector)
    assert (found.T @ found)[0, 0] == 1
    assert not vector.cross(found)
