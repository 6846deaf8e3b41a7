"""Define before use, of results: a name of which an answer never tells what it stands for is found."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from derive.build import working_on
from derive.derivation import Result
from derive.expression import Matrix, Symbol, sin
from derive.named import strangers
from derive.sheet.load import load_sheet
from derive.verify import answered

SHEET = """
title: t
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: L, alpha: 0}
  where: {L: 2*a1}
  find: velocity
"""
STRANGE: dict[str, tuple[Result, set[str]]] = {
    "a joint that is not there": (Symbol("theta3_dot"), {"theta3_dot"}),
    "in a matrix": (Matrix(((Symbol("a1"), sin(Symbol("w_13"))),)), {"w_13"}),
    "in one of several": ((Symbol("theta1"), Symbol("t_2")), {"t_2"}),
    "names of the sheet": ((Symbol("L"), Symbol("a1"), Symbol("theta2_ddot")), set()),
}


@pytest.mark.parametrize("case", STRANGE)
def test_names_of_results_are_said(case: str, tmp_path: Path) -> None:
    path = tmp_path / "sheet.yaml"
    path.write_text(SHEET)
    (problem,) = load_sheet(path).problems
    (question,), working = problem.questions, working_on(problem)
    answer = answered(question, working)
    result, strange = STRANGE[case]
    found = strangers(replace(answer, results={"v": result}), question.options, working)
    assert found == strange
