"""Shortest times along paths: trapezoids on straight ones, SciPy's linear program on one that is bent."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import linprog

from derive.errors import SheetErrors
from tests.sheets import pages


def asked(profile: str, folder: Path, more: str = "law: path") -> dict[str, Any]:
    sheet = folder / "sheet.yaml"
    sheet.write_text(
        f"title: A path\nproblems:\n- profile: {profile}\n  find: minimum-time\n  {more}\n", encoding="utf-8"
    )
    (page,) = pages(sheet, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]
    return found


def test_a_straight_path_has_a_trapezoid(tmp_path: Path) -> None:
    """The slower axis goes pi/2 with 1 rad/s and 2 rad/s^2: d/v + v/a (Siciliano et al., section 4.2.1)."""
    found = asked("{path: [pi/2*s, -s], v_max: [1, 9], a_max: [2, 5]}", tmp_path)["evaluated"]
    assert found["time"] == pytest.approx(np.pi / 2 + 0.5, rel=1e-6)
    assert found["parameter"][-1] == 1 and found["t"][-1] == pytest.approx(found["time"], rel=1e-3)


def test_one_axis_without_a_limit_of_velocity(tmp_path: Path) -> None:
    """2 sqrt(d/a), whatever the parameter is."""
    for path in ("[3*u], parameter: u", "[u^2/3], parameter: u, range: [1, sqrt(10)]"):
        found = asked(f"{{path: {path}, a_max: [2]}}", tmp_path)["evaluated"]
        assert found["time"] == pytest.approx(2 * np.sqrt(3 / 2), rel=1e-4)


def program(first: Any, second: Any, v_max: Any, a_max: Any, ends: tuple[float, float], steps: int) -> float:
    """The greatest sum of b under all limits at both ends of each step, by a linear program."""
    s = np.linspace(*ends, steps + 1)
    step = s[1] - s[0]
    rows, right = [], []
    for k in range(steps):
        for place in (k, k + 1):
            for x, y, a in zip(first(s[place]), second(s[place]), a_max, strict=True):
                row = np.zeros(steps + 1)
                row[k + 1] += x / (2 * step)
                row[k] -= x / (2 * step)
                row[place] += y
                rows += [row, -row]
                right += [a, a]
    tops = [min((v / max(abs(x), 1e-9)) ** 2 for v, x in zip(v_max, first(each), strict=True)) for each in s]
    tops[0] = tops[-1] = 0.0
    found = linprog(-np.ones(steps + 1), np.array(rows), right, bounds=[(0, top) for top in tops])
    rates = np.sqrt(np.maximum(found.x, 0))
    return float((2 * step / (rates[1:] + rates[:-1])).sum())


@pytest.mark.parametrize("v", [0.8, 9.0])
def test_a_quarter_of_a_circle(v: float, tmp_path: Path) -> None:
    profile = f"{{path: [cos(s), sin(s)], range: [0, pi/2], v_max: [{v}, 1.5], a_max: [1, 1]}}"
    found = asked(profile, tmp_path)["evaluated"]
    theirs = program(
        lambda s: (-np.sin(s), np.cos(s)), lambda s: (-np.cos(s), -np.sin(s)), (v, 1.5), (1, 1),
        (0, np.pi / 2), 300,
    )  # fmt: skip
    assert found["time"] == pytest.approx(theirs, rel=2e-3)


@pytest.mark.parametrize(
    ("profile", "more", "said"),
    [
        ("{path: [s, s^2], a_max: [1]}", "law: path", "1 limits for 2 axes"),
        ("{path: [s, s^2], a_max: [1, 1], v_max: [2]}", "law: path", "1 limits for 2 axes"),
        ("{path: [90 deg*s, s], a_max: [1, 1]}", "law: path", "read as a unit"),
        ("{path: [u], a_max: [1]}", "law: path", "does not depend on 's'"),
        ("{path: [s], a_max: [-1]}", "law: path", "must be positive"),
        ("{path: [s], a_max: [a]}", "law: path", "no value is known for a"),
        ("{path: [s], range: [1, 0], a_max: [1]}", "law: path", "ends before it begins"),
        ("{path: [s], a_max: [1]}", "law: cubic", "with law: path"),
        ("{distance: 1, v_max: 1, a_max: 1}", "law: path", "no path is given"),
        ("{path: [s^3], range: [-1, 1], a_max: [1]}", "law: path", "stands still"),
    ],
)
def test_what_is_no_path_within_limits_is_said(profile: str, more: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        asked(profile, tmp_path, more)
    assert said in str(fault.value.errors[0])
