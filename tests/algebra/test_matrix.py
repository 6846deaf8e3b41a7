from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import matrix_numbers, scalar_number
from tests.trees import formula, matrix, points

entries = st.fractions(min_value=-5, max_value=5, max_denominator=6)


def squares(most: int = 4) -> st.SearchStrategy[list[list[Fraction]]]:
    return st.integers(1, most).flatmap(
        lambda n: st.lists(st.lists(entries, min_size=n, max_size=n), min_size=n, max_size=n)
    )


def exact(rows: list[list[Fraction]]) -> sympy.Matrix:
    return sympy.Matrix([[sympy.Rational(x.numerator, x.denominator) for x in row] for row in rows])


def same(ours: ScalarMatrix, theirs: sympy.Matrix) -> bool:
    return ours == ScalarMatrix.of(
        [Fraction(int(x.p), int(x.q)) for x in theirs.row(i)] for i in range(theirs.shape[0])
    )


@given(squares())
def test_determinant_adjugate_and_inverse_are_those_of_sympy(rows: list[list[Fraction]]) -> None:
    ours, theirs = ScalarMatrix.of(rows), exact(rows)
    assert ours.det().constant == Fraction(str(theirs.det()))
    assert same(ours.adjugate(), theirs.adjugate())
    if theirs.det():
        assert same(ours.inverse(), theirs.inv())
    else:
        with pytest.raises(ZeroDivisionError):
            ours.inverse()


@given(squares(3), squares(3))
def test_products_and_transposes_are_those_of_sympy(a: list[list[Fraction]], b: list[list[Fraction]]) -> None:
    size = min(len(a), len(b))
    a, b = [row[:size] for row in a[:size]], [row[:size] for row in b[:size]]
    assert same(ScalarMatrix.of(a) @ ScalarMatrix.of(b), exact(a) * exact(b))
    assert same((ScalarMatrix.of(a) + ScalarMatrix.of(b)).T, (exact(a) + exact(b)).T)
    assert same(ScalarMatrix.of(a) - ScalarMatrix.of(b).scaled(3), exact(a) - 3 * exact(b))


@given(st.lists(entries, min_size=3, max_size=3), st.lists(entries, min_size=3, max_size=3))
def test_the_vector_product_is_that_of_numpy(a: list[Fraction], b: list[Fraction]) -> None:
    found = ScalarMatrix.column(a).cross(ScalarMatrix.column(b))
    expected = np.cross([float(x) for x in a], [float(x) for x in b])
    assert np.allclose([float(x.constant or 0) for x in found.entries], expected)


SYMBOLIC = normal_matrix(matrix("cos(x); -sin(x); a\n sin(x); cos(x); b cos(y)\n a/(1 + b^2); sin(x + y); 2"))


def test_a_symbolic_determinant_and_inverse_in_numbers() -> None:
    for at in points(formula("a + b + x + y")):
        numbers = np.array(matrix_numbers(SYMBOLIC, at))
        assert np.isclose(scalar_number(SYMBOLIC.det(), at), np.linalg.det(numbers))
        assert np.allclose(matrix_numbers(SYMBOLIC.inverse(), at), np.linalg.inv(numbers))


def test_a_symbolic_inverse_inverts() -> None:
    assert SYMBOLIC @ SYMBOLIC.inverse() == ScalarMatrix.identity(3)
    assert (SYMBOLIC @ SYMBOLIC).det() == SYMBOLIC.det() ** 2
    assert SYMBOLIC.T.T == SYMBOLIC


def test_derivatives_go_entry_by_entry() -> None:
    R = normal_matrix(matrix("cos(x); -sin(x)\n sin(x); cos(x)"))
    assert R.diff("x") @ R.T == normal_matrix(matrix("0; -1\n 1; 0"))


def test_parts_of_a_matrix() -> None:
    assert SYMBOLIC.shape == (3, 3)
    assert SYMBOLIC.columns(2, 0).shape == (3, 2)
    assert SYMBOLIC.columns(2)[1, 0] == normal(formula("b cos(y)"))
    assert SYMBOLIC.minor(0, 0).shape == (2, 2)
    assert ScalarMatrix.beside([SYMBOLIC.columns(0), SYMBOLIC.columns(1, 2)]) == SYMBOLIC
    halves = [SYMBOLIC.block(slice(0, 1), slice(None)), SYMBOLIC.block(slice(1, 3), slice(None))]
    assert ScalarMatrix.stacked(halves) == SYMBOLIC


def test_shapes_that_differ_are_not_equal() -> None:
    assert ScalarMatrix.zeros(2, 3) != ScalarMatrix.zeros(3, 2)
    assert not ScalarMatrix.zeros(2, 3)
    assert ScalarMatrix.identity(2) != 1
    with pytest.raises(TypeError):
        hash(SYMBOLIC)


def test_substitution() -> None:
    found = SYMBOLIC.substitute({"a": normal(formula("cos(y)")), "b": normal(formula("0"))})
    assert found[2, 0] == normal(formula("cos(y)"))
    assert found[1, 2] == 0
