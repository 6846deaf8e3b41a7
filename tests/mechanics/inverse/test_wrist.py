"""The center of a spherical wrist, against where textbooks place it."""

from __future__ import annotations

import random

import numpy as np
import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.mechanics.chain import chain
from derive.mechanics.inverse.wrist import spherical_shoulder, spherical_wrist
from tests.kinds.robot.arms import ARMS
from tests.mechanics.robots import array, robot, row


@pytest.mark.parametrize(
    ("name", "in_end"),
    [
        ("PUMA 560", ("0", "0", "0")),
        ("PUMA 560, modified", ("0", "0", "0")),
        ("Stanford", ("0", "0", "-d6")),
        ("elbow arm", ("0", "0", "-d6")),
        ("slanted wrist", ("0", "0", "-d")),
    ],
)
def test_in_the_frame_of_the_end_effector(name, in_end) -> None:
    found = spherical_wrist(chain(ARMS[name].robot))
    assert found is not None
    assert all(entry == normal(parse(t)) for entry, t in zip(found.centre.entries, in_end, strict=True))


@pytest.mark.parametrize("name", ["PUMA 560", "PUMA 560, modified", "Stanford", "elbow arm"])
def test_one_point_seen_from_both_sides(name) -> None:
    arm = chain(ARMS[name].robot)
    found = spherical_wrist(arm)
    assert found is not None
    draw = random.Random(2)
    at = {n: draw.uniform(0.2, 1.5) for n in (*arm.variables, "a2", "a3", "d1", "d2", "d3", "d4", "d6")}
    end, before = array(arm.T_tool, at), array(arm.T[found.rows[0] - 1], at)
    assert np.allclose(
        end @ np.append(array(found.centre, at), 1), before @ np.append(array(found.inside, at), 1)
    )


@pytest.mark.parametrize("name", ["UR5", "SCARA", "anthropomorphic", "both offsets"])
def test_arms_without_one(name) -> None:
    assert spherical_wrist(chain(ARMS[name].robot)) is None


def test_axes_that_miss_each_other() -> None:
    rows = [("theta1*", "0", "0", "90 deg"), ("theta2*", "0", "a", "-90 deg"), ("theta3*", "0", "0", "0")]
    assert spherical_wrist(chain(robot(*(row(*each) for each in rows)))) is None


def test_a_shoulder_is_one_point_seen_from_both_sides() -> None:
    arm = chain(ARMS["Panda, its last joint fixed"].robot)
    found = spherical_shoulder(arm)
    assert found is not None
    assert spherical_wrist(arm) is None
    draw = random.Random(3)
    at = {name: draw.uniform(0.2, 1.5) for name in (*arm.variables, "a4", "a7", "d1", "d3", "d5", "d_f", "q")}
    inside = array(arm.T[found.frame], at) @ np.append(array(found.inside, at), 1)
    assert np.allclose(inside[:3], array(found.centre, at).ravel())
    assert np.allclose(inside[:3], (0, 0, at["d1"]))
