"""The rotation that fits points, in numbers and exactly."""

from __future__ import annotations

import numpy
import pytest
from scipy.spatial.transform import Rotation

from derive.algebra.matrix import ScalarMatrix
from derive.mechanics.fitting import by_quaternion, by_singular_values, collinear, exact_rotation, residual


@pytest.mark.parametrize("seed", range(5))
def test_two_routes_to_the_same_rotation(seed: int) -> None:
    draw = numpy.random.default_rng(seed)
    a = draw.normal(size=(6, 3))
    b = a @ Rotation.random(random_state=seed).as_matrix().T + 0.1 * draw.normal(size=(6, 3))
    H = (a.T @ b).tolist()
    theirs, _ = Rotation.align_vectors(b, a)
    assert numpy.allclose(by_singular_values(H).R, theirs.as_matrix())
    assert numpy.allclose(by_quaternion(H), theirs.as_matrix())


def test_a_mirrored_set_is_told() -> None:
    fit = by_singular_values([[3.0, 0, 0], [0, 2.0, 0], [0, 0, -1.0]])
    assert fit.det == -1
    assert fit.is_unique
    assert numpy.allclose(fit.R, numpy.eye(3))


@pytest.mark.parametrize(
    ("H", "unique"),
    [
        ([[1.0, 0, 0], [0, 0, 0], [0, 0, 0]], False),  # a line
        ([[2.0, 0, 0], [0, 1.0, 0], [0, 0, 0]], True),  # a plane
        ([[2.0, 0, 0], [0, 1.0, 0], [0, 0, -1.0]], False),  # mirrored, and two directions cost the same
    ],
)
def test_whether_another_rotation_fits_as_well(H: list[list[float]], unique: bool) -> None:
    assert by_singular_values(H).is_unique is unique


def points(*rows: tuple[int, ...]) -> list[ScalarMatrix]:
    return [ScalarMatrix.column(row) for row in rows]


def test_the_exact_rotation() -> None:
    a, b = points((1, 0, 0), (0, 2, 0), (-1, -2, 0)), points((0, 1, 0), (-2, 0, 0), (2, -1, 0))
    found = exact_rotation(a, b)
    assert found is not None
    assert found == ScalarMatrix.of([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    assert exact_rotation(a, points((0, 1, 0), (-3, 0, 0), (2, -1, 0))) is None


def test_points_on_a_line() -> None:
    assert collinear(points((1, 2, 3), (-2, -4, -6), (0, 0, 0)))
    assert not collinear(points((1, 2, 3), (-2, -4, -5)))
    assert not collinear(points((1, 2), (2, 4)))
    assert collinear(points((0, 0), (0, 0)))


def test_what_is_left_over() -> None:
    assert residual(numpy.eye(2), [1, 0], [[0, 0], [1, 1]], [[1, 0], [2, 2]]) == pytest.approx(0.5**0.5)
