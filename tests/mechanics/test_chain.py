"""Poses, Jacobians and dynamics of known arms: numbers of another program, closed forms of textbooks."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

from derive.algebra.formulas.grammar import parse
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.kinds.checks import random_points
from derive.mechanics.chain import chain
from derive.mechanics.dh import modified, standard
from derive.mechanics.jacobian import jacobian
from derive.mechanics.oracle import Oracle
from derive.mechanics.poses import composed, position_part, rotation_part
from derive.mechanics.robot import DHRow
from tests.mechanics.reference import PUMA_Q, PUMA_QN, STANFORD
from tests.mechanics.robots import array, robot, robots, row, symbols
from tests.trees import matrix

PUMA = robot(
    row("theta1*", "0.67183", "0", "90 deg"),
    row("theta2*", "0", "0.4318", "0"),
    row("theta3*", "0.15005", "0.0203", "-90 deg"),
    row("theta4*", "0.4318", "0", "90 deg"),
    row("theta5*", "0", "0", "-90 deg"),
    row("theta6*", "0", "0", "0"),
)
STANFORD_ARM = robot(
    row("theta1*", "0.412", "0", "-90 deg"),
    row("theta2*", "0.154", "0", "90 deg"),
    row("-90 deg", "d3*", "0.0203", "0"),
    row("theta4*", "0", "0", "-90 deg"),
    row("theta5*", "0", "0", "90 deg"),
    row("theta6*", "0", "0", "0"),
)


@pytest.mark.parametrize(
    ("arm", "known"), [(PUMA, PUMA_QN), (PUMA, PUMA_Q), (STANFORD_ARM, STANFORD)], ids=["qn", "q", "Stanford"]
)
def test_pose_and_jacobian_of_known_arms(arm, known) -> None:
    found = chain(arm)
    at = dict(zip(found.variables, known["q"], strict=True))
    assert np.allclose(array(found.T_tool, at), known["T"], atol=1e-12)
    J = jacobian(found, position_part(found.T_tool), 6)
    assert np.allclose(array(J, at), known["J"], atol=1e-12)


def test_the_standard_row() -> None:
    """Spong, Hutchinson and Vidyasagar, Robot Modeling and Control, section 3.2."""
    published = matrix("""
        cos(theta); -sin(theta) cos(alpha); sin(theta) sin(alpha); a cos(theta)
        sin(theta); cos(theta) cos(alpha); -cos(theta) sin(alpha); a sin(theta)
        0; sin(alpha); cos(alpha); d
        0; 0; 0; 1""")
    assert composed(standard(DHRow(*map(parse, ("theta", "d", "a", "alpha"))))) == normal_matrix(published)


def test_the_modified_row() -> None:
    """Craig, Introduction to Robotics, section 3.4."""
    published = matrix("""
        cos(theta); -sin(theta); 0; a
        sin(theta) cos(alpha); cos(theta) cos(alpha); -sin(alpha); -sin(alpha) d
        sin(theta) sin(alpha); cos(theta) sin(alpha); cos(alpha); cos(alpha) d
        0; 0; 0; 1""")
    assert composed(modified(DHRow(*map(parse, ("theta", "d", "a", "alpha"))))) == normal_matrix(published)


def test_the_spherical_wrist() -> None:
    """Spong et al., the ZYZ matrix."""
    wrist = robot(
        row("x*", "0", "0", "-90 deg"), row("y*", "0", "0", "90 deg"), row("z*", "0", "0", "0"), tool="d"
    )
    published = matrix("""
cos(x) cos(y) cos(z) - sin(x) sin(z); -cos(x) cos(y) sin(z) - sin(x) cos(z); cos(x) sin(y); cos(x) sin(y) d
sin(x) cos(y) cos(z) + cos(x) sin(z); -sin(x) cos(y) sin(z) + cos(x) cos(z); sin(x) sin(y); sin(x) sin(y) d
-sin(y) cos(z); sin(y) sin(z); cos(y); cos(y) d
0; 0; 0; 1""")
    assert chain(wrist).T_tool == normal_matrix(published)


def test_the_scara_arm() -> None:
    """Spong et al., sections 3.2 and 4.6."""
    arm = robot(
        row("x*", "0", "a1", "0"),
        row("y*", "0", "a2", "180 deg"),
        row("0", "d3*", "0", "0"),
        row("z*", "d4", "0", "0"),
    )
    found = chain(arm)
    published = matrix("""
        cos(x + y - z); sin(x + y - z); 0; a1 cos(x) + a2 cos(x + y)
        sin(x + y - z); -cos(x + y - z); 0; a1 sin(x) + a2 sin(x + y)
        0; 0; -1; -d3 - d4
        0; 0; 0; 1""")
    assert found.T_tool == normal_matrix(published)
    J = matrix("""
        -a1 sin(x) - a2 sin(x + y); -a2 sin(x + y); 0; 0
        a1 cos(x) + a2 cos(x + y); a2 cos(x + y); 0; 0
        0; 0; -1; 0
        0; 0; 0; 0
        0; 0; 0; 0
        1; 1; 0; -1""")
    assert jacobian(found, position_part(found.T_tool), 4) == normal_matrix(J)


def test_the_anthropomorphic_arm() -> None:
    """Siciliano et al., Robotics, sections 2.9.4 and 3.2.2."""
    arm = robot(row("x*", "0", "0", "90 deg"), row("y*", "0", "a2", "0"), row("z*", "0", "a3", "0"))
    found = chain(arm)
    p = position_part(found.T_tool)
    assert p == normal_matrix(
        matrix("""
        cos(x) (a2 cos(y) + a3 cos(y + z))
        sin(x) (a2 cos(y) + a3 cos(y + z))
        a2 sin(y) + a3 sin(y + z)""")
    )
    J = matrix("""
        -sin(x) (a2 cos(y) + a3 cos(y + z)); -cos(x) (a2 sin(y) + a3 sin(y + z)); -a3 cos(x) sin(y + z)
        cos(x) (a2 cos(y) + a3 cos(y + z)); -sin(x) (a2 sin(y) + a3 sin(y + z)); -a3 sin(x) sin(y + z)
        0; a2 cos(y) + a3 cos(y + z); a3 cos(y + z)
        0; sin(x); sin(x)
        0; -cos(x); -cos(x)
        1; 0; 0""")
    ours = jacobian(found, p, 3)
    assert ours == normal_matrix(J)
    det = ours.block(slice(0, 3), slice(None)).det()
    assert det == normal(parse("-a2 a3 sin(z) (a2 cos(y) + a3 cos(y + z))"))


def test_parallel_axes_share_a_sum() -> None:
    arm = robot(*(row(f"theta{i}*", "0", f"a{i}", "0") for i in (1, 2, 3)))
    assert len(chain(arm).T_tool[0, 0].numerator) == 1
    flipped = robot(row("x*", "0", "a1", "180 deg"), row("y*", "0", "a2", "0"))
    assert chain(flipped).T_tool[0, 0] == normal(parse("cos(x - y)"))


@settings(max_examples=20)
@given(robots())
def test_poses_agree_with_those_composed_in_numbers(arm) -> None:
    found, oracle = chain(arm), Oracle(arm, {})
    for at in random_points(symbols(arm), 2):
        for ours, theirs in zip(found.T, oracle.poses(at), strict=True):
            assert np.allclose(array(ours, at), theirs, atol=1e-9)


@settings(max_examples=20)
@given(robots())
def test_poses_are_rigid_exactly(arm) -> None:
    R = rotation_part(chain(arm).T_tool)
    assert ScalarMatrix.identity(3) == R.T @ R
    assert R.det() == 1


@settings(max_examples=20)
@given(robots())
def test_a_jacobian_is_the_derivative_of_the_pose(arm) -> None:
    found = chain(arm)
    p = position_part(found.T_tool)
    J = jacobian(found, p, len(arm.links))
    at = next(random_points(symbols(arm), 1))
    offset = np.zeros(3)
    assert np.allclose(array(J, at), Oracle(arm, {}).jacobian(at, len(arm.links) + 1, offset), atol=1e-6)
    for k, name in enumerate(found.variables):
        assert p.diff(name) == J.block(slice(0, 3), slice(k, k + 1))
