"""An arm of seven joints: as many base parameters as pinocchio finds, and its regressor in numbers."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from derive.errors import SheetErrors
from tests.sheets import pages

IIWA = [("d1", -90), (0, 90), ("d3", 90), (0, -90), ("d5", -90), (0, 90), ("d7", 0)]
BODY = "mass: m{k}, com: [x{k}, y{k}, z{k}], inertia: [A{k}, B{k}, C{k}, D{k}, E{k}, F{k}]"
VALUES = {
    "m": 2.0,
    "x": 0.1,
    "y": -0.05,
    "z": 0.2,
    "A": 0.5,
    "B": 0.4,
    "C": 0.3,
    "D": 0.01,
    "E": 0.02,
    "F": 0.03,
}


def sheet(folder: Path, evaluate: str = "", find: str = "regressor") -> dict[str, Any]:
    """The one answer of an iiwa with any bodies."""
    rows = (
        f"    - {{theta: q{k}*, d: {d}, a: 0, alpha: {twist} deg, {BODY.format(k=k)}}}"
        for k, (d, twist) in enumerate(IIWA, 1)
    )
    lines = ("title: An arm", "problems:", "- robot:", "    links:", *rows, f"  find: {find}", evaluate)
    path = folder / "sheet.yaml"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    (page,) = pages(path, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]
    return found


def test_an_arm_of_seven_joints_has_43_base_parameters(tmp_path: Path) -> None:
    """pinocchio 3: the rank of computeJointTorqueRegressor at 60 random motions is 43 for an iiwa."""
    draw = random.Random(5)
    moving = {
        f"q{k}{dots}": round(draw.uniform(-1, 1), 3) for k in range(1, 8) for dots in ("", "_dot", "_ddot")
    }
    bodies = {f"{name}{k}": value for k in range(1, 8) for name, value in VALUES.items()}
    point = {**moving, **bodies, "d1": 0.36, "d3": 0.42, "d5": 0.4, "d7": 0.126, "g": 9.81}
    found = sheet(tmp_path, f"  evaluate: {json.dumps(point)}")
    assert len(found["results"]["base_parameters"]) == 43 == len(found["results"]["groups"])
    told = {
        name: np.array(found["evaluated"][name]) for name in ("Y", "Y_b", "parameters", "base_parameters")
    }
    assert told["Y"].shape == (7, 58) and told["Y_b"].shape == (7, 43)
    assert np.allclose(told["Y"] @ told["parameters"], told["Y_b"] @ told["base_parameters"])


def test_equations_that_are_too_long_are_refused_before_the_work(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        sheet(tmp_path, find="forward-dynamics")
    assert "too many (more than" in str(fault.value.errors[0])
