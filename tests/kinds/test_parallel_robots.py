"""Motors of parallel robots against the published algorithm for Delta robots and circles of a five-bar."""

from __future__ import annotations

from math import atan, cos, degrees, hypot, pi, radians, sin, sqrt, tan
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.build import derive_all
from derive.errors import SheetErrors
from derive.expression import number
from derive.figures.bars import five_bar
from derive.mechanics.linkages import FiveBar
from derive.sheet.load import load_sheet
from tests.kinds.test_linkages import solved
from tests.sheets import pages

SIDE_E, SIDE_F, FOREARM, ARM = 115.0, 457.3, 232.0, 112.0
SQUARE = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
TAN30 = tan(pi / 6)


def by_trossen(x: float, y: float, z: float) -> float:
    """The angle of the arm in the plane of y and z (Maxim Zavatsky's tutorial), in degrees."""
    pivot = -0.5 * TAN30 * SIDE_F
    y -= 0.5 * TAN30 * SIDE_E
    a = (x * x + y * y + z * z + ARM**2 - FOREARM**2 - pivot**2) / (2 * z)
    b = (pivot - y) / z
    d = -((a + b * pivot) ** 2) + ARM * (b * b * ARM + ARM)
    along = (pivot - a * b - sqrt(d)) / (b * b + 1)
    up = a + b * along
    return degrees(atan(-up / (pivot - along))) + (180 if along > pivot else 0)


@pytest.mark.parametrize("place", [(0, 0, -200), (30, -20, -200), (-40, 55, -230), (10, 80, -180)])
def test_a_delta_robot(tmp_path: Path, place: tuple[float, float, float]) -> None:
    x, y, z = place
    base, platform = (0.5 * TAN30 * side for side in (SIDE_F, SIDE_E))
    given = f"{{delta: {{base: {base!r}, platform: {platform!r}, arm: {ARM}, forearm: {FOREARM}}}}}"
    found = solved(tmp_path, given, "inverse-kinematics", f"{{x: {x}, y: {y}, z: {z}}}")
    outside = [next(iter(each.values())) for each in found if each["when"][0].key == "outside"]
    # There the first arm points along -y, and the others follow at 120 degrees.
    theirs = []
    for k in range(3):
        turn = radians(120 * k)
        along, across = x * cos(turn) + y * sin(turn), -x * sin(turn) + y * cos(turn)
        theirs.append(by_trossen(across, -along, z))
    assert [degrees(angle) for angle in outside] == pytest.approx(theirs, abs=1e-6)


def test_a_five_bar(tmp_path: Path) -> None:
    given = "{five-bar: {cranks: [1, 1.2], couplers: [1.5, 1.3], ground: 0.8}}"
    found = solved(tmp_path, given, "inverse-kinematics", "{x: 0.5, y: 1.6}")
    for leg, (crank, coupler, foot) in enumerate(((1, 1.5, 0), (1.2, 1.3, 0.8)), 1):
        angles = [each[f"theta_{leg}"] for each in found if f"theta_{leg}" in each]
        assert len(angles) == 2
        for angle in angles:
            end = complex(foot + crank * cos(angle), crank * sin(angle))
            assert abs(end - (0.5 + 1.6j)) == pytest.approx(coupler)


@pytest.mark.parametrize("convention", ["ZYX", "xyz", "ZYZ"])
def test_legs_of_a_platform(tmp_path: Path, convention: str) -> None:
    base = [[2, 1, 0], [-2, 1, 0.5], [0, -2, 0], [1, 1, 1]]
    platform = [[1, 0, 0.2], [-1, 0, 0], [0, -1, 0], [0.5, 0.5, 0]]
    lines = [
        "title: x", "problems:", f"- mechanism: {{stewart: {{base: {base}, platform: {platform}}}}}",
        "  find: inverse-kinematics", "  position: [0.1, -0.2, 1.5]",
        "  orientation: [20 deg, -15 deg, 40 deg]",
        f"  convention: {convention}", "  evaluate: true",
    ]  # fmt: skip
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text("\n".join(lines) + "\n", encoding="utf-8")
    (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
    ((_, question),) = document.questions()
    assert question.derivation
    R = Rotation.from_euler(convention, [20, -15, 40], degrees=True).as_matrix()
    legs = np.array([0.1, -0.2, 1.5]) + np.array(platform) @ R.T - np.array(base)
    for k, leg in enumerate(legs, 1):
        assert question.derivation.evaluated[f"L_{k}"] == pytest.approx(leg)
        assert question.derivation.evaluated[f"l_{k}"] == pytest.approx(np.linalg.norm(leg))


def test_a_five_bar_there_and_back(tmp_path: Path) -> None:
    given = "{five-bar: {cranks: [1, 1.2], couplers: [1.5, 1.3], ground: 0.8}}"
    ways = solved(tmp_path, given, "position", "{theta_1: 120 deg, theta_2: 60 deg}")
    assert len(ways) == 2
    for way in ways:
        back = solved(tmp_path, given, "inverse-kinematics", f"{{x: {way['x']!r}, y: {way['y']!r}}}")
        for leg, angle in ((1, 120), (2, 60)):
            found = [degrees(each[f"theta_{leg}"]) for each in back if f"theta_{leg}" in each]
            assert min(abs(each - angle) for each in found) < 1e-6


def test_a_five_bar_is_drawn_to_its_lengths() -> None:
    sizes = (number(10), number(12), number(15), number(13), number(8))
    drawing = five_bar(FiveBar(sizes[:2], sizes[2:4], sizes[4]))
    links = [stroke.places for stroke in drawing.strokes if stroke.role == "link"]
    lengths = [hypot(b[0] - a[0], b[1] - a[1]) for a, b in links]
    assert [each / lengths[0] for each in lengths] == pytest.approx([1, 1.2, 1.5, 1.3])
    assert links[2][1] == links[3][1]


def test_rates_of_legs_and_motors_by_differences(tmp_path: Path) -> None:
    """The motors of two near points, by inverse kinematics, have the rates that the Jacobians give."""
    robot = "{five-bar: {cranks: [1, 1.2], couplers: [1.5, 1.3], ground: 0.8}}"
    step, way = 1e-5, (0.6, -0.8)

    def angles(side: int) -> list[float]:
        x, y = (c + side * step * w for c, w in zip((0.5, 1.6), way, strict=True))
        found = solved(tmp_path, robot, "inverse-kinematics", f"{{x: {x!r}, y: {y!r}}}")
        return [
            each[name] for each in found for name in each if each["when"][0].key == "left" and name != "when"
        ]

    rates = [(a - b) / (2 * step) for a, b in zip(angles(1), angles(-1), strict=True)]
    here = [(a + b) / 2 for a, b in zip(angles(1), angles(-1), strict=True)]
    lines = [
        "title: x", "problems:", f"- mechanism: {robot}", "  find: jacobian",
        f"  evaluate: {{x: 0.5, y: 1.6, theta_1: {here[0]!r}, theta_2: {here[1]!r}}}",
    ]  # fmt: skip
    sheet = tmp_path / "jacobian.yaml"
    sheet.write_text("\n".join(lines) + "\n", encoding="utf-8")
    (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
    ((_, question),) = document.questions()
    assert question.derivation
    J_x, J_q = (np.array(question.derivation.evaluated[name]) for name in ("J_x", "J_q"))
    assert J_x @ np.array(way) == pytest.approx(J_q @ np.array(rates), abs=1e-6)


@pytest.mark.parametrize(
    ("mechanism", "message"),
    [
        ("{five-bar: {cranks: [1, 0], couplers: [1, 1], ground: 1}}", "the crank must be positive"),
        ("{five-bar: {cranks: [1], couplers: [1, 1], ground: 1}}", ""),
        ("{delta: {base: 1, platform: 1, arm: -1, forearm: 3}}", "the arm must be positive"),
        ("{delta: {base: 9, platform: 1, arm: 1, forearm: 2}}", "no position was found"),
        ("{stewart: {base: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], platform: [[0, 0, 0], [1, 0, 0]]}}", ""),
        (f"{{stewart: {{base: {SQUARE}, platform: {SQUARE[:3]}}}}}", "4 legs begin and 3 end"),
        ("{four-bar: {crank: a, coupler: b, rocker: c, ground: d}}", "several motors"),
    ],
)
def test_what_has_no_such_motors(tmp_path: Path, mechanism: str, message: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        solved(tmp_path, mechanism, "inverse-kinematics", "{}")
    assert any(message in each.message for each in caught.value.errors)


def test_equal_couplers_folded_leave_a_circle(tmp_path: Path) -> None:
    """The ends of the cranks coincide where couplers that are equally long are folded, and only there."""
    for couplers, circles in (("b, b", 1), ("b_1, b_2", 0), ("2, 3", 0)):
        sheet = tmp_path / f"sheet{circles}{len(couplers)}.yaml"
        mechanism = f"{{five-bar: {{cranks: [a, a], couplers: [{couplers}], ground: d}}}}"
        sheet.write_text(
            f"title: x\nproblems:\n- mechanism: {mechanism}\n  find: singularities\n", encoding="utf-8"
        )
        (page,) = (each for each in pages(sheet, tmp_path, "md") if each.suffix == ".md")
        text = page.read_text(encoding="utf-8")
        assert text.count("may go all around them") == circles
        assert text.count("and the two assemblies meet.") == 2 - circles
