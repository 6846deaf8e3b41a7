from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from derive.algebra.formulas.grammar import parse
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Walk
from derive.expression import Symbol
from derive.mechanics.motion import Move
from derive.mechanics.poses import (
    composed,
    homogeneous,
    inverse_pose,
    pose,
    position_part,
    rotation,
    rotation_part,
    skew,
    unit_vector,
)
from tests.mechanics.robots import array

ANGLE = Walk({}).trig(Symbol("phi"))
AXES = ["x", "y", "z", (1, 1, 0), (1, 2, 2), (0, -3, 4), (1, 1, 1), (2, -1, 3)]


def axis(of):
    return of if isinstance(of, str) else tuple(parse(str(part)) for part in of)


def direction(of):
    k = np.array({"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}.get(of, of), dtype=float)
    return k / np.linalg.norm(k)


@pytest.mark.parametrize("of", AXES, ids=str)
@pytest.mark.parametrize("phi", [0.3, -1.2, 2.9])
def test_a_rotation_is_that_of_scipy(of, phi) -> None:
    ours = array(rotation(axis(of), ANGLE), {"phi": phi})
    assert np.allclose(ours, Rotation.from_rotvec(phi * direction(of)).as_matrix(), atol=1e-12)


@pytest.mark.parametrize("of", AXES, ids=str)
def test_a_rotation_is_orthonormal_exactly(of) -> None:
    R = rotation(axis(of), ANGLE)
    assert ScalarMatrix.identity(3) == R.T @ R
    assert R.det() == 1
    assert R.diff("phi") @ R.T == skew(ScalarMatrix.column(unit_vector(axis(of))))


def test_an_axis_by_name() -> None:
    R = rotation(tuple(map(Symbol, ("k_x", "k_y", "k_z"))), ANGLE)
    at = {"k_x": 0.4, "k_y": -0.7, "k_z": 1.1, "phi": 0.8}
    k = np.array([0.4, -0.7, 1.1])
    assert np.allclose(array(R, at), Rotation.from_rotvec(0.8 * k / np.linalg.norm(k)).as_matrix())


MOVES = st.lists(
    st.tuples(st.sampled_from(("rotate", "translate")), st.sampled_from("xyz"), st.sampled_from("pqr")),
    min_size=1,
    max_size=5,
)


@given(MOVES)
def test_moves_about_current_axes_are_composed_as_numpy_does(moves) -> None:
    at = {"p": 0.7, "q": -1.1, "r": 0.4}
    ours = array(composed([Move(kind, letter, Symbol(name)) for kind, letter, name in moves]), at)
    expected = np.eye(4)
    for kind, letter, name in moves:
        step = np.eye(4)
        if kind == "rotate":
            step[:3, :3] = Rotation.from_euler(letter, at[name]).as_matrix()
        else:
            step["xyz".index(letter), 3] = at[name]
        expected = expected @ step
    assert np.allclose(ours, expected)


@given(MOVES)
def test_the_inverse_of_a_pose(moves) -> None:
    T = composed([Move(kind, letter, Symbol(name)) for kind, letter, name in moves])
    assert T @ inverse_pose(T) == ScalarMatrix.identity(4)
    assert homogeneous(rotation_part(T), position_part(T).entries) == T


def test_a_translation_along_an_oblique_axis_has_its_length() -> None:
    T = pose(Move("translate", axis((3, 0, 4)), Symbol("b")))
    assert T[0, 3] == Walk({}).scalar(parse("3*b/5"))
    assert T[2, 3] == Walk({}).scalar(parse("4*b/5"))


def test_skew_is_the_vector_product() -> None:
    w, p = (ScalarMatrix.column(Walk({}).scalar(Symbol(n)) for n in names) for names in ("abc", "def"))
    assert skew(w) @ p == w.cross(p)
