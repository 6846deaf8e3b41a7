"""Joints with limits: which solutions keep them, against every configuration on a grid of the joints."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.sheets import pages

ARM = """
title: An arm with limits
problems:
- robot:
    links:
    - {theta: q1*, d: 0, a: 400 mm, alpha: 0, range: [0, 180 deg]}
    - {theta: q2*, d: 0, a: 250 mm, alpha: 0, range: [-120 deg, TOP]}
  find: inverse-kinematics
  given: [x, y]
  evaluate: {x: X mm, y: Y mm}
"""


def solutions(x: float, y: float, top: int, folder: Path) -> list[dict[str, Any]]:
    sheet = folder / "sheet.yaml"
    text = ARM.replace("TOP", f"{top} deg").replace("X mm", f"{x} mm").replace("Y mm", f"{y} mm")
    sheet.write_text(text, encoding="utf-8")
    (question,) = _json(sheet, folder)["problems"][0]["questions"]
    found: list[dict[str, Any]] = question["evaluated"]["solutions"]
    return found


def _json(sheet: Path, folder: Path) -> dict[str, Any]:
    (path,) = (each for each in pages(sheet, folder, "json") if each.suffix == ".json")
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found


def near(x: float, y: float, top: int) -> list[tuple[float, float]]:
    """The configurations within the limits that come nearest to a point, one of each bend of the elbow."""
    found = []
    for low, high in ((-120, 0), (0, top)):
        q1, q2 = np.meshgrid(
            np.radians(np.arange(0, 180.1, 0.5)), np.radians(np.arange(low, high + 0.1, 0.5))
        )
        off = np.hypot(
            400 * np.cos(q1) + 250 * np.cos(q1 + q2) - x, 400 * np.sin(q1) + 250 * np.sin(q1 + q2) - y
        )
        if off.min() < 5:
            best = np.unravel_index(off.argmin(), off.shape)
            found.append((float(q1[best]), float(q2[best])))
    return found


@pytest.mark.parametrize(
    ("x", "y", "top"), [(450, 180, 120), (-200, 400, 120), (-200, 400, 60), (480, 480, 120)]
)
def test_feasible_solutions_are_those_of_a_grid(x: float, y: float, top: int, tmp_path) -> None:
    found = [each for each in solutions(x, y, top, tmp_path) if each.get("feasible")]
    told = sorted((each["q2"], each["q1"]) for each in found)
    there = sorted((q2, q1) for q1, q2 in near(x, y, top))
    assert len(told) == len(there)
    assert np.allclose(told, there, atol=0.03)
