"""Rank and null spaces against NumPy's, at random points."""

from __future__ import annotations

import numpy as np
import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import matrix_numbers
from derive.algebra.solving.row_reduction import column_space, null_space, rank

AT = {"q1": 0.3, "q2": 1.1, "a": 0.7, "b": 1.3}
MATRICES = [
    [["-a sin(q1)", "-b sin(q1)"], ["a cos(q1)", "b cos(q1)"]],
    [["a sin(q1)", "b", "1"], ["cos(q1)", "sin(q2)", "a b"]],
    [["1", "0"], ["0", "1"], ["1", "1"]],
    [["0", "0"], ["0", "0"]],
    [["cos(q1)", "sin(q1)", "cos(q1 + q2)"], ["-sin(q1)", "cos(q1)", "-sin(q1 + q2)"], ["0", "0", "0"]],
]


def matrix(rows: list[list[str]]) -> ScalarMatrix:
    return ScalarMatrix.of([normal(parse(entry)) for entry in row] for row in rows)


@pytest.mark.parametrize("rows", MATRICES)
def test_the_rank_is_that_of_numpy(rows) -> None:
    found = matrix(rows)
    assert rank(found) == np.linalg.matrix_rank(np.array(matrix_numbers(found, AT)))


@pytest.mark.parametrize("rows", MATRICES)
def test_null_vectors_are_mapped_to_zero(rows) -> None:
    found = matrix(rows)
    basis = null_space(found, ("q1", "q2"))
    assert len(basis) == found.shape[1] - rank(found)
    for x in basis:
        assert not found @ x
        assert all(entry.denominator is None for entry in x.entries)


@pytest.mark.parametrize("rows", MATRICES)
def test_the_range_has_as_many_directions_as_the_rank(rows) -> None:
    found = matrix(rows)
    spanned = column_space(found, ("q1", "q2"))
    whole = np.array(matrix_numbers(found, AT))
    for x in spanned:
        both = np.hstack([whole, np.array(matrix_numbers(x, AT))])
        assert np.linalg.matrix_rank(both) == rank(found)
    assert len(spanned) == rank(found)
