"""All conventions against SciPy, both ways."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.algebra.numbers.floats import matrix_numbers, number
from derive.mechanics.euler import SIGNS, Convention, Euler

NAMES = ("phi", "theta", "psi")
TWELVE = ["".join(axes) for axes in product("XYZ", repeat=3) if axes[1] not in (axes[0], axes[2])]
CONVENTIONS = [*TWELVE, *map(str.lower, TWELVE)]
ANGLES = [(0.3, 0.8, -1.1), (-2.5, 2.0, 0.4), (1.0, -0.7, 3.0)]


def entries(R):
    return {f"r_{i + 1}{j + 1}": float(R[i][j]) for i in range(3) for j in range(3)}


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_matrix_is_scipys(convention):
    euler = Euler(Convention.of(convention), NAMES)
    for angles in ANGLES:
        ours = matrix_numbers(euler.matrix, dict(zip(NAMES, angles, strict=True)))
        assert np.allclose(ours, Rotation.from_euler(convention, angles).as_matrix())


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_both_regular_branches_give_the_rotation_back(convention):
    euler = Euler(Convention.of(convention), NAMES)
    R = Rotation.random(random_state=7).as_matrix()
    for sign in SIGNS:
        angles = [number(value, entries(R)) for value in euler.regular(sign).values()]
        assert np.allclose(Rotation.from_euler(convention, angles).as_matrix(), R)


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_the_first_branch_is_scipys(convention):
    """SciPy's middle angle is where the common factor is positive."""
    euler = Euler(Convention.of(convention), NAMES)
    R = Rotation.random(random_state=11)
    angles = [number(value, entries(R.as_matrix())) for value in euler.regular(1).values()]
    assert np.allclose(angles, R.as_euler(convention))


@pytest.mark.parametrize("convention", CONVENTIONS)
@pytest.mark.parametrize("sign", SIGNS)
def test_singular_branches_give_the_rotation_back(convention, sign):
    euler = Euler(Convention.of(convention), NAMES)
    case = euler.singular(sign)
    middle = number(case.middle, {})
    R = Rotation.from_euler(convention, (0.4, middle, 1.3)).as_matrix()
    assert math.isclose(R[euler.middle.row, euler.middle.col], case.entry)
    point = {**entries(R), euler.outer[2]: -0.9}
    angles = [number(value, point) for value in euler.singular_angles(case).values()]
    assert np.allclose(Rotation.from_euler(convention, angles).as_matrix(), R)


@pytest.mark.parametrize("text", ["ZZX", "ZYx", "abc", "ZY", ""])
def test_no_convention(text):
    with pytest.raises(ValueError):
        Convention.of(text)
