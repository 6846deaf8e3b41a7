"""Workspaces within limits, against integrals of the determinant of the Jacobian in SciPy, and places in
NumPy."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import dblquad, tplquad

from derive.audit.text import sympy_of_text
from derive.errors import SheetErrors
from tests.sheets import pages

POLAR = "{theta: q1*, d: 0, a: 0, alpha: 90 deg%s}, {theta: 0, d: d2*, a: 0, alpha: 0%s}"
SPHERICAL = (
    "{theta: q1*, d: 0, a: 0, alpha: -90 deg%s}, {theta: q2*, d: 0, a: 0, alpha: 90 deg%s}, "
    "{theta: 0, d: d3*, a: 0, alpha: 0%s}"
)
RAIL = "{theta: 0, d: d1*, a: 0, alpha: -90 deg%s}, {theta: q2*, d: 0, a: 0.4 m, alpha: 0}"
TELESCOPE = (
    "{theta: q1*, d: 0, a: 0, alpha: 90 deg}, {theta: 0, d: d2*, a: 0, alpha: -90 deg%s}, "
    "{theta: q3*, d: 0, a: 0.2 m, alpha: 0}"
)
LINKS = "{theta: q1*, d: 0, a: 0.5 m, alpha: 0%s}, {theta: q2*, d: 0, a: 0.3 m, alpha: 0%s}"
SCARA = (
    "{theta: q1*, d: 0, a: 0.35 m, alpha: 0}, {theta: q2*, d: 0, a: 0.25 m, alpha: 180 deg}, "
    "{theta: 0, d: d3*, a: 0, alpha: 0%s}, {theta: q4*, d: 0, a: 0, alpha: 0}"
)


def found(links: str, folder: Path, *ranges: str) -> dict[str, Any]:
    """The results, in numbers where they are formulas."""
    rows = links % tuple(f", range: {each}" if each else "" for each in ranges)
    sheet = folder / "sheet.yaml"
    sheet.write_text(
        f"title: A test\nproblems:\n- robot: {{links: [{rows}]}}\n  find: workspace\n", encoding="utf-8"
    )
    (path,) = (each for each in pages(sheet, folder, "json") if each.suffix == ".json")
    results: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))["problems"][0]["questions"][0][
        "results"
    ]
    return {
        name: value if name == "description" else float(sympy_of_text(value, {}))
        for name, value in results.items()
    }


def test_a_sector_is_as_large_as_its_jacobian_says(tmp_path: Path) -> None:
    told = found(POLAR, tmp_path, "[-30 deg, 100 deg]", "[0.3 m, 0.8 m]")
    turn = math.radians(130)
    area, _ = dblquad(lambda d, q: d, 0, turn, 0.3, 0.8)  # |det J| = d2
    assert told["area"] == pytest.approx(area)
    assert (told["r_min"], told["r_max"]) == (0.3, 0.8)
    whole = found(POLAR, tmp_path, "[-200 deg, 200 deg]", "[-0.3 m, 0.8 m]")
    assert (whole["r_min"], whole["r_max"]) == (0, 0.8)
    assert whole["area"] == pytest.approx(math.pi * 0.64)


def test_a_part_of_a_ball_is_as_large_as_its_jacobian_says(tmp_path: Path) -> None:
    told = found(SPHERICAL, tmp_path, "[-90 deg, 45 deg]", "[30 deg, 120 deg]", "[0.4 m, 1 m]")
    low, high = math.radians(30), math.radians(120)
    volume, _ = tplquad(lambda d, t, q: d * d * math.sin(t), 0, math.radians(135), low, high, 0.4, 1)
    assert told["volume"] == pytest.approx(volume)
    over = found(SPHERICAL, tmp_path, "", "[-30 deg, 120 deg]", "[0.4 m, 1 m]")  # past the pole, whole turns
    volume, _ = tplquad(lambda d, t, q: d * d * math.sin(t), 0, math.tau, 0, high, 0.4, 1)
    assert over["volume"] == pytest.approx(volume)


@pytest.mark.parametrize("rail", [0.5, 0.9])
def test_what_a_rail_sweeps_is_counted(rail: float, tmp_path: Path) -> None:
    told = found(RAIL, tmp_path, f"[0.1 m, {0.1 + rail:.1f} m]")
    x, y = np.random.default_rng(1).random((2, 400_000)) * np.array([[rail + 0.8], [0.8]]) - 0.4
    d = np.linspace(0, rail, 101)
    near = np.zeros(x.size, dtype=bool)
    off = np.hypot(x - d[0], y) - 0.4
    for each in d[1:]:  # between two places of the carriage the circle passes the point
        there = np.hypot(x - each, y) - 0.4
        near |= off * there <= 0
        off = there
    assert told["area"] == pytest.approx(near.mean() * (rail + 0.8) * 0.8, rel=0.02)


def test_a_telescope_between_two_turns(tmp_path: Path) -> None:
    told = found(TELESCOPE, tmp_path, "[0.3 m, 0.8 m]")
    assert (told["r_min"], told["r_max"]) == pytest.approx((0.1, 1.0))
    folded = found(TELESCOPE, tmp_path, "[0.1 m, 0.8 m]")
    assert folded["r_min"] == 0
    assert folded["area"] == pytest.approx(math.pi)


def test_a_lift_makes_a_body(tmp_path: Path) -> None:
    told = found(SCARA, tmp_path, "[0.1 m, 0.3 m]")
    assert told["volume"] == pytest.approx(0.2 * math.pi * (0.6**2 - 0.1**2))


def test_two_links_that_bend_to_one_side(tmp_path: Path) -> None:
    told = found(LINKS, tmp_path, "[-40 deg, 100 deg]", "[30 deg, 120 deg]")
    turn, low, high = (math.radians(each) for each in (140, 30, 120))
    area, _ = dblquad(lambda q2, q1: 0.5 * 0.3 * math.sin(q2), 0, turn, low, high)  # |det J|
    assert told["area"] == pytest.approx(area)
    r = [math.sqrt(0.34 + 0.3 * math.cos(q)) for q in (high, low)]
    assert (told["r_min"], told["r_max"]) == pytest.approx(tuple(r))
    both = found(LINKS, tmp_path, "[-40 deg, 100 deg]", "[-30 deg, 120 deg]")
    assert (both["r_min"], both["r_max"], "area" in both) == (pytest.approx(r[0]), pytest.approx(0.8), False)


def test_what_is_without_end_is_said_so(tmp_path: Path) -> None:
    assert found(POLAR, tmp_path, "", "") == {"r_min": 0, "description": "the whole plane"}
    assert found(RAIL, tmp_path, "")["description"] == "a strip along the slide without end"


def test_ranges_that_are_not_honoured_are_refused(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        found(TELESCOPE.replace("a: 0.2 m, alpha: 0}", "a: 0.2 m, alpha: 0, range: [0, 1]}"), tmp_path, "")
    assert "not derived yet" in str(caught.value.errors[0])
