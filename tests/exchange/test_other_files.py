"""Xacro as `xacro` expands it; tables of rows and screws as the sheets that they stand for; the commands."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import derive
from derive.sheet.exchange.files import Wish, as_yaml
from tests.commands import run
from tests.exchange.reading import HERE, ROBOTS, numbers, read

STANFORD = """\
# name: Stanford arm
theta;     d;   a; alpha;  mass; com_x; com_y; com_z; Ixx; Iyy; Izz; min;   max;   name
theta1*;   0;   0; -90 deg; m_1; 0;     0;     0;     I_1; I_1; I_1; -90 deg; 90 deg; waist
theta2*;   d_2; 0; 90 deg; m_2;  0;     0;     l/2;   I_2; I_2; I_2; ;      ;      shoulder
0;         d3*; 0; 0;      ;     ;      ;      ;      ;    ;    ;    0.1 m; 1 m;   boom
"""
UR5 = """\
# home: [[-1, 0, 0, L_1 + L_2], [0, 0, 1, W_1 + W_2], [0, 1, 0, H_1 - H_2], [0, 0, 0, 1]]
w1, w2, w3, v1,        v2,        v3
0,  0,  1,  0,         0,         0
0,  1,  0,  -H_1,      0,         0
0,  1,  0,  -H_1,      0,         L_1
0,  1,  0,  -H_1,      0,         L_1 + L_2
0,  0,  -1, -W_1,      L_1 + L_2, 0
0,  1,  0,  H_2 - H_1, 0,         L_1 + L_2
"""
LENGTHS = {"L_1": 0.425, "L_2": 0.392, "W_1": 0.109, "W_2": 0.082, "H_1": 0.089, "H_2": 0.095}


def test_xacro_is_expanded_as_its_own_program_does() -> None:
    ours, theirs = read(HERE / "xacro" / "arm.xacro"), read(HERE / "xacro" / "expanded.urdf")
    q = {"theta1": 0.3, "d2": -0.4, "theta3": 1.1}
    for key, value in numbers(theirs, q).items():
        np.testing.assert_allclose(numbers(ours, q)[key], value, atol=1e-14)


def test_a_sheet_reads_no_file_outside_of_its_folder(tmp_path: Path) -> None:
    (tmp_path / "sheets").mkdir()
    (tmp_path / "parts.xacro").write_text("<robot/>")
    text = '<robot xmlns:xacro="http://ros.org/wiki/xacro"><xacro:include filename="../parts.xacro"/></robot>'
    (tmp_path / "sheets" / "arm.xacro").write_text(text)
    with pytest.raises(derive.DeriveError, match=r"there is no file \.\./parts\.xacro"):
        derive.loads(
            "title: A\nproblems:\n- {robot: arm.xacro, find: jacobian}\n", tmp_path / "sheets" / "s.yaml"
        )


def test_a_table_of_rows(tmp_path: Path) -> None:
    (tmp_path / "arm.csv").write_text(STANFORD)
    assert as_yaml(tmp_path / "arm.csv")[0].splitlines()[1:4] == [
        "name: Stanford arm",
        "links:",
        "- theta: theta1*  # waist",
    ]
    robot = read(tmp_path / "arm.csv")
    assert robot.variables == ("theta1", "theta2", "d3")
    assert [bool(link.body) for link in robot.links] == [True, True, False]
    assert [bool(link.range) for link in robot.links] == [True, False, True]


def test_screws_of_modern_robotics(tmp_path: Path) -> None:
    """Example 4.5: the UR5 with theta_2 = -pi/2 and theta_5 = pi/2."""
    (tmp_path / "ur5.csv").write_text(UR5)
    bent = LENGTHS | {f"theta{k}": {2: -np.pi / 2, 5: np.pi / 2}.get(k, 0.0) for k in range(1, 7)}
    found = numbers(read(tmp_path / "ur5.csv"), bent)["T"]
    book = [[0, -1, 0, 0.095], [1, 0, 0, 0.109], [0, 0, 1, 0.988], [0, 0, 0, 1]]
    np.testing.assert_allclose(found, book, atol=1e-12)


def test_helices_and_slides(tmp_path: Path) -> None:
    (tmp_path / "arm.csv").write_text("wx,wy,wz,vx,vy,vz\n0,0.6,0.8,0.1,0,0.05\n0,0,0,0,1,0\n")
    S = np.array([[0, -0.8, 0.6, 0.1], [0.8, 0, 0, 0], [-0.6, 0, 0, 0.05], [0, 0, 0, 0]])
    T = numbers(read(tmp_path / "arm.csv"), {"theta1": 0.7, "d2": 0.3})["T"]
    term = total = np.eye(4)
    for k in range(1, 25):
        total = total + (term := term @ S * 0.7 / k)
    total[:3, 3] += total[:3, 1] * 0.3
    np.testing.assert_allclose(T, total, atol=1e-12)


def test_angles_are_exact_within_a_billionth_or_as_wished() -> None:
    text, strange = as_yaml(ROBOTS / "xarm7.urdf")
    assert "by: -1.5708 rad" in text and "within 1e-4" in str(strange[0].hint)
    text, strange = as_yaml(ROBOTS / "xarm7.urdf", Wish(within=1e-4))
    assert "by: -90 deg" in text and "1.5708" not in text and not strange


def test_bodies_that_move_beside_the_arm_are_welded_to_nothing(tmp_path: Path) -> None:
    """A parallelogram whose second bar follows a joint of the arm: poses are read, and no dynamics."""
    bars = (ROBOTS / "mimics.urdf").read_text().replace('<parent link="c"/>', '<parent link="b"/>')
    (tmp_path / "arm.urdf").write_text(bars)
    text, strange = as_yaml(tmp_path / "arm.urdf", Wish(tip="e"))
    assert "mass" not in text and "gravity" not in text
    assert [fault.message for fault in strange] == [
        "joint 'j2' is not on the way to 'e'",
        "joint 'j2' moves with 'j1', beside the arm",
    ]


def test_the_commands(folder: Path) -> None:
    (folder / "panda.urdf").write_text((ROBOTS / "panda.urdf").read_text())
    found = run("import", "panda.urdf")
    assert found.exit_code == 0 and found.stdout.startswith("# From panda.urdf: panda_link0 to panda_hand\n")
    assert "joint 'panda_finger_joint1' and 1 other are not on the way" in found.stderr
    (folder / "panda.yaml").write_text(found.stdout)
    assert run("export", "panda.yaml", "--to", "urdf").stdout.startswith(
        '<?xml version="1.0"?>\n<robot name="panda">'
    )
    assert "this is a sheet, and no robot" in run("export", "week1.yaml", "--to", "urdf").stderr
    (folder / "arm.csv").write_text("theta,d,a,alpha\ntheta1*,0,L,0\n")
    assert "L has no value" in run("export", "arm.csv", "--to", "urdf").stderr
    written = run("export", "arm.csv", "--to", "urdf", "--value", "L=30 cm").stdout
    assert '<origin xyz="0.3 0 0" rpy="0 0 0"/>' in written
    assert run("export", "arm.csv", "--to", "urdf", "--value", "L=x").exit_code == 2
    assert run("import", "panda.urdf", "--package", "x").exit_code == 2


@pytest.mark.parametrize("name", ["ur5", "kr16"])
def test_a_sheet_names_it(name: str) -> None:
    sheet = derive.loads(
        f"title: A\nproblems:\n- {{robot: {name}.urdf, find: forward-kinematics}}\n", ROBOTS / "s.yaml"
    )
    assert sheet.problems[0].questions[0].answer.results["T_6^0"].shape == (4, 4)
