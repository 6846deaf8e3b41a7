"""Inverse kinematics as sheets ask for it: shapes, numbers at a place, published values, refusals."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy

from derive.build import derive_all
from derive.errors import NotDerivable, SheetErrors
from derive.kinds.robot._inverse.progress import Progress
from derive.sheet.load import load_sheet
from derive.writing import render
from tests.kinds.robot.arms import ARMS, Arm
from tests.mechanics.robots import problem, robot, row
from tests.sheets import ROOT

REAL = "symbols: {d4: real}\n"  # no joint variable, though it reads like one


def asked(folder: Path, name: str, given: str, more: str = "", top: str = "") -> dict[str, Any]:
    """The question's part of the JSON."""
    rows = "".join(
        f"    - {{theta: {theta}, d: {d}, a: {a}, alpha: {alpha}}}\n"
        for theta, d, a, alpha in ARMS[name].rows
    )
    convention = f"    convention: {ARMS[name].convention}\n"
    sheet = folder / "sheet.yaml"
    text = (
        f"title: A test\n{top}problems:\n- robot:\n{convention}    links:\n{rows}  find: inverse-kinematics\n"
    )
    sheet.write_text(f"{text}  given: {given}\n{more}", encoding="utf-8")
    (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
    render(document, "md")  # no step may be left out of the page
    return json.loads(render(document, "json"))["problems"][0]["questions"][0]


def place(values: Mapping[str, float]) -> str:
    inner = ", ".join(f"{name}: {value!r}" for name, value in values.items())
    return f"  evaluate: {{{inner}}}\n"


def pose(arm: Arm, joints: Mapping[str, float]) -> dict[str, float]:
    return {name: float(value) for name, value in arm.known(arm.pose(joints)).items()}


@cache
def angles(degrees: tuple[float, ...]) -> dict[str, float]:
    return {f"theta{i}": math.radians(value) for i, value in enumerate(degrees, 1)}


def near(found: Mapping[str, float], wanted: Mapping[str, float], tolerance: float = 1e-9) -> bool:
    return all(abs(math.remainder(found[n] - wanted[n], 2 * math.pi)) < tolerance for n in wanted)


# -- shapes --------------------------------------------------------------------------------------------


def test_values_read_in_sympy(tmp_path) -> None:
    found = asked(tmp_path, "anthropomorphic", "[x, y, z]")["results"]["solutions"]
    at = {"x": 0.6, "y": 0.3, "z": 0.9, "d1": 0.4, "a2": 0.5, "a3": 0.4}
    arm = ARMS["anthropomorphic"]
    for branch in found:
        joints = {n: float(sympy.sympify(branch[n]).subs(at)) for n in arm.joints}
        reached = arm.pose({**at, **joints})[:3, 3]
        assert np.allclose(reached, [0.6, 0.3, 0.9], atol=1e-12)


def test_when_says_which_branch(tmp_path) -> None:
    found = asked(tmp_path, "anthropomorphic", "[x, y, z]")["results"]["solutions"]
    assert [branch["when"] for branch in found] == [
        "x*cos(theta1) + y*sin(theta1) > 0, theta3 > 0",
        "x*cos(theta1) + y*sin(theta1) > 0, theta3 < 0",
        "x*cos(theta1) + y*sin(theta1) < 0, theta3 > 0",
        "x*cos(theta1) + y*sin(theta1) < 0, theta3 < 0",
    ]


def test_what_is_positive_has_one_sign(tmp_path) -> None:
    both = asked(tmp_path, "RP", "[x, y]")["results"]["solutions"]
    assert [branch["when"] for branch in both] == ["d2 > 0", "d2 < 0"]
    one = asked(tmp_path, "RP", "[x, y]", top="symbols: {d2: positive}\n")["results"]["solutions"]
    assert one == [{"theta1": "atan2(y, x)", "d2": "sqrt(x**2 + y**2)", "when": "d2 > 0"}]


# -- numbers at a place --------------------------------------------------------------------------------


def test_every_branch_in_numbers(tmp_path) -> None:
    arm = ARMS["PUMA 560"]
    joints = angles((20, 40, -70, 30, 50, -15))
    found = asked(tmp_path, "PUMA 560", "pose", place(pose(arm, joints)))["evaluated"]["solutions"]
    assert len(found) == 8
    assert sum(near(branch, joints) for branch in found) == 1
    for branch in found:
        assert np.allclose(arm.pose(branch), arm.pose(joints), atol=1e-9)


def test_out_of_reach(tmp_path) -> None:
    far = {**pose(ARMS["PUMA 560"], angles((0,) * 6)), "x": 3.0}
    found = asked(tmp_path, "PUMA 560", "pose", place(far))["evaluated"]["solutions"]
    assert len(found) == 8
    assert all(branch["real"] is False and set(branch) == {"when", "real"} for branch in found)


def test_the_planar_arm_out_of_reach(tmp_path) -> None:
    found = asked(tmp_path, "2R", "[x, y]", place({"x": 3, "y": 0, "a1": 1, "a2": 1}))["evaluated"]
    assert [branch["real"] for branch in found["solutions"]] == [False, False]


def test_some_branches_out_of_reach(tmp_path) -> None:
    at = {"x": 1.3, "y": 0, "z": 0.4, "d1": 0.4, "a1": 0.5, "d2": 0, "a2": 0.5, "a3": 0, "d4": 0.4}
    found = asked(tmp_path, "both offsets", "[x, y, z]", place(at), REAL)["evaluated"]["solutions"]
    assert sorted(branch.get("real", True) for branch in found) == [False, False, True, True]


def test_a_pose_the_arm_cannot_take(tmp_path) -> None:
    tilted = {"x": 0.5, "y": 0.2, "z": 0, "r11": 1, "r12": 0, "r13": 0, "r21": 0, "r22": 1, "r23": 0,
              "r31": 0, "r32": 0, "r33": 1, "a1": 0.4, "a2": 0.3, "d4": 0.1}  # fmt: skip
    found = asked(tmp_path, "SCARA", "pose", place(tilted))["evaluated"]["solutions"]
    assert all(branch["real"] is False for branch in found)


def test_a_wrist_whose_axes_coincide(tmp_path) -> None:
    arm = ARMS["PUMA 560"]
    joints = angles((20, 40, -70, 30, 0, -15))
    found = asked(tmp_path, "PUMA 560", "pose", place(pose(arm, joints)))["evaluated"]["solutions"]
    real = [branch for branch in found if branch.get("real", True)]
    assert any(near(branch, angles((20, 40, -70)), 1e-6) for branch in real)
    for branch in real:
        assert np.allclose(arm.pose(branch), arm.pose(joints), atol=1e-6)


def test_the_home_of_the_ur5(tmp_path) -> None:
    """All joints at zero: the axes of joints 4 and 6 are parallel there, and one angle can be chosen."""
    arm = ARMS["UR5"]
    for degrees in ((0,) * 6, (10, -50, 70, 20, 0, 30), (10, -50, 70, 20, 180, 30)):
        joints = angles(degrees)
        found = asked(tmp_path, "UR5", "pose", place(pose(arm, joints)))["evaluated"]["solutions"]
        real = [branch for branch in found if branch.get("real", True)]
        assert real
        for branch in real:
            assert np.allclose(arm.pose(branch), arm.pose(joints), atol=1e-6)


def test_a_pose_typed_with_three_digits(tmp_path) -> None:
    arm = ARMS["Stanford, d3 > 0"]
    joints = {**angles((20, 40, 0, 30, 50, -15)), "d3": 0.5}
    rounded = {name: round(value, 3) for name, value in pose(arm, joints).items()}
    found = asked(tmp_path, "Stanford, d3 > 0", "pose", place(rounded))["evaluated"]["solutions"]
    assert any(branch.get("real", True) and near(branch, angles((20, 40)), 0.01) for branch in found)


def test_a_value_that_is_missing(tmp_path) -> None:
    """What has its values becomes a number, the rest a formula in the letters left."""
    found = asked(tmp_path, "anthropomorphic", "[x, y, z]", place({"x": 1, "y": 0}))["evaluated"]["solutions"]
    assert [branch["theta1"] for branch in found] == [0, 0, math.pi, math.pi]
    at = {"z": 0.4, "d1": 0.2, "a2": 0.7, "a3": 0.6}
    for branch in found:
        joints = {n: float(sympy.sympify(branch[n]).subs(at)) for n in ARMS["anthropomorphic"].joints}
        assert np.allclose(ARMS["anthropomorphic"].pose({**at, **joints})[:3, 3], [1, 0, 0.4], atol=1e-12)


# -- published -----------------------------------------------------------------------------------------


def test_the_nominal_pose_of_the_puma(tmp_path) -> None:
    """Corke, Robotics, Vision and Control, section 7.2.2: the pose qn = (0, pi/4, pi, 0, pi/4, 0), and the
    other solution printed there."""
    arm = ARMS["PUMA 560"]
    joints = dict(zip(arm.joints, (0, math.pi / 4, math.pi, 0, math.pi / 4, 0), strict=True))
    T = arm.pose(joints)
    assert np.allclose(T[:3, 3], [0.5963, -0.1501, -0.01435], atol=5e-5)
    found = asked(tmp_path, "PUMA 560", "pose", place(pose(arm, joints)))["evaluated"]["solutions"]
    other = dict(zip(arm.joints, (2.6486, -3.9270, 0.0940, 2.5326, 0.9743, 0.3734), strict=True))
    assert any(near(branch, joints, 1e-6) for branch in found)
    assert any(near(branch, other, 1e-4) for branch in found)


def test_the_formulas_of_craig_for_the_puma(tmp_path) -> None:
    """Craig, Introduction to Robotics, equations 4.64 and 4.67 to 4.70."""
    arm = ARMS["PUMA 560, modified"]
    at = {"a2": 0.43, "a3": 0.02, "d3": 0.15, "d4": 0.43} | angles((25, -50, 65, 10, 40, -30))
    known = pose(arm, at)
    constants = {name: at[name] for name in ("a2", "a3", "d3", "d4")}
    found = asked(tmp_path, "PUMA 560, modified", "pose", place({**known, **constants}))["evaluated"]
    px, py, pz = (known[name] for name in "xyz")
    K = (px**2 + py**2 + pz**2 - sum(at[n] ** 2 for n in ("a2", "a3", "d3", "d4"))) / (2 * at["a2"])
    for sign in (1, -1):
        theta1 = math.atan2(py, px) - math.atan2(at["d3"], sign * math.sqrt(px**2 + py**2 - at["d3"] ** 2))
        for elbow in (1, -1):
            root = elbow * math.sqrt(at["a3"] ** 2 + at["d4"] ** 2 - K**2)
            theta3 = math.atan2(at["a3"], at["d4"]) - math.atan2(K, root)
            wanted = {"theta1": theta1, "theta3": theta3}
            assert sum(near(branch, wanted) for branch in found["solutions"]) == 2


# -- what is refused -----------------------------------------------------------------------------------


@pytest.mark.parametrize("given", ["[x]", "poze", "[x, x]", "[1, 2]", "{x: 1}"])
def test_what_cannot_be_given(tmp_path, given) -> None:
    with pytest.raises(SheetErrors) as raised:
        asked(tmp_path, "2R", given)
    assert raised.value.errors[0].place is not None
    assert raised.value.errors[0].hint


def test_more_joints_than_coordinates() -> None:
    with pytest.raises(NotDerivable, match="infinitely many solutions"):
        ARMS["3R"].problem().ask("inverse-kinematics", given=["x", "y"])


def test_a_name_with_two_meanings() -> None:
    arm = robot(row("x*", "0", "a", "0"), row("y*", "0", "b", "0"), row("q*", "0", "c", "0"))
    with pytest.raises(NotDerivable, match="'x' names a known coordinate"):
        problem(arm).ask("inverse-kinematics", given=["x", "y", "phi"])
    with pytest.raises(NotDerivable, match="'theta1' names a known coordinate"):
        ARMS["2R"].problem().ask("inverse-kinematics", given=["theta1", "y"])


def test_no_closed_form_says_what_is_left() -> None:
    skew = robot(*(row(f"theta{k}*", f"d{k}", f"a{k}", f"{10 * k} deg") for k in range(1, 6)))
    with pytest.raises(NotDerivable, match="The reduced equations are"):
        problem(skew).ask("inverse-kinematics", given="pose")


def test_a_screw_joint_has_no_closed_form(tmp_path) -> None:
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(
        "title: A test\nproblems:\n- robot:\n    links:\n"
        "    - {screw: {axis: z, through: [0, 0, 0], pitch: h}, variable: theta1*}\n"
        "    - {screw: {slide: x}, variable: d2*}\n    home: [{translate: x, by: L}]\n"
        "  find: inverse-kinematics\n  given: [x, y, z]\n",
        encoding="utf-8",
    )
    with pytest.raises(SheetErrors) as raised:
        derive_all([load_sheet(sheet)], True, lambda _: None)
    assert "helical" in raised.value.errors[0].message


def test_one_condition_for_one_region(tmp_path: Path) -> None:
    """Outside the cylinder of its offset a spherical arm reaches all; neither the root nor the cosine says
    less."""
    asked(tmp_path, "spherical", "[x, y, z]", top="symbols: {d3: positive}\n")
    (document,) = derive_all([load_sheet(tmp_path / "sheet.yaml")], True, lambda _: None)
    page = render(document, "md")
    assert page.count("real where") == 1
    assert r"They are real where $x^2 + y^2 \geq d_2^2$" in page
    assert "arbitrary" not in page  # which it would be where d_3 is zero


def test_what_cannot_vanish_is_no_condition(tmp_path: Path) -> None:
    """Of 2 + 1.5 c_3 = 0 nothing is said, of 2 + 2 c_3 = 0 it is."""
    rows = "    - {{theta: theta{}*, d: {}, a: {}, alpha: {} deg}}\n"
    for length, vanishes in (("1.5", False), ("2", True)):
        sheet = tmp_path / f"arm{length}.yaml"
        links = (("1", "0", "1", "-90"), ("2", "1", "2", "90"), ("3", "0", length, "0"))
        sheet.write_text(
            "title: A test\nproblems:\n- robot:\n    links:\n" + "".join(rows.format(*row) for row in links)
            + "  find: inverse-kinematics\n  given: [x, y, z]\n", encoding="utf-8",
        )  # fmt: skip
        (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
        assert ("these equations do not determine" in render(document, "md")) == vanishes


def test_another_branch_may_be_real(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Out of reach is a pose where no choice that was made before decides; where one does, that is said."""
    sheet = load_sheet(ROOT / "exercises" / "inverse-kinematics.yaml")
    (document,) = derive_all([sheet], True, lambda _: None)
    page = render(document, "md")
    assert r"smaller there is no solution with this $\theta_1$." in page
    assert r"where the left side is smaller the pose is out of reach." in page
    monkeypatch.setattr(Progress, "rests_on", lambda *_: ())
    with pytest.raises(SheetErrors):
        derive_all([load_sheet(ROOT / "exercises" / "inverse-kinematics.yaml")], True, lambda _: None)
