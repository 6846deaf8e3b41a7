"""Rotations rounded to so many places, against SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.algebra.formulas.grammar import parse
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.sheet.nearest import nearest_rotation


@pytest.mark.parametrize("places", [3, 4, 6, 8, 12, 16])
@pytest.mark.parametrize("seed", range(6))
def test_the_nearest_rotation(seed: int, places: int) -> None:
    R = Rotation.random(random_state=seed).as_matrix()
    if seed == 0:
        R = Rotation.from_rotvec([0, 0, np.pi]).as_matrix()
    typed = [[f"{entry:.{places}f}" for entry in column] for column in R.T]
    axes, found = nearest_rotation([tuple(map(parse, axis)) for axis in typed], {})
    assert found <= places
    U, _, V = np.linalg.svd(np.array(typed, dtype=float).T)
    ours = np.array([[number(entry, {}) for entry in axis] for axis in axes]).T
    assert np.abs(ours - U @ V).max() < 1e-11
    exact = ScalarMatrix.of([[normal(entry) for entry in axis] for axis in axes])
    assert exact @ exact.T == ScalarMatrix.identity(3)
    assert exact.det() == 1


@pytest.mark.parametrize(
    "rows",
    [
        [["0.87", "0.5", "0"], ["-0.5", "0.87", "0"], ["0", "0", "1"]],  # two places
        [["0.866", "0.5", "0"], ["-0.5", "0.876", "0"], ["0", "0", "1"]],  # a slip
        [["0.866", "0.5", "0"], ["0.5", "-0.866", "0"], ["0", "0", "1"]],  # left-handed
        [["0.866", "a", "0"], ["-0.5", "0.866", "0"], ["0", "0", "1"]],  # a symbol
    ],
)
def test_what_is_no_rounded_rotation(rows: list[list[str]]) -> None:
    assert nearest_rotation([tuple(map(parse, row)) for row in rows], {}) == ([], 0)
