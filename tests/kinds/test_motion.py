"""Motions of the exercise sheet of week 2 against its published answers, and SciPy."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.algebra.numbers.floats import numbers
from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Approximate, Call, Degrees, symbols, walk
from derive.kinds.problem import Problem
from derive.mechanics.motion import Motion, Move
from tests.kinds.published import matrix, no_longer, same

phi, psi, theta, alpha, b = symbols("phi psi theta alpha b")


def degrees(value):
    return Degrees(Fraction(value))


def problem(*moves):
    return Problem("motion", Motion(moves))


WORLD = problem(
    Move("rotate", "z", degrees(30), "world"),
    Move("rotate", "x", degrees(60), "world"),
    Move("rotate", "y", degrees(90), "world"),
)
SUMS = problem(
    Move("rotate", "z", degrees(15), "world"),
    Move("rotate", "x", degrees(45), "world"),
    Move("rotate", "y", degrees(60), "world"),
)
MIXED = problem(
    Move("rotate", "x", phi, "world"), Move("rotate", "z", psi), Move("rotate", "y", theta, "world")
)
SHIFTED = problem(
    Move("rotate", "x", alpha, "world"), Move("translate", "z", b, "world"), Move("rotate", "y", phi)
)
PUBLISHED_MIXED = """
cos(theta)*cos(psi)+sin(theta)*sin(phi)*sin(psi),
  sin(theta)*sin(phi)*cos(psi)-cos(theta)*sin(psi), sin(theta)*cos(phi)
cos(phi)*sin(psi), cos(phi)*cos(psi), -sin(phi)
-sin(theta)*cos(psi)+cos(theta)*sin(phi)*sin(psi),
  cos(theta)*sin(phi)*cos(psi)+sin(theta)*sin(psi), cos(theta)*cos(phi)
"""
PUBLISHED_SHIFTED = """
cos(phi), 0, sin(phi), 0
sin(alpha)*sin(phi), cos(alpha), -sin(alpha)*cos(phi), 0
-cos(alpha)*sin(phi), sin(alpha), cos(alpha)*cos(phi), b
0, 0, 0, 1
"""


def holds(derivation):
    return all(claim.holds for claim in derivation.claims)


def test_world_axes_published():
    d = WORLD.ask("rotation-matrix")
    published = [[0.433, 0.75, 0.5], [0.25, 0.433, -0.866], [-0.866, 0.5, 0]]
    assert np.allclose(numbers(d.results["R"], {}), published, atol=5e-4)
    assert holds(d)


def test_decimals_leave_no_long_roots_on_the_page():
    """Exact entries stand just before their decimals where they are short, and nowhere where they are not."""
    short, long = WORLD.ask("rotation-matrix", evaluate=()), SUMS.ask("rotation-matrix", evaluate=())
    assert _with_roots(short) == [("R", -2)]
    assert _with_roots(long) == []
    for d in (short, long):
        assert d.steps[-1].chain[-1].rows[0][0] == Approximate(d.evaluated["R"][0][0])
        assert any(isinstance(node, Call) for node in walk(d.results["R"]))
        assert np.allclose(d.evaluated["R"], numbers(d.results["R"], {}))


def _with_roots(d):
    """The names of the steps that show a root, and the place of it in the chain, from behind."""
    chains = [(step.name, k - len(step.chain), expr) for step in d.steps for k, expr in enumerate(step.chain)]
    return [(name, place) for name, place, expr in chains if any(map(_is_root, walk(expr)))]


def _is_root(node):
    return isinstance(node, Call) and node.function == "sqrt"


def test_mixed_axes_published():
    d = MIXED.ask("rotation-matrix")
    published = matrix(PUBLISHED_MIXED)
    assert same(d.results["R"], published) and no_longer(d.results["R"], published)
    assert set(d.results) == {"R", "R_1", "R_2", "R_3"} and holds(d)


def test_transform_published():
    d = SHIFTED.ask("transform")
    published = matrix(PUBLISHED_SHIFTED)
    assert same(d.results["T"], published) and no_longer(d.results["T"], published)
    assert set(d.results) == {"T", "A_1", "A_2", "A_3"} and holds(d)


def test_equivalent_sequences_have_the_published_one():
    d = MIXED.ask("equivalent-sequences")
    published = tuple(
        {"rotate": axis, "by": by, "about": "current"}
        for axis, by in zip("yxz", ("theta", "phi", "psi"), strict=True)
    )
    assert published in d.results["sequences"] and holds(d)


def test_one_move_has_no_other_sequence():
    with pytest.raises(NotDerivable):
        problem(Move("rotate", "x", phi)).ask("equivalent-sequences")


@pytest.mark.parametrize("axis", [(ONE, ONE, ZERO), (ONE, ONE, ONE), (ZERO, ONE, ZERO)])
def test_written_axis_is_scipys_rotation_vector(axis):
    d = problem(Move("rotate", axis, phi)).ask("rotation-matrix")
    k = np.array([float(part.value) for part in axis])
    expected = Rotation.from_rotvec(0.7 * k / np.linalg.norm(k)).as_matrix()
    assert np.allclose(numbers(d.results["R"], {"phi": 0.7}), expected) and holds(d)


def test_where_is_kept_while_working_and_replaced_at_the_end():
    moves = Motion((Move("rotate", "x", phi), Move("translate", "x", b)))
    d = Problem("motion", moves, where={"b": symbols("L")[0]}).ask("transform")
    assert symbols("L")[0] in walk(d.results["T"]) and b in walk(d.step("T").chain[-2]) and holds(d)


@pytest.mark.parametrize("angles", [((90, "x"), (90, "z")), ((180, "x"), (90, "z")), ((40, "y"), (70, "x"))])
def test_rotation_vector_is_scipys(angles):
    d = problem(*(Move("rotate", axis, degrees(by)) for by, axis in angles)).ask("rotation-vector")
    R = Rotation.identity()
    for by, axis in angles:
        R = R * Rotation.from_euler(axis, by, degrees=True)
    ours = numbers(d.results["r"], {})
    assert np.allclose(Rotation.from_rotvec(ours).as_matrix(), R.as_matrix()) and holds(d)
