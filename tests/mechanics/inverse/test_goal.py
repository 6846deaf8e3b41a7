"""What the known coordinates of an end-effector mean."""

from __future__ import annotations

import math

import numpy as np
import pytest

from derive.errors import NotDerivable
from derive.mechanics.chain import chain
from derive.mechanics.inverse.goal import Goal, of_coordinates, of_pose
from tests.kinds.robot.arms import ARMS


def goal(name: str, *given: str) -> Goal:
    arm = chain(ARMS[name].robot)
    return of_coordinates(arm.T_tool, given, arm.variables)


def test_names_belong_to_the_coordinates_that_change() -> None:
    assert goal("PRR", "u", "v", "phi").places == {"u": (0, 3), "v": (2, 3)}
    assert goal("2R", "r14", "r24").places == {"r14": (0, 3), "r24": (1, 3)}
    assert goal("anthropomorphic", "x", "y", "z").places["z"] == (2, 3)


def test_a_pose_has_twelve_names() -> None:
    assert len(of_pose().names) == 12
    T = np.arange(16.0).reshape(4, 4)
    assert of_pose().numbers(T)["r23"] == 6.0
    assert of_pose().numbers(T)["y"] == 7.0


def test_the_angle_is_that_of_the_first_axis_in_the_plane() -> None:
    arm = ARMS["3R"]
    at = {"theta1": 0.3, "theta2": 0.4, "theta3": 0.5, "a1": 1.0, "a2": 1.0, "a3": 1.0}
    assert math.isclose(goal("3R", "x", "y", "phi").numbers(arm.pose(at))["phi"], 1.2)


def test_z_is_a_coordinate_even_where_it_does_not_change() -> None:
    found = goal("2R", "x", "y", "z")
    assert found.angle is None
    assert found.places["z"] == (2, 3)


@pytest.mark.parametrize(
    ("name", "given", "message"),
    [
        ("anthropomorphic", ("x", "y"), "2 coordinates are given"),
        ("wrist", ("x", "y"), "none of x, y, z"),
        ("anthropomorphic", ("x", "y", "z", "phi"), "turns about more than one axis"),
    ],
)
def test_names_that_do_not_fit(name, given, message) -> None:
    with pytest.raises(NotDerivable, match=message):
        goal(name, *given)
