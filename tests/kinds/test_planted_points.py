"""The point that is asked for, read with a wrong sign: no number at it is printed."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from derive.algebra.numbers.floats import Point
from derive.errors import SheetErrors
from derive.expression import Expr
from derive.kinds import values_at
from tests.kinds.robot.test_planted_formulas import build, plant

ARM = """
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a_1, alpha: 0}
    - {theta: theta2*, d: 0, a: a_2, alpha: 0}
  where: {a_1: 1.2, a_2: 0.7}
"""
PROFILE = "problems:\n- profile: {from: 0.3, to: 2, time: 2}\n"
FIT = """
problems:
- points:
    from: [[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]]
    to: [[1.0, 2.1, 0.0], [1.1, 3.0, 0.1], [-0.9, 2.0, 0.0], [1.0, 2.0, 3.1]]
  find: fit-transform
  evaluate: true
"""
ASKED = {
    "jacobian": (ARM, "evaluate: {theta1: 0.4, theta2: 1.1}"),
    "jacobian of angles": (ARM, "kind: analytic\n  evaluate: {theta1: 0.4, theta2: 1.1}"),
    "inverse-kinematics": (ARM, "evaluate: {x: 0.9, y: 0.8}"),
    "manipulability": (ARM, "rows: [vx, vy]\n  evaluate: {theta1: 0.4, theta2: 1.1}"),
    "numerical-inverse-kinematics": (ARM, "target: [0.9, 0.8]\n  start: {theta1: 0.1, theta2: 1}"),
    "cubic-trajectory": (PROFILE, "evaluate: {t: 0.5}"),
}


@pytest.mark.parametrize("asked", ASKED)
def test_where_it_is_asked_for(asked: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    subject, options = ASKED[asked]
    sheet, right = f"{subject}  find: {asked.split()[0]}\n  {options}\n", values_at.point_of

    def elsewhere(at: Mapping[str, Expr], where: Mapping[str, Expr]) -> Point:
        return {name: -value for name, value in right(at, where).items()}

    build(sheet, tmp_path)
    plant(monkeypatch, right, elsewhere)
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)


def test_rounded_results_are_those_in_numbers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    build(FIT, tmp_path)
    right = values_at.number
    monkeypatch.setattr(values_at, "number", lambda tree, point: -right(tree, point))
    with pytest.raises(SheetErrors):
        build(FIT, tmp_path)
