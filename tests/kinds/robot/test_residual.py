"""The momentum observer in a simulation: an arm of two links is hit while it falls, and SciPy integrates."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy
from scipy.integrate import solve_ivp

from derive.errors import SheetErrors
from tests.sheets import pages

LINKS = """
    - {theta: q1*, d: 0, a: 1, alpha: 0, mass: 50, com: [-0.5, 0, 0], inertia: [0, 0, 10]}
    - {theta: q2*, d: 0, a: 1, alpha: 0, mass: 50, com: [-0.5, 0, 0], inertia: [0, 0, 10]}"""
SHEET = """
title: An arm
where: {g: 9.81}
problems:
- robot:
    gravity: [0, -g, 0]
    links:LINKS
  find: residual
  MORE
"""
GAIN = 25.0
NAMES = sympy.symbols("q1 q2 q1_dot q2_dot")


def question(folder: Path, links: str = LINKS, more: str = "gain: 25") -> dict[str, Any]:
    sheet = folder / "arm.yaml"
    sheet.write_text(SHEET.replace("LINKS", links).replace("MORE", more), encoding="utf-8")
    (page,) = pages(sheet, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]
    return found


def inertia(q: Any) -> Any:
    """D of Siciliano et al., section 7.3.2, without motors."""
    c = np.cos(q[1])
    d_11, d_12 = 10 + 50 * 0.25 + 10 + 50 * (1 + 0.25 + c), 10 + 50 * (0.25 + 0.5 * c)
    return np.array([[d_11, d_12], [d_12, 10 + 50 * 0.25]])


def rest(q: Any, rate: Any) -> Any:
    """The other terms of the same equations of motion."""
    h = -50 * 0.5 * np.sin(q[1])
    weight = 50 * 9.81 * np.array([1.5 * np.cos(q[0]) + 0.5 * np.cos(q[0] + q[1]), 0.5 * np.cos(q[0] + q[1])])
    return weight + np.array([h * rate[1] ** 2 + 2 * h * rate[0] * rate[1], -h * rate[0] ** 2])


def touch(t: float, q: Any) -> Any:
    """A force of 100 N at the tip, from 0.2 s on."""
    sums = np.cumsum(q)
    J = np.array([[-np.sin(sums).sum(), -np.sin(sums[1])], [np.cos(sums).sum(), np.cos(sums[1])]])
    return J.T @ [60.0, 80.0] if t > 0.2 else np.zeros(2)


def test_the_residual_is_the_filtered_torque_of_a_contact(tmp_path: Path) -> None:
    texts = question(tmp_path)["results"]
    p, alpha = (sympy.lambdify([NAMES], [sympy.sympify(e) for e in texts[key]]) for key in ("p", "alpha"))

    def change(t: float, state: Any) -> Any:
        q, rate, known, filtered = state[:2], state[2:4], state[4:6], state[6:]
        drive = np.array([300 * np.sin(3 * t), -100.0])
        outside = touch(t, q)
        residual = GAIN * (np.array(p(state[:4])) - begin - known)
        rise = np.linalg.solve(inertia(q), drive + outside - rest(q, rate))
        observed = drive - np.array(alpha(state[:4])) + residual  # no acceleration in it
        return np.concatenate([rate, rise, observed, GAIN * (outside - filtered)])

    start = np.array([0.3, -0.9, 0.1, 0.2, 0, 0, 0, 0])
    begin = np.array(p(start[:4]))
    assert np.allclose(begin, inertia(start[:2]) @ start[2:4])
    found = solve_ivp(change, (0, 0.6), start, rtol=1e-9, atol=1e-9, max_step=0.005)
    residuals = np.array([GAIN * (np.array(p(s[:4])) - begin - s[4:6]) for s in found.y.T])
    assert np.allclose(residuals, found.y[6:].T, atol=1e-3)
    assert np.abs(residuals[found.t < 0.2]).max() < 1e-3
    assert np.allclose(residuals[-1], touch(0.6, found.y[:2, -1]), rtol=0.1)


@pytest.mark.parametrize(
    ("links", "more", "said"),
    [
        (LINKS, "gain: [1, 2, 3]", "3 gains for 2 joints"),
        (LINKS, "gains: 3", "unknown key 'gains'"),
        (LINKS.replace("mass: 50, com: [-0.5, 0, 0], inertia: [0, 0, 10]", "mass: 50"), "gain: 1", "has no"),
        ("\n    - {theta: q1*, d: 0, a: 1, alpha: 0}", "gain: 1", "mass"),
        (LINKS, "gain: 25 m", "1/s"),
    ],
)
def test_what_is_no_observer_is_said(links: str, more: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        question(tmp_path, links, more)
    assert any(said in error.message + error.hint for error in caught.value.errors), caught.value.errors
