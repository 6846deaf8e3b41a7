"""Inverse kinematics at home, singular, stretched and unreachable poses, against poses made in NumPy."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from derive.expression import Number
from tests.kinds.robot.arms import ARMS, Arm

HOME = ("3R", "spherical", "SCARA", "wrist", "Stanford", "PUMA 560", "elbow arm", "arm of five joints",
        "UR5", "parallelogram", "parallelogram with a wrist", "palletiser", "spherical shoulder",
        "Panda, its last joint fixed", "UR from its other end", "wrist, two axes before it meet")  # fmt: skip
QUARTERS = (0.0, math.pi / 2, -math.pi / 2, math.pi)


def placed(arm: Arm, at: Mapping[str, float], **more: float) -> dict[str, float]:
    lengths = {name: at[name] for name in arm.problem().symbols - set(arm.joints)}
    return {**lengths, **{name: float(value) for name, value in arm.known(arm.pose(at)).items()}, **more}


def solved(arm: Arm, values: Mapping[str, float]) -> list[dict[str, Any]]:
    place = tuple((name, Number(Fraction(repr(value)))) for name, value in values.items())
    found = arm.problem().ask("inverse-kinematics", given=arm.given, evaluate=place)
    assert all(claim.holds for claim in found.claims)
    return list(found.evaluated["solutions"])


def drawn(name: str, kind: str) -> dict[str, float]:
    arm, draw = ARMS[name], random.Random(f"{name} {kind}")
    at = {n: round(draw.uniform(0.2, 1.5), 3) for n in sorted(arm.problem().symbols)}
    for joint in arm.joints:
        if joint in arm.slides:
            at[joint] = round(draw.uniform(0.2, 1.5), 3)
        else:
            at[joint] = {"home": 0.0, "random": draw.uniform(-3, 3)}.get(kind, draw.choice(QUARTERS))
    return at


def gap(arm: Arm, joint: str, one: float, other: float) -> float:
    return abs(one - other) if joint in arm.slides else abs(math.remainder(one - other, 2 * math.pi))


def same(arm: Arm, one: Mapping[str, float], other: Mapping[str, float], but: tuple[str, ...] = ()) -> bool:
    return all(gap(arm, joint, one[joint], other[joint]) < 1e-5 for joint in arm.joints if joint not in but)


@pytest.mark.parametrize("kind", ["home", "quarters", "more quarters", "random"])
@pytest.mark.parametrize("name", HOME)
def test_solutions_at_a_pose(name: str, kind: str) -> None:
    """Each reaches the pose, none is there twice, none is outside of a turn or what rounding leaves, and the
    joint values the pose came from are among them or in a family of them."""
    arm, at = ARMS[name], drawn(name, kind)
    wanted = arm.known(arm.pose(at))
    found = [each for each in solved(arm, placed(arm, at)) if each.get("real", True)]
    for each in found:
        reached = arm.known(arm.pose({**at, **{joint: each[joint] for joint in arm.joints}}))
        for key in wanted:
            off = reached[key] - wanted[key]
            assert abs(math.remainder(off, 2 * math.pi) if key == "phi" else off) < 1e-6, (each, key)
        for joint in set(arm.joints) - arm.slides:
            assert -math.pi < each[joint] <= math.pi
            assert each[joint] == 0 or abs(each[joint]) > 1e-9
    assert not [k for k, one in enumerate(found) for other in found[:k] if same(arm, one, other)]
    assert any(same(arm, each, at, tuple(each.get("free", ()))) for each in found), found


@pytest.mark.parametrize("name", ["PUMA 560", "Stanford", "elbow arm"])
def test_what_is_free_at_a_singular_wrist(name: str) -> None:
    """theta4 and theta6 alone, with the sum that the pose fixes; another value of theta4 does as well."""
    arm = ARMS[name]
    at = {**drawn(name, "random"), "theta5": 0.0}
    (free,) = [
        each for each in solved(arm, placed(arm, at))
        if "free" in each and same(arm, each, at, ("theta4", "theta6"))
    ]  # fmt: skip
    assert free["free"] == ["theta4", "theta6"]
    ((name_of_sum, value),) = free["fixed"].items()
    assert name_of_sum == "theta4 + theta6"
    assert gap(arm, "", value, at["theta4"] + at["theta6"]) < 1e-9
    moved = {**at, **free, "theta4": 0.7, "theta6": value - 0.7}
    assert np.allclose(arm.pose(moved), arm.pose(at), atol=1e-9)


def test_beyond_its_reach_no_branch_is_real() -> None:
    for name in ("3R", "PUMA 560", "UR5", "parallelogram"):
        arm, at = ARMS[name], drawn(name, "random")
        far = {key: 20.0 * (key == "x") for key in "xyz" if key in arm.known(arm.pose(at))}
        assert all(each["real"] is False for each in solved(arm, placed(arm, at, **far)))


def test_a_branch_that_does_not_meet_the_whole_pose() -> None:
    """Four joints and a whole pose: of two branches one meets all of it, and none where no branch can."""
    arm = ARMS["arm of four joints"]
    symbolic = arm.problem().ask("inverse-kinematics", given=arm.given).results["solutions"]
    assert [branch.true_at for branch in symbolic] == [False, False]
    at = drawn("arm of four joints", "random")
    found = solved(arm, placed(arm, at))
    assert sorted(each["true_at"] for each in found) == [False, True]
    assert [each.get("real", True) for each in found] == [each["true_at"] for each in found]
    tilted = placed(arm, at, r11=1.0, r12=0.0, r13=0.0, r21=0.0, r22=0.0, r23=-1.0, r31=0.0, r32=1.0, r33=0.0)
    assert not any(each.get("true_at") for each in solved(arm, tilted))


def test_no_solution_is_missing() -> None:
    """Against all zeros that a dense search of Newton's method finds, for arms of three joints."""
    for name, seed in (
        ("anthropomorphic", 1),
        ("shoulder offset", 2),
        ("both offsets", 3),
        ("parallelogram", 4),
    ):
        arm, draw = ARMS[name], random.Random(seed)
        at = drawn(name, "random")
        wanted = arm.pose(at)[:3, 3]
        zeros: list[dict[str, float]] = []
        for _ in range(60):
            q = np.array([draw.uniform(-3, 3) for _ in arm.joints])
            for _ in range(40):
                here = {**at, **dict(zip(arm.joints, q, strict=True))}
                off = arm.pose(here)[:3, 3] - wanted
                J = np.array(
                    [(arm.pose({**here, n: here[n] + 1e-6})[:3, 3] - wanted - off) / 1e-6 for n in arm.joints]
                ).T
                q = q - np.linalg.lstsq(J, off, rcond=None)[0]
            zero = dict(zip(arm.joints, q, strict=True))
            if np.abs(arm.pose({**at, **zero})[:3, 3] - wanted).max() < 1e-9 and not any(
                same(arm, zero, each) for each in zeros
            ):
                zeros.append(zero)
        found = [each for each in solved(arm, placed(arm, at)) if each.get("real", True)]
        assert len(found) == len(zeros)
        assert all(any(same(arm, zero, each) for each in found) for zero in zeros)


def test_what_is_no_rotation_is_refused() -> None:
    from derive.errors import NotDerivable

    arm = ARMS["PUMA 560"]
    values = placed(arm, drawn("PUMA 560", "random"), r11=2.0)
    with pytest.raises(NotDerivable, match="no rotation matrix"):
        solved(arm, values)
