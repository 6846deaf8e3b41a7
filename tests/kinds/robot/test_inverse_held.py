"""Redundant arms with joints that are chosen, put back through poses multiplied out in NumPy."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Number, Symbol
from derive.mechanics.motion import Motion, Move
from derive.mechanics.robot import Link, Robot, ScrewRow
from tests.kinds.robot.arms import Arm
from tests.mechanics.robots import problem

Q = math.pi / 180
PANDA = Arm(
    (("theta1*", "0.333", "0", "0"), ("theta2*", "0", "0", "-90 deg"), ("theta3*", "0.316", "0", "90 deg"),
     ("theta4*", "0", "0.0825", "90 deg"), ("theta5*", "0.384", "-0.0825", "-90 deg"),
     ("theta6*", "0", "0", "90 deg"), ("theta7*", "0.107", "0.088", "90 deg")),
    "pose", 8, convention="modified",
)  # fmt: skip
IIWA = Arm(
    (("theta1*", "0.36", "0", "-90 deg"), ("theta2*", "0", "0", "90 deg"), ("theta3*", "0.42", "0", "90 deg"),
     ("theta4*", "0", "0", "-90 deg"), ("theta5*", "0.4", "0", "-90 deg"), ("theta6*", "0", "0", "90 deg"),
     ("theta7*", "0.126", "0", "0")),
    "pose", 8,
)  # fmt: skip
WAM = Arm(
    (("theta1*", "0", "0", "-90 deg"), ("theta2*", "0", "0", "90 deg"),
     ("theta3*", "0.55", "0.045", "-90 deg"), ("theta4*", "0", "-0.045", "90 deg"),
     ("theta5*", "0.3", "0", "-90 deg"), ("theta6*", "0", "0", "90 deg"), ("theta7*", "0.06", "0", "0")),
    "pose", 8,
)  # fmt: skip
RAIL = Arm(
    (("0", "d1*", "0", "-90 deg"), ("theta2*", "0", "0.5", "0"), ("theta3*", "0", "0.4", "0")), ("x", "z"), 2
)
ABSOLUTE = Arm(
    (("theta1*", "0", "0.5", "0"), ("theta2* - theta1", "0", "0.4", "0"),
     ("theta3* - theta2", "0", "0.3", "0")),
    ("x", "y"), 2,
)  # fmt: skip
CASES = [(ABSOLUTE, "theta2"), (PANDA, "theta7"), (IIWA, "theta3"), (IIWA, "theta1"), (RAIL, "d1")]


def place(arm: Arm, at: Mapping[str, float], *names: str) -> tuple[tuple[str, Number], ...]:
    known = {**arm.known(arm.pose(at)), **{name: at[name] for name in names}}
    return tuple((name, Number(Fraction(repr(float(value))))) for name, value in known.items())


@pytest.mark.parametrize(("arm", "free"), CASES)
def test_every_solution_reaches_the_pose(arm: Arm, free: str) -> None:
    at = {name: 0.3 + 0.41 * k * (-1) ** k for k, name in enumerate(arm.joints)}
    found = arm.problem().ask(
        "inverse-kinematics", given=arm.given, free=(free,), evaluate=place(arm, at, free)
    )
    assert all(claim.holds for claim in found.claims)
    branches = found.results["solutions"]
    assert len(branches) == arm.solutions
    assert all(str(branch.values[free].name) == free for branch in branches)
    reached = [each for each in found.evaluated["solutions"] if each.get("real", True)]
    assert all(each[free] == pytest.approx(at[free]) for each in reached)
    wanted = arm.known(arm.pose(at))
    for each in reached:
        assert arm.known(arm.pose(each)) == pytest.approx(wanted, abs=1e-8)
    home = [
        max(abs(math.remainder(each[name] - at[name], 2 * math.pi)) for name in arm.joints)
        for each in reached
    ]
    assert min(home) < 1e-7


def angle_of(arm: Arm, at: Mapping[str, float], shoulder: float) -> float:
    """How far the axis of the fourth joint is turned about the line between the centres from level."""
    frames = [replace(arm, rows=arm.rows[:n]).pose(at) for n in (3, 5)]
    line, axis = frames[1][:3, 3] - (0, 0, shoulder), frames[0][:3, 2]
    level = np.cross((0, 0, 1), line) / np.hypot(*line[:2])
    return math.atan2(np.cross(level, axis) @ line / np.linalg.norm(line), level @ axis)


@pytest.mark.parametrize(("arm", "shoulder", "name"), [(IIWA, 0.36, "psi"), (WAM, 0.0, "phi")])
def test_seven_joints_by_the_arm_angle(arm: Arm, shoulder: float, name: str) -> None:
    at = {joint: 0.3 + 0.41 * k * (-1) ** k for k, joint in enumerate(arm.joints)}
    psi = angle_of(arm, at, shoulder)
    asked = place(arm, {**at, name: psi}, name)
    free = () if name == "psi" else (name,)
    found = arm.problem().ask("inverse-kinematics", given="pose", free=free, evaluate=asked)
    assert all(claim.holds for claim in found.claims)
    assert len(found.results["solutions"]) == arm.solutions
    wanted = arm.known(arm.pose(at))
    home = []
    for each in found.evaluated["solutions"]:
        assert arm.known(arm.pose(each)) == pytest.approx(wanted, abs=1e-8)
        assert math.remainder(angle_of(arm, each, shoulder) - psi, 2 * math.pi) == pytest.approx(0, abs=1e-8)
        home.append(max(abs(math.remainder(each[joint] - at[joint], 2 * math.pi)) for joint in arm.joints))
    assert len(home) == 8
    assert min(home) < 1e-7


def test_the_panda_at_rest() -> None:
    """As Franka's documentation has its posture of rest."""
    rest = dict(zip(PANDA.joints, (0, -45 * Q, 0, -135 * Q, 0, 90 * Q, 45 * Q), strict=True))
    asked = place(PANDA, rest, "theta7")
    found = PANDA.problem().ask("inverse-kinematics", given="pose", free=("theta7",), evaluate=asked)
    gaps = [
        max(abs(math.remainder(each[name] - rest[name], 2 * math.pi)) for name in rest)
        for each in found.evaluated["solutions"]
    ]
    assert min(gaps) < 1e-7
    assert len(gaps) == 8


@pytest.mark.parametrize(
    ("free", "why"),
    [
        (("theta9",), "'theta9' under free is no joint variable"),
        (("theta3", "theta7"), "free names 2 of the 7 joint variables, but what is given leaves one"),
    ],
)
def test_joints_that_cannot_be_chosen(free: tuple[str, ...], why: str) -> None:
    with pytest.raises(NotDerivable, match=why):
        IIWA.problem().ask("inverse-kinematics", given="pose", free=free)


def test_without_a_choice_it_is_said_how_to_make_one() -> None:
    with pytest.raises(NotDerivable, match=r"free: \[theta7\]"):
        PANDA.problem().ask("inverse-kinematics", given="pose")


def test_a_chain_of_screws() -> None:
    """The WAM arm of Lynch and Park, section 4.1.3, given by its screws."""
    up, level = (ZERO, ZERO, ONE), (ZERO, ONE, ZERO)
    rows = [
        (up, (ZERO, ZERO, ZERO)), (level, (ZERO, ZERO, ZERO)), (up, (ZERO, ZERO, ZERO)),
        (level, (Symbol("w"), ZERO, Symbol("h"))), (up, (ZERO, ZERO, ZERO)),
        (level, (ZERO, ZERO, Symbol("k"))), (up, (ZERO, ZERO, ZERO)),
    ]  # fmt: skip
    links = tuple(
        Link(ScrewRow(axis, through, Symbol(f"theta{i}")), "revolute", f"theta{i}")
        for i, (axis, through) in enumerate(rows, 1)
    )
    arm = Robot("", "standard", links, home=Motion((Move("translate", "z", Symbol("e")),)))
    found = problem(arm).ask("inverse-kinematics", given="pose", free=("theta3",))
    assert all(claim.holds for claim in found.claims)
    assert len(found.results["solutions"]) == 8
