"""Standard and modified rows, free rows and screws, each with a base and a tool: every kinematic question."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from derive.algebra.numbers.floats import numbers
from derive.build import assemble
from derive.derivation import Derivation
from derive.sheet.load import load_sheet

ENDS = """
    base: [{rotate: z, by: gamma}, {translate: x, by: b}]
    tool: [{translate: z, by: e}, {rotate: y, by: 90 deg}]
"""
ROWS = """
    - {theta: theta1*, d: d1, a: a1, alpha: 90 deg}
    - {theta: 30 deg, d: d2*, a: a2, alpha: -90 deg}
    - {theta: theta3* + 90 deg, d: 0, a: a3, alpha: beta}
"""
REVERSED = """
    - {theta: -theta1*, d: 0, a: a1, alpha: 90 deg}
    - {theta: 0, d: 1 - d2*, a: a2, alpha: 0}
    - {theta: 30 deg - theta3*, d: 0, a: a3, alpha: 0}
"""
ARMS = {
    "standard": f"\n    links:{ROWS}",
    "modified": f"\n    convention: modified\n    links:{ROWS}",
    "reversed": f"\n    links:{REVERSED}",
    "reversed modified": f"\n    convention: modified\n    links:{REVERSED}",
    "free": """
    links:
    - {theta: theta1*, d: d1, a: 0, alpha: 90 deg}
    - motion: [{translate: x, by: a2}, {rotate: [0, 1, 1], by: theta2*}]
    - motion: [{rotate: x, by: 45 deg}, {translate: [1, 0, 1], by: d3*}]
""",
    "fixed row": """
    convention: modified
    links:
    - {theta: theta1*, d: 0, a: 0, alpha: 0}
    - {theta: 0, d: c, a: a2, alpha: 60 deg}
    - {theta: theta3*, d: 0, a: a3, alpha: 90 deg}
""",
    "screws": """
    links:
    - {screw: {axis: [0, 3/5, 4/5], through: [a1, 0, 0]}, variable: theta1*}
    - {screw: {slide: x}, variable: d2*}
    - {screw: {axis: y, through: [0, 0, a3], pitch: h}, variable: theta3* + 30 deg}
    home: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
""",
}
QUESTIONS = (
    "forward-kinematics", "forward-kinematics, to: 2", "joint-axes", "jacobian", "jacobian, in: tool",
    "jacobian, point: {link: 2, at: [u, 0, 0]}", "velocity", "space-jacobian", "space-jacobian, in: body",
    "product-of-exponentials", "inverse", "euler-angles, angles: [x_e, y_e, z_e]", "dh-table",
    "dh-table, convention: standard", "dh-table, convention: modified",
)  # fmt: skip


def asked(folder: Path, arm: str, *questions: str) -> list[Derivation]:
    sheet = folder / "arm.yaml"
    text = f"title: t\nproblems:\n- robot:{ARMS[arm].rstrip()}{ENDS.rstrip()}\n  questions:\n"
    sheet.write_text(
        text + "".join(f"  - {{find: {question}}}\n" for question in questions), encoding="utf-8"
    )
    return [q.derivation for _, q in assemble(load_sheet(sheet)).questions() if q.derivation]


@pytest.mark.parametrize("arm", ARMS)
@pytest.mark.parametrize("question", QUESTIONS)
def test_every_question_of_every_arm(tmp_path: Path, arm: str, question: str) -> None:
    """A claim that fails would not let the sheet be built: laws, links and the numbers of a second route."""
    if arm == "screws" and question.startswith("dh-table"):
        return  # one of its joints is a helix
    (found,) = asked(tmp_path, arm, question)
    assert found.claims or getattr(found.facts, "mode", "") == "given"


@pytest.mark.parametrize("arm", ARMS)
def test_the_ways_to_the_pose_agree(tmp_path: Path, arm: str) -> None:
    rows, screws = asked(tmp_path, arm, "forward-kinematics", "product-of-exponentials")
    symbols = (
        "theta1",
        "theta2",
        "theta3",
        "d1",
        "d2",
        "d3",
        "a1",
        "a2",
        "a3",
        "b",
        "c",
        "e",
        "h",
        "beta",
        "gamma",
    )
    at = {name: 0.2 + 0.13 * k for k, name in enumerate(symbols)}
    poses = [numbers(next(reversed(found.results.values())), at) for found in (rows, screws)]
    assert np.allclose(poses[0], poses[1])


def test_a_base_before_screws_belongs_to_the_first_frame(tmp_path: Path) -> None:
    """T_1^0 is what stands in the base, as of rows; the motion of joint 1 alone is E_1."""
    first, second = asked(tmp_path, "screws", "forward-kinematics, to: 1", "forward-kinematics, to: 2")
    at = {"theta1": 0.3, "d2": 0.4, "a1": 0.5, "b": 0.6, "gamma": 0.7}
    c, s = np.cos(0.7), np.sin(0.7)
    base = np.array([[c, -s, 0, 0.6 * c], [s, c, 0, 0.6 * s], [0, 0, 1, 0], [0, 0, 0, 1]])
    E_1, T_1, T_21 = (
        np.array(numbers(found.results[name], at))
        for found, name in ((first, "E_1"), (first, "T_1^0"), (second, "T_2^1"))
    )
    assert np.allclose(T_1, base @ E_1)
    assert np.allclose(numbers(second.results["T_1^0"], at), T_1)
    assert np.allclose(numbers(second.results["T_2^0"], at), T_1 @ T_21)
