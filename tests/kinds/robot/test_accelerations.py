"""Accelerations against SymPy, which differentiates the position along a motion by time."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import sympy

from tests.sheets import pages

T = sympy.Symbol("t")
COURSE = {"q1": 0.3 + 0.7 * T - 0.4 * T**2, "q2": -0.9 + 0.2 * T + 0.6 * T**2, "q3": 0.5 - 0.3 * T + T**2}
ARM = """
title: An arm
problems:
- robot:
    links:
    - {theta: q1*, d: 0.4, a: 0, alpha: 90 deg}
    - {theta: q2*, d: 0, a: 0.5, alpha: 0}
    - {theta: q3*, d: 0, a: 0.3, alpha: 0}
  find: KIND
  evaluate: {PLACE}
"""
ROWS = [(0.4, 0.0, 1), (0.0, 0.5, 0), (0.0, 0.3, 0)]  # d, a, quarter turns


def place(course: dict[str, Any]) -> dict[str, float]:
    """The joint variables, their rates and accelerations at the time 0."""
    ends = enumerate(("", "_dot", "_ddot"))
    return {q + end: float(sympy.diff(way, T, k).subs(T, 0)) for k, end in ends for q, way in course.items()}


def pose() -> Any:
    """T (4 by 4) along the course, the rows multiplied as they are."""
    whole = sympy.eye(4)
    for (d, a, quarter), q in zip(ROWS, COURSE.values(), strict=True):
        c, s, ca, sa = sympy.cos(q), sympy.sin(q), 1 - quarter, quarter
        whole = whole * sympy.Matrix(
            [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
        )
    return whole


def seen() -> tuple[Any, Any]:
    """a and alpha (3 each): second derivatives of the position, and of the rotation turned back."""
    whole = pose()
    R, S = whole[:3, :3], whole[:3, :3].diff(T, 2) * whole[:3, :3].T
    a = [float(each.subs(T, 0)) for each in whole[:3, 3].diff(T, 2)]
    spin = S.subs(T, 0).evalf()
    assert R.shape == (3, 3)
    alpha = [(spin[2, 1] - spin[1, 2]) / 2, (spin[0, 2] - spin[2, 0]) / 2, (spin[1, 0] - spin[0, 1]) / 2]
    return a, [float(each) for each in alpha]


def evaluated(kind: str, at: dict[str, float], folder: Path, more: str = "") -> dict[str, Any]:
    sheet = folder / f"{kind}.yaml"
    told = ", ".join(f"{name}: {value:.12f}" for name, value in at.items())
    sheet.write_text(ARM.replace("KIND", kind).replace("PLACE", told) + more, encoding="utf-8")
    (page,) = pages(sheet, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]["evaluated"]
    return found


def test_an_acceleration_is_the_second_derivative_and_back(tmp_path: Path) -> None:
    a, alpha = seen()
    at = place(COURSE)
    found = evaluated("acceleration", at, tmp_path)
    assert np.allclose(found["a"], a) and np.allclose(found["alpha"], alpha)
    known = {name: value for name, value in at.items() if not name.endswith("_ddot")}
    wanted = dict(zip(("ax", "ay", "az"), a, strict=True))
    back = evaluated("inverse-acceleration", known | wanted, tmp_path, "  rows: [vx, vy, vz]\n")
    assert np.allclose(back["qddot"], [at[f"{q}_ddot"] for q in COURSE], atol=1e-8)


def test_a_task_has_the_least_accelerations(tmp_path: Path) -> None:
    """r = q1 + 2 q2 + 2 q3: the least of all with r_ddot = 9 is (1, 2, 2)."""
    more = "  task: [q1 + 2*q2 + 2*q3]\n"
    at = {"q1": 0.1, "q2": 0.2, "q3": 0.3, "q1_dot": 1, "q2_dot": 1, "q3_dot": 1, "r1_ddot": 9}
    assert np.allclose(evaluated("inverse-acceleration", at, tmp_path, more)["qddot"], [1, 2, 2])
