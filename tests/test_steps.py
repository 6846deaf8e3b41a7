"""How much of an answer is told: all the working, formula and result, or the result alone."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from derive.build import build
from derive.sheet.model import Steps

SHEET = """
title: Steps
STEPS
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a_1, alpha: 0}
    - {theta: theta2*, d: 0, a: a_2, alpha: 0}
  questions:
  - {find: jacobian, rows: [vx, vy], evaluate: {theta1: 30 deg, theta2: 60 deg, a_1: 1 m, a_2: 2 m}}
  - {find: forward-kinematics}
  - {find: singularities, rows: [vx, vy]}
"""


def page(tmp_path: Path, said: str = "", steps: Steps | None = None) -> str:
    sheet = tmp_path / "steps.yaml"
    sheet.write_text(SHEET.replace("STEPS", said))
    (text,) = build([sheet], ["md"], None, steps=steps)
    return str(text)


def boxes(text: str) -> list[str]:
    return re.findall(r"\\boxed\{\n(.*?)\n\}\n\\tag\{\d+\}\n\$\$", text, re.DOTALL)


def numbers(text: str) -> list[str]:
    return re.findall(r"\\tag\{(\d+)\}", text)


def test_less_and_less(tmp_path: Path) -> None:
    full, key, answers = (page(tmp_path, f"steps: {level}") for level in ("full", "key", "answers"))
    assert len(full) > len(key) > len(answers)
    assert {*boxes(full)} == {*boxes(key)} and "A revolute joint" in full and "A revolute joint" not in key
    assert [box.split("=")[0].strip() for box in boxes(key)] == ["J_{v_x,v_y}", "T_2^0"]
    assert "T_1^0 T_2^1" in boxes(key)[1] and "T_1^0 T_2^1" not in boxes(answers)[1]
    assert sorted(numbers(key)) == numbers(full) == ["1", "2"] and numbers(key) == numbers(answers)
    assert all("\\det J" in text for text in (full, key, answers))  # no formula answers that question
    assert all("At $" in text for text in (full, key, answers))


def test_the_command_line_and_a_question_say_it(tmp_path: Path) -> None:
    assert page(tmp_path, steps="key") == page(tmp_path, "steps: key")
    sheet = SHEET.replace("a_2: 2 m}}", "a_2: 2 m}, steps: answers}").replace("STEPS", "")
    sheet = sheet.replace("  - {find: singularities, rows: [vx, vy]}\n", "")
    (tmp_path / "one.yaml").write_text(sheet)
    (text,) = build([tmp_path / "one.yaml"], ["md"], None)
    assert "A revolute joint" not in str(text) and "T_1^0 T_2^1" in str(text)


def test_only_three_are_known(tmp_path: Path) -> None:
    from derive.errors import SheetErrors

    with pytest.raises(SheetErrors):
        page(tmp_path, "steps: some")


ARM = Path("exercises/robots/ur5.yaml")


def of_six_joints(tmp_path: Path, questions: str, steps: Steps) -> str:
    (tmp_path / ARM.name).write_text(ARM.read_text())
    sheet = tmp_path / "six.yaml"
    sheet.write_text(f"title: Six joints\nproblems:\n- robot: {ARM.name}\n  questions:\n{questions}")
    (text,) = build([sheet], ["md"], None, steps=steps)
    return str(text)


def test_a_key_has_all_that_its_answers_are_made_of(tmp_path: Path) -> None:
    text = of_six_joints(tmp_path, "  - {find: jacobian}\n  - {find: singularities}\n", "key")
    assert all(f"J_{k} &=" in text or f"J_{k} =" in text for k in range(1, 7)) and "\\times" not in text
    assert "**Case 3.**" in text and "rank 4" in text and "j_{12}" not in text


def test_a_pose_is_written_out_where_it_is_read(tmp_path: Path) -> None:
    inverse, angles = (
        "  - {find: inverse-kinematics, given: pose}\n",
        "  - {find: euler-angles, convention: ZYZ}\n",
    )
    assert "t_{11} &=" not in of_six_joints(tmp_path, inverse, "full")
    assert "t_{11} &=" in of_six_joints(tmp_path, inverse + angles, "full")
