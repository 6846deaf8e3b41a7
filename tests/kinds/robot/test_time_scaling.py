"""Motions scaled in time against torques of the textbook's two-link arm searched by SciPy, and wrong ones."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from derive.errors import SheetErrors
from tests.sheets import pages

ARM = """
title: An arm
where: {g: 9.81}
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: q1*, d: 0, a: 1, alpha: 0, mass: 50, com: [-0.5, 0, 0], inertia: [0, 0, 10]}
    - {theta: q2*, d: 0, a: 1, alpha: 0, mass: 50, com: [-0.5, 0, 0], inertia: [0, 0, 10]FRICTION}
  questions:
  - find: time-scaling
    MOTION
"""
REST = "from: {q1: 0, q2: 0}\n    to: {q1: 60 deg, q2: 90 deg}\n    law: LAW\n    time: 1"
MOST = (1400.0, 400.0)


def question(motion: str, folder: Path, friction: str = "") -> dict[str, Any]:
    sheet = folder / "arm.yaml"
    sheet.write_text(ARM.replace("MOTION", motion).replace("FRICTION", friction), encoding="utf-8")
    (page,) = pages(sheet, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]
    return found


def torques(q: Any, rates: Any, rises: Any) -> Any:
    """Siciliano et al., eqs. (7.82) and (7.83), without motors."""
    c2, s2 = np.cos(q[1]), np.sin(q[1])
    B = np.array([[10 + 12.5 + 10 + 50 * (1 + 0.25 + c2), 10 + 50 * (0.25 + 0.5 * c2)], [0, 22.5]])
    B[1, 0] = B[0, 1]
    h = -25 * s2
    speed = np.array([2 * h * rates[0] * rates[1] + h * rates[1] ** 2, -h * rates[0] ** 2])
    g2 = 25 * 9.81 * np.cos(q.sum())
    return B @ rises + speed + np.array([75 * 9.81 * np.cos(q[0]) + g2, g2])


def motion(law: str, t: float, k: float) -> tuple[Any, Any, Any]:
    powers = {"cubic": [0, 0, 3, -2], "quintic": [0, 0, 0, 10, -15, 6]}[law]
    share = np.polynomial.Polynomial(powers)
    way = np.radians([60, 90])
    return way * share(t), way * share.deriv()(t) / k, way * share.deriv(2)(t) / k**2


@pytest.mark.parametrize("law", ["cubic", "quintic"])
def test_the_factor_that_scipy_finds(law: str, tmp_path: Path) -> None:
    found = question(REST.replace("LAW", law) + f"\n    torque_max: {list(MOST)}", tmp_path)["evaluated"]

    def beyond(k: float, joints: Any) -> float:
        shares = [np.abs(torques(*motion(law, t, k)))[joints] / np.array(MOST)[joints] for t in TIMES]
        return float(np.max(shares)) - 1

    for joint in (0, 1):
        assert found["factors"][joint] == pytest.approx(brentq(beyond, 0.5, 9, args=([joint],)), rel=1e-5)
    assert found["k"] == max(found["factors"]) == pytest.approx(found["time"])


TIMES = np.linspace(0, 1, 2001)


def test_functions_of_time(tmp_path: Path) -> None:
    """The cubic law typed out, twice as slow."""
    typed = 'joints: ["pi/3*(3*(t/2)^2 - 2*(t/2)^3)", "pi/2*(3*(t/2)^2 - 2*(t/2)^3)"]\n    time: 2'
    one = question(typed + f"\n    torque_max: {list(MOST)}", tmp_path)["evaluated"]
    other = question(REST.replace("LAW", "cubic") + f"\n    torque_max: {list(MOST)}", tmp_path)["evaluated"]
    assert one["time"] == pytest.approx(other["time"]) and one["k"] == pytest.approx(other["k"] / 2)


@pytest.mark.parametrize(
    ("motion", "friction", "said"),
    [
        (REST + "\n    torque_max: [1400]", "", "1 limits for 2 joints"),
        (REST + "\n    torque_max: [900, 400]", "", "joint 1 cannot hold the arm"),
        (REST + "\n    torque_max: [M, 400]", "", "no value is known for M"),
        (REST + "\n    torque_max: [-1400, 400]", "", "positive"),
        (REST + "\n    torque_max: [1400, 400]", ", friction: {viscous: 1}", "friction"),
        (REST.replace(", q2: 90 deg", "") + "\n    torque_max: [1400, 400]", "", "no value for q2"),
        (REST.replace("q2: 90", "q3: 90") + "\n    torque_max: [1400, 400]", "", "'q3' is no joint"),
        (REST + "\n    joints: [t, t]\n    torque_max: [1400, 400]", "", "give the motion by"),
        ("joints: [sqrt(t), t]\n    time: 1\n    torque_max: [1400, 400]", "", "no velocity or acceleration"),
        ("joints: [t]\n    time: 1\n    torque_max: [1400, 400]", "", "1 functions for 2 joints"),
        ("time: 1\n    torque_max: [1400, 400]", "", "give the motion by"),
        (REST.replace("to: {q1: 60 deg, q2: 90 deg}", "to: {q1: 0, q2: 0}") + "\n    torque_max: [1400, 400]",
         "", "no limit bounds"),
    ],
)  # fmt: skip
def test_what_is_not_scaled_is_said(motion: str, friction: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        question(motion.replace("LAW", "cubic"), tmp_path, friction)
    assert said in str(fault.value.errors[0])
