"""What only a search finds: a lower rank where singular sets cross, and parameters that are too many."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.errors import SheetErrors
from derive.kinds.robot._dynamics import regressor
from derive.mechanics import sampling
from tests.kinds.robot.test_planted_formulas import build, plant

PUMA = """
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: 0, alpha: -90 deg}
    - {theta: theta2*, d: d_3, a: a_2, alpha: 0}
    - {theta: theta3*, d: 0, a: a_3, alpha: -90 deg}
    - {theta: theta4*, d: d_4, a: 0, alpha: 90 deg}
    - {theta: theta5*, d: 0, a: 0, alpha: -90 deg}
    - {theta: theta6*, d: 0, a: 0, alpha: 0}
  symbols: {a_2: positive, a_3: positive, d_3: positive, d_4: positive}
  find: singularities
"""
PLANAR = """
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: l_1, alpha: 0, mass: m_1, com: [0, 0, 0], inertia: [0, 0, I_1]}
    - {theta: theta2*, d: 0, a: l_2, alpha: 0, mass: m_2, com: [0, 0, 0], inertia: [0, 0, I_2]}
  find: regressor
"""


def test_a_set_of_lower_rank_is_missed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    build(PUMA, tmp_path)
    right = sampling._roots
    monkeypatch.setattr(sampling, "_roots", lambda *given: [1.3 * z for z in right(*given)])
    with pytest.raises(SheetErrors):
        build(PUMA, tmp_path)


def test_dependent_columns_are_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    build(PLANAR, tmp_path)
    plant(monkeypatch, regressor.dependent, lambda problem, parameters: {})
    with pytest.raises(SheetErrors):
        build(PLANAR, tmp_path)
