"""What solutions are called: against books, against the frames of an arm in NumPy, and with names planted."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from derive.derivation import Derivation, Phrase
from derive.expression import Number
from derive.kinds.robot._inverse import choices, postures
from tests.kinds.robot.arms import ARMS, Arm
from tests.kinds.robot.test_inverse_kinematics import configurations, solved, values

PARTS = {
    "3R": ("elbow",),
    "SCARA": ("elbow",),
    "anthropomorphic": ("shoulder", "elbow"),
    "shoulder offset": ("shoulder", "elbow"),
    "both offsets": ("shoulder", "elbow"),
    "spherical, d3 > 0": ("shoulder",),
    "Stanford, d3 > 0": ("shoulder", "wrist"),
    "PUMA 560": ("shoulder", "elbow", "wrist"),
    "PUMA 560, modified": ("shoulder", "elbow", "wrist"),
    "elbow arm": ("shoulder", "elbow", "wrist"),
    "wrist": ("wrist",),
    "UR5": ("shoulder",),  # whether an elbow is up depends on more than one choice there
    "cylindrical": (),
    "parallelogram": (),
}


def named(found: Derivation, k: int) -> dict[str, str]:
    """Part and side of solution k, as the page has them."""
    facts: Any = found.facts
    if facts.tree:
        cells = zip(facts.tree.headings, facts.tree.rows[k], strict=True)
        pairs = [(head.key, cell.key) for head, cell in cells if _are_phrases(head, cell)]
        return {part: side for part, side in pairs if part in ("shoulder", "elbow", "wrist")}
    said = facts.count.about.get(("one", "other")[k])
    if not isinstance(said, Phrase) or "posture" not in said.about:
        return {}
    about = said.about["posture"].about
    return {about["part"].key: about["side"].key}


def _are_phrases(*cells: Any) -> bool:
    return all(isinstance(cell, Phrase) for cell in cells)


def frames(arm: Arm, at: dict[str, float]) -> list[Any]:
    """The poses of all frames, from that of the base."""
    part = [Arm(arm.rows[:n], arm.given, 1, arm.convention) for n in range(len(arm.rows) + 1)]
    return [each.pose(at) for each in part]


@pytest.mark.parametrize("name", PARTS)
def test_the_parts_that_have_names(name: str) -> None:
    assert tuple(named(solved(name), 0)) == PARTS[name]


@pytest.mark.parametrize(("name", "shoulder", "elbow", "end"), [
    ("anthropomorphic", 1, 2, 3), ("shoulder offset", 1, 2, 3), ("PUMA 560", 1, 2, 4), ("elbow arm", 1, 2, 4),
])  # fmt: skip
def test_an_elbow_is_up_where_it_lies_above_the_line(name: str, shoulder: int, elbow: int, end: int) -> None:
    """Seen from the side, the links all turned into one vertical plane."""
    arm, found = ARMS[name], solved(name)
    for at in configurations(arm, 10):
        given = {n: v for n, v in at.items() if n not in arm.joints} | arm.known(arm.pose(at))
        for k, branch in enumerate(found.results["solutions"]):
            if (joints := values(branch, arm, given)) is None:
                continue
            T = frames(arm, {**at, **joints})
            level = np.cross(T[shoulder][:3, 2], (0, 0, 1))
            flat = [(float(T[n][:3, 3] @ level), float(T[n][2, 3])) for n in (shoulder, elbow, end)]
            (x0, z0), (x1, z1), (x2, z2) = flat
            above = z1 > z0 + (z2 - z0) * (x1 - x0) / (x2 - x0)
            assert named(found, k)["elbow"] == ("up" if above else "down")


def test_the_scara_by_the_sign_of_its_second_angle() -> None:
    """A person whose right elbow is out to the right bends the arm to the left."""
    found = solved("SCARA")
    assert [named(found, k)["elbow"] for k in (0, 1)] == ["right", "left"]
    assert [str(each.when[0].sign) for each in found.results["solutions"]] == [">", "<"]


# -- published -----------------------------------------------------------------------------------------


def at_pose(name: str, joints: tuple[float, ...], lengths: dict[str, float]) -> Derivation:
    arm = ARMS[name]
    at = {**lengths, **dict(zip(arm.joints, joints, strict=True))}
    known = {**lengths, **arm.known(arm.pose(at))}
    place = tuple((key, Number(Fraction(repr(float(value))))) for key, value in known.items())
    return arm.problem().ask("inverse-kinematics", given=arm.given, evaluate=place)


def row_of(found: Derivation, wanted: tuple[float, ...], names: tuple[str, ...]) -> int:
    (k,) = (
        k
        for k, each in enumerate(found.evaluated["solutions"])
        if all(
            abs(math.remainder(each[n] - w, 2 * math.pi)) < 2e-4 for n, w in zip(names, wanted, strict=True)
        )
    )
    return k


def test_the_configurations_that_corke_names() -> None:
    """Robotics, Vision and Control, section 7.2.2: qn is "ru", right-handed and elbow up; what ikine6s finds
    first is left-handed, elbow up and not flipped."""
    qn = (0, math.pi / 4, math.pi, 0, math.pi / 4, 0)
    found = at_pose("PUMA 560", qn, {})
    names = ARMS["PUMA 560"].joints
    assert named(found, row_of(found, qn, names)) == {
        "shoulder": "right", "elbow": "up", "wrist": "not-flipped",
    }  # fmt: skip
    other = (2.6486, -3.9270, 0.0940, 2.5326, 0.9743, 0.3734)
    assert named(found, row_of(found, other, names)) == {
        "shoulder": "left", "elbow": "up", "wrist": "not-flipped",
    }  # fmt: skip


def test_the_planar_arm_of_craig() -> None:
    """Introduction to Robotics, MATLAB exercises 3 and 4: links of 4, 3 and 2, angles of 10, 20 and 30
    degrees, (7.5373, 3.9266) at 60 degrees; of the other solution the elbow is mirrored."""
    angles = tuple(map(math.radians, (10, 20, 30)))
    found = at_pose("3R", angles, {"a1": 4.0, "a2": 3.0, "a3": 2.0})
    down, up = found.evaluated["solutions"]
    turned = math.radians(10) + 2 * math.atan2(3 * math.sin(angles[1]), 4 + 3 * math.cos(angles[1]))
    assert [down[f"theta{i}"] for i in (1, 2, 3)] == pytest.approx(angles)
    assert up["theta1"] == pytest.approx(turned)
    assert up["theta2"] == pytest.approx(-angles[1])
    assert sum(up[f"theta{i}"] for i in (1, 2, 3)) == pytest.approx(math.radians(60))
    facts: Any = found.facts
    assert [label[0].about["side"].key for label in facts.labels] == ["down", "up"]


def test_the_two_arms_of_spong() -> None:
    """Robot Modeling and Control, section 5.3: with an offset d2 there is a left and a right arm, it stands
    to the left of the line of sight to the wrist where theta2 > 0."""
    found = solved("Stanford, d3 > 0")
    sides = [named(found, k)["shoulder"] for k in range(4)]
    assert sides == ["left", "left", "right", "right"]


# -- planted -------------------------------------------------------------------------------------------


def refused(name: str) -> set[str]:
    arm = ARMS[name]
    found = arm.problem().ask("inverse-kinematics", given=arm.given)
    return {claim.key for claim in found.claims if not claim.holds}


@pytest.mark.parametrize(("view", "name"), [
    ("height", "anthropomorphic"), ("above", "SCARA"), ("above", "spherical, d3 > 0"), ("drawn", "3R"),
    ("middle", "wrist"),
])  # fmt: skip
def test_the_other_side(view: postures.View, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert not refused(name)
    one, other = postures.SIDES[view]
    monkeypatch.setattr(postures, "SIDES", {**postures.SIDES, view: (other, one)})
    assert refused(name) == {"postures-seen"}


def test_the_other_sign(monkeypatch: pytest.MonkeyPatch) -> None:
    right = choices.Choices._cell

    def wrong(self: Any, solved: Any, k: int) -> Phrase:
        return Phrase("minus" if right(self, solved, k).key == "plus" else "plus")

    monkeypatch.setattr(choices.Choices, "_cell", wrong)
    assert refused("anthropomorphic") == {"signs-told"}
