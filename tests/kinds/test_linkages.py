"""Four-bar linkages and slider-cranks against Norton's examples and against SciPy's roots of the loop."""

from __future__ import annotations

from math import cos, degrees, hypot, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import fsolve

from derive.build import derive_all
from derive.errors import SheetErrors
from derive.expression import number
from derive.figures.bars import drawn
from derive.mechanics.linkages import FourBar, SliderCrank
from derive.sheet.load import load_sheet
from derive.writing import render

FOUR = "{four-bar: {crank: 40, coupler: 120, rocker: 80, ground: 100}}"
SLIDER = "{slider-crank: {crank: 40, rod: 120, offset: -20}}"


def solved(tmp_path: Path, mechanism: str, find: str, evaluate: str = "") -> list[dict[str, Any]]:
    """The solutions at a point."""
    sheet = tmp_path / "sheet.yaml"
    lines = ["title: x", "problems:", f"- mechanism: {mechanism}", f"  find: {find}"]
    sheet.write_text("\n".join([*lines, f"  evaluate: {evaluate or 'true'}"]) + "\n", encoding="utf-8")
    (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
    ((_, question),) = document.questions()
    assert question.derivation
    assert all(claim.holds for claim in question.derivation.claims)
    found: list[dict[str, Any]] = question.derivation.evaluated["solutions"]
    return found


def test_nortons_four_bar(tmp_path: Path) -> None:
    crossed, opened = solved(tmp_path, FOUR, "velocity", "{theta_2: 40 deg, theta_2_dot: 25}")
    assert [degrees(opened[name]) for name in ("theta_3", "theta_4")] == pytest.approx(
        [20.298, 57.325], abs=2e-3
    )
    assert [degrees(crossed[name]) for name in ("theta_3", "theta_4")] == pytest.approx(
        [-60.98, -98.01], abs=2e-2
    )
    assert [opened[name] for name in ("theta_3_dot", "theta_4_dot")] == pytest.approx(
        [-4.121, 6.998], abs=1e-3
    )


def test_nortons_slider_crank(tmp_path: Path) -> None:
    # Norton's angle of the rod is that from the slider to the crank, 152.91 degrees.
    out, inner = solved(tmp_path, SLIDER, "position", "{theta_2: 60 deg}")
    assert (degrees(out["theta_3"]) + 180, out["s"]) == pytest.approx((152.91, 126.84), abs=1e-2)
    assert (degrees(inner["theta_3"]) + 180, inner["s"]) == pytest.approx((27.09, -86.84), abs=1e-2)


@pytest.mark.parametrize("angle", [-170, -35, 0, 90, 144])
@pytest.mark.parametrize("bars", [(1, 2.5, 2, 3), (2, 2, 2, 2.5), (3, 1.5, 2.5, 1)])
def test_the_loop_by_scipy(tmp_path: Path, angle: float, bars: tuple[float, ...]) -> None:
    a, b, c, d = bars
    given = f"{{four-bar: {{crank: {a}, coupler: {b}, rocker: {c}, ground: {d}}}}}"
    theta = radians(angle)

    def gap(unknown: Any) -> list[float]:
        third, fourth = unknown
        return [
            a * cos(theta) + b * cos(third) - d - c * cos(fourth),
            a * sin(theta) + b * sin(third) - c * sin(fourth),
        ]

    for each in solved(tmp_path, given, "position", f"{{theta_2: {angle} deg}}"):
        if each.get("real", True):
            here = [each["theta_3"], each["theta_4"]]
            assert fsolve(gap, [value + 0.01 for value in here]) == pytest.approx(here, abs=1e-6)


@pytest.mark.parametrize("bars", [(1, 2.5, 2, 3), (2, 2, 2, 2.5), (3, 1.6, 2.5, 1), (2, 2, 3, 2.1)])
def test_the_crank_ends_where_bars_lie_in_line(tmp_path: Path, bars: tuple[float, ...]) -> None:
    """A scan of all its angles: the linkage begins or ends to be one at the places that were found."""
    a, b, c, d = bars
    given = f"{{four-bar: {{crank: {a}, coupler: {b}, rocker: {c}, ground: {d}}}}}"
    found = solved(tmp_path, given, "singularities")
    t = np.linspace(-np.pi, np.pi, 5000)
    reach = np.abs(a * np.exp(1j * t) - d)
    able = (abs(b - c) <= reach) & (reach <= b + c)
    ends = t[:-1][np.diff(able.astype(int)) != 0]
    toggles = [each["theta_2"] for each in found if each["when"][0].key.startswith("toggle")]
    assert sorted(toggles) == pytest.approx(sorted(ends), abs=2e-3)
    for each in found:
        if each["when"][0].key.startswith("limit"):
            bars_in_line = [abs(abs((a + s * b) * np.exp(1j * each["theta_2"]) - d) - c) for s in (1, -1)]
            assert min(bars_in_line) < 1e-9


@pytest.mark.parametrize(
    ("linkage", "lengths"),
    [
        (FourBar(number(40), number(120), number(80), number(100)), [40, 120, 80]),
        (FourBar(number(3), number(2), number(3), number(1)), [3, 2, 3]),
        (SliderCrank(number(40), number(120), number(-20)), [40, 120]),
    ],
)
def test_bars_are_drawn_as_long_as_they_are(linkage: FourBar | SliderCrank, lengths: list[float]) -> None:
    links = [stroke.places for stroke in drawn(linkage).strokes if stroke.role == "link"]
    sizes = [hypot(b[0] - a[0], b[1] - a[1]) for a, b in links]
    assert [size / sizes[0] for size in sizes] == pytest.approx([each / lengths[0] for each in lengths])
    assert links[0][1] == links[1][0]
    assert len(links) < 3 or links[1][1] == links[2][1]


@pytest.mark.parametrize(
    ("mechanism", "find", "message"),
    [
        ("{four-bar: {crank: 1, coupler: 1, rocker: 1, ground: 9}}", "position", "can be joined"),
        ("{four-bar: {crank: 0, coupler: 1, rocker: 1, ground: 2}}", "position", "must be positive"),
        ("{four-bar: {crank: -1, coupler: 1, rocker: 1, ground: 2}}", "velocity", "must be positive"),
        ("{four-bar: {crank: 1, coupler: 1, rocker: 1}}", "position", "missing"),
        ("{slider-crank: {crank: 1, rod: 2, offset: 4}}", "position", "can be joined"),
        ("{slider-crank: {crank: 1, rod: 2, angle: 3 m}}", "position", "an angle"),
        ("{slider-crank: {crank: a, rod: b}, four-bar: {}}", "position", ""),
        ("{slider-crank: {crank: a, rod: b}}", "mobility", "bodies and joints are counted"),
        (
            "{space: planar, bodies: 4, joints: [{revolute: 4}]}",
            "position",
            "lengths of the bars are missing",
        ),
    ],
)
def test_what_cannot_be_joined(tmp_path: Path, mechanism: str, find: str, message: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        solved(tmp_path, mechanism, find, "{}")
    assert any(message in each.message for each in caught.value.errors)


@pytest.mark.parametrize(
    ("bars", "around"), [((30, 50, 45, 60), True), ((50, 30, 45, 60), False), ((2, 2, 2, 2.5), False)]
)
def test_the_ends_of_a_rocker(tmp_path: Path, bars: tuple[float, ...], around: bool) -> None:
    """A scan of all angles of the crank: whether it turns all round, and between which angles the rocker
    goes then."""
    a, b, c, d = bars
    given = f"{{four-bar: {{crank: {a}, coupler: {b}, rocker: {c}, ground: {d}}}}}"
    found = solved(tmp_path, given, "singularities")
    (document,) = derive_all([load_sheet(tmp_path / "sheet.yaml")], True, lambda _: None)
    assert ("it can turn all the way round" in render(document, "md")) == around
    ends = [abs(each["theta_4"]) for each in found if "theta_4" in each]
    if around:
        A = a * np.exp(1j * np.linspace(0, 2 * np.pi, 20001)) - d
        turns = np.angle(A) + np.arccos((abs(A) ** 2 + c**2 - b**2) / (2 * c * abs(A)))
        turns = np.abs(np.angle(np.exp(1j * turns)))
        assert sorted({round(end, 6) for end in ends}) == pytest.approx([turns.min(), turns.max()], abs=1e-4)


def test_the_ends_of_a_slider(tmp_path: Path) -> None:
    found = solved(tmp_path, SLIDER, "singularities")
    t = np.linspace(0, 2 * np.pi, 20001)
    outwards = 40 * np.cos(t) + np.sqrt(120**2 - (-20 - 40 * np.sin(t)) ** 2)
    ends = sorted(each["s"] for each in found if each["s"] > 0)
    assert ends == pytest.approx([outwards.min(), outwards.max()], abs=1e-4)
