"""Exercises and examples with other numbers: a few of them, and those that once failed."""

from __future__ import annotations

import random
from functools import partial
from pathlib import Path

import pytest

from derive.build import build
from derive.errors import SheetErrors
from tests.mutants.units import forked, warmed
from tests.shaken import failed, shaken, shaken_units

EVERY = 29  # of the problems of one round
ONCE = {  # what failed, by what was wrong
    "a narrow sector is not as large as it looks": """
robot:
    links:
    - {theta: theta1*, d: 0 m, a: 0.61 m, alpha: 0, range: [54 deg, 111 deg]}
    - {theta: theta2*, d: 0 m, a: 0.51 m, alpha: 0, range: [33 deg, 180 deg]}
  find: workspace""",
    "a small region is drawn as it is listed": """
robot:
    links:
    - {theta: theta1*, d: 0.12 m, a: 0.47 m, alpha: 90 deg}
    - {theta: theta2*, d: 0.25 m, a: 0.52 m, alpha: -90 deg, range: [-161 deg, 25 deg]}
    - {theta: 0, d: d3*, a: 0.73 m, alpha: 0, range: [0.16 m, 0.59 m]}
  find: workspace""",
    "four joints leave gaps on a grid": """
robot:
    links:
    - {theta: theta1*, d: 0 m, a: 0.6 m, alpha: 0, range: [20 deg, 166 deg]}
    - {theta: theta2*, d: 0 m, a: 0.17 m, alpha: -90 deg, range: [-133 deg, 55 deg]}
    - {theta: 0, d: d3*, a: 0 m, alpha: 0, range: [0.28 m, 1.01 m]}
    - {theta: 0, d: d4*, a: 0.31 m, alpha: 90 deg, range: [0.17 m, 0.63 m]}
  find: workspace""",
    "an error of rounding ends an iteration": """
robot:
    links:
    - {theta: theta1*, d: 0, a: 1 m, alpha: 0}
    - {theta: theta2*, d: 0, a: 1.3 m, alpha: 0}
  find: numerical-inverse-kinematics
  target: [1.2 m, 0.82 m]
  start: {theta1: 0, theta2: 60 deg}""",
    "an arm with an oblique wrist may have every orientation": """
robot:
    links:
    - {theta: q1*, d: 0, a: 0, alpha: 90 deg}
    - {theta: q2*, d: 0, a: l1, alpha: 0}
    - {theta: q3*, d: 0, a: 0, alpha: 90 deg}
    - {theta: q4*, d: l2, a: 0, alpha: -90 deg}
    - {theta: q5*, d: 0, a: 0, alpha: 73.8 deg}
    - {theta: q6*, d: 0, a: 0, alpha: 0}
  find: workspace""",
    "a void is closed where the arm comes to the axis": """
robot:
    links:
    - {theta: theta1*, d: 0, a: 1 m, alpha: -90 deg}
    - {theta: theta2*, d: -0.98 m, a: 2 m, alpha: 90 deg}
    - {theta: theta3*, d: 0, a: 1.6 m, alpha: 0}
  find: workspace""",
    "the root of a square of cosines is positive": """
robot:
    links:
    - {theta: theta1*, d: 0, a: 0, alpha: 58 deg}
    - {theta: theta2*, d: 0, a: 0, alpha: -58 deg}
    - {theta: theta3*, d: d6, a: 0, alpha: 0}
  find: workspace""",
    "a fraction in a line keeps its sum together": """
robot:
    links:
    - {theta: theta1*, d: 0, a: 0, alpha: 101 deg}
    - {theta: theta2*, d: 0, a: 0, alpha: -60 deg}
    - {theta: theta3*, d: d6, a: 0, alpha: 0}
  find: workspace""",
    "a link of negative length has no triangle": """
robot:
    links:
    - {theta: theta1*, d: 0, a: 0.45 m, alpha: 0}
    - {theta: theta2*, d: 0, a: -0.39 m, alpha: 0}
  find: inverse-kinematics""",
    "numbers for some of the names, and sines that are no fractions": """
robot:
    links:
    - {theta: q1*, d: 0, a: 0, alpha: -108 deg}
    - {theta: 0, d: q2*, a: 0, alpha: 90 deg}
    - {theta: q3*, d: 0, a: L, alpha: 0}
  find: redundancy
  rows: [vx, vy]
  evaluate: {q1: 0, q3: 90 deg}""",
}
AT_THE_AXIS = """
robot:
    links:
    - {theta: theta1*, d: 0 m, a: 0.81 m, alpha: 0}
    - {theta: theta2*, d: 0 m, a: 0.73 m, alpha: 0}
    - {theta: theta3*, d: 0 m, a: 0.2 m, alpha: 0, range: [9 deg, 168 deg]}
  find: workspace"""


def _written(problem: str, folder: Path) -> Path:
    path = folder / "sheet.yaml"
    path.write_text(f"title: T\nproblems:\n- {problem.strip()}\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("problem", ONCE.values(), ids=ONCE)
def test_what_once_failed_is_built(problem: str, tmp_path: Path) -> None:
    (page,) = build([_written(problem, tmp_path)], ["md"], tmp_path)[:1]
    assert Path(page).exists()


def test_a_point_that_reaches_the_axis_has_no_distance_from_it(tmp_path: Path) -> None:
    build([_written(AT_THE_AXIS, tmp_path)], ["md"], tmp_path)
    assert r"r_{\mathrm{min}} = 0" in (tmp_path / "sheet.md").read_text(encoding="utf-8").replace(
        r"\rho", "r"
    )


def test_a_length_that_is_positive_is_given_no_negative_value(tmp_path: Path) -> None:
    sheet = _written(
        "robot: {links: [{theta: q1*, d: 0, a: a1, alpha: 0}, {theta: q2*, d: 0, a: a2, alpha: 0}]}\n"
        "  symbols: {a1: positive}\n  find: workspace\n  evaluate: {a1: -0.6 m, a2: 1 m}",
        tmp_path,
    )
    with pytest.raises(SheetErrors) as wrong:
        build([sheet], ["md"], tmp_path)
    assert "a1 is positive by symbols" in wrong.value.errors[0].message


def test_numbers_are_changed_and_nothing_else() -> None:
    text = "links: [{theta: q1*, a: 0.25 m, alpha: 90 deg, frame: 2}]  # x^2, a_1"
    found = shaken(text, random.Random(3))
    assert found != text
    assert [part for part in found if not part.isdigit() and part not in "-."] == [
        part for part in text if not part.isdigit() and part not in "-."
    ]
    assert "frame: 2" in found and "x^2, a_1" in found


def test_problems_with_other_numbers_are_built_or_refused(tmp_path: Path) -> None:
    assert forked(partial(_failures, tmp_path), 600.0) == []


def _failures(folder: Path) -> list[str]:
    warmed()
    return [message for unit in [*shaken_units(folder, 7, 1)][::EVERY] if (message := failed(unit))]
