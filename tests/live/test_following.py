"""What is made at each save: a page equal to that of a fresh start, without deriving again what is known."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.kinds.problem import Problem
from derive.kinds.remembered import Remembered
from derive.kinds.robot import jacobian
from derive.live.following import Wanted, made

ARM = """\
- robot:
    links:
    - {theta: theta1*, d: 0, a: 0.50 m, alpha: 0}
  questions:
  - {find: jacobian, rows: [vx, vy]}
  - {find: dh-table}
"""
SHEET = f"title: Arms\nproblems:\n{ARM}{ARM}{ARM.replace('0.50 m', 'l_1')}"
EDITS = {  # with how many problems are worked on again
    SHEET: 3,
    SHEET.replace("Arms", "Other arms").replace("problems:", "date: today\nproblems:"): 0,
    SHEET.replace("l_1", "L"): 1,
    SHEET.replace("find: dh-table", "find: forward-kinematics", 1): 2,
    SHEET.replace("0.50 m", "0.5 m", 1): 1,
    SHEET.replace("find: jacobian", "find: jacobain", 1): 0,
    SHEET.replace("0.50 m", "0.5 m", 1).replace("- {find: jac", "- hint: Look.\n    {find: jac", 1): 0,
    SHEET.replace("0.50 m", "0.5 m", 1).replace("Arms", "Arms again"): 0,
    f"title: Arms\nproblems:\n{ARM}": 0,
    SHEET.replace("0.50 m", "l_3", 1): 2,
}


def test_only_what_changed_is_derived(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    derived: list[Problem] = []
    derive = jacobian.derive
    monkeypatch.setattr(jacobian, "derive", lambda *asked: derived.append(asked[-1]) or derive(*asked))
    known, sheet = Remembered(), tmp_path / "arms.yaml"
    for text, again in EDITS.items():
        sheet.write_text(text, encoding="utf-8")
        derived.clear()
        found = made(sheet, Wanted(), 0, known)
        assert len({id(problem) for problem in derived}) == again, text
        fresh = made(sheet, Wanted(), 0, Remembered())
        assert found.get("page") == fresh.get("page")
        assert found["faults"] == fresh["faults"]
        assert found.get("proved") == fresh.get("proved")


def test_more_or_less_of_the_steps_is_told_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    known, sheet = Remembered(), tmp_path / "arms.yaml"
    sheet.write_text(SHEET, encoding="utf-8")
    made(sheet, Wanted(), 0, known)
    monkeypatch.setattr(jacobian, "derive", None)
    for steps in ("key", "answers", "full"):
        assert made(sheet, Wanted(steps=steps), 0, known)["page"]
