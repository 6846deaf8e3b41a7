"""Joints on a path against a published posture and SciPy's roots; and paths that no joints follow."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import fsolve

from derive.audit.text import sympy_of_text
from derive.build import derive_all
from derive.derivation import Phrase
from derive.errors import SheetErrors
from derive.kinds.robot._carried import integrated
from derive.sheet.load import load_sheet
from tests.sheets import ROOT, pages

T = sympy.Symbol("t")
SHEET = """
title: An arm
problems:
- robot:
    links:
LINKS
  questions:
  - find: joint-motion
    path: PATH
    MORE
"""
THREE = "\n".join(f"    - {{theta: q{k}*, d: 0, a: 0.5, alpha: 0}}" for k in (1, 2, 3))
TWO = "\n".join(f"    - {{theta: q{k}*, d: 0, a: {a}, alpha: 0}}" for k, a in ((1, 0.5), (2, 0.4)))
# Siciliano et al., section 3.7.4
CIRCLE = '"0.25*(1 - cos(pi*t))", "0.25*(2 + sin(pi*t))", "sin(pi*t/24)"'
AROUND = f"{{function: [{CIRCLE}], parameter: t, range: [0, 4]}}"
LINE = "{line: {from: [0.2, 0.3], to: [0.5, 0.5]}, timing: {law: cubic, time: 2}}"
LONG = np.sqrt(0.13)
STRAIGHT = "{line: {from: [0.2, 0.3], to: [0.5, 0.5]}, timing: {law: LAW}}"


def question(links: str, path: str, more: str, folder: Path) -> dict[str, Any]:
    sheet = folder / "arm.yaml"
    text = SHEET.replace("LINKS", links).replace("PATH", path).replace("MORE", more)
    sheet.write_text(text, encoding="utf-8")
    (page,) = pages(sheet, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]
    return found


def joints(texts: dict[str, list[str]]) -> Any:
    """q, its rates and accelerations (3 by n) as functions of the time alone."""
    trees = [[sympy_of_text(text, {"t": T}) for text in texts[key]] for key in ("q", "qdot", "qddot")]
    assert {name for row in trees for tree in row for name in tree.free_symbols} <= {T}
    return sympy.lambdify(T, trees, "numpy")


def tip(q: Any, lengths: Any) -> Any:
    """Where a planar arm ends, and at which angle."""
    sums = np.cumsum(q)
    return np.array([np.dot(lengths, np.cos(sums)), np.dot(lengths, np.sin(sums)), sums[-1]])


def test_the_published_posture_and_the_roots_of_scipy(tmp_path: Path) -> None:
    more = "start: {q1: pi, q2: -pi/2, q3: -pi/2}"
    at = joints(question(THREE, AROUND, more, tmp_path)["results"])
    assert np.allclose(at(0.0)[0], [np.pi, -np.pi / 2, -np.pi / 2])
    q, h = np.array(at(0.0)[0]), 1e-4
    for t in np.linspace(0, 4, 81)[1:-1]:
        wanted = [0.25 * (1 - np.cos(np.pi * t)), 0.25 * (2 + np.sin(np.pi * t)), np.sin(np.pi * t / 24)]
        q = fsolve(lambda each, to=wanted: tip(each, [0.5] * 3) - to, q, xtol=1e-11)
        ours, before, after = (np.array(at(t + k * h), dtype=float) for k in (0, -1, 1))
        assert np.allclose(np.exp(1j * ours[0]), np.exp(1j * q))
        assert np.allclose(ours[1], np.angle(np.exp(1j * (after[0] - before[0]))) / (2 * h), atol=1e-5)
        assert np.allclose(ours[2], (after[1] - before[1]) / (2 * h), atol=1e-4)


@pytest.mark.parametrize(
    ("law", "speed"),
    [
        ("cubic, time: 2", lambda t: 6 * t / 4 - 6 * t**2 / 8),
        ("quintic, time: 2", lambda t: 30 * t**2 / 8 - 60 * t**3 / 16 + 30 * t**4 / 32),
        ("trapezoidal, time: 2, v_max: 0.25", lambda t: 0.25 / LONG * min(t / (2 - LONG / 0.25), 1)),
    ],
)  # fmt: skip
def test_rates_give_the_velocity_of_each_law(law: str, speed: Any, tmp_path: Path) -> None:
    found = question(TWO, STRAIGHT.replace("LAW", law), "evaluate: {t: 0.4}", tmp_path)
    q, rates, _ = (np.array(found["evaluated"][key]) for key in ("q", "qdot", "qddot"))
    h = 1e-6
    moved = (tip(q + h * rates, [0.5, 0.4]) - tip(q - h * rates, [0.5, 0.4])) / (2 * h)
    assert np.allclose(moved[:2], np.array([0.3, 0.2]) * speed(0.4), atol=1e-4)
    assert q[1] > 0  # the first of the solutions


def test_the_points_of_a_spline_are_passed(tmp_path: Path) -> None:
    path = "{via: [[0.2, 0.3], [0.4, 0.4], [0.5, 0.3]], times: [0, 1, 2]}"
    at = joints(question(TWO, path, "", tmp_path)["results"])
    spline = CubicSpline([0, 1, 2], [[0.2, 0.3], [0.4, 0.4], [0.5, 0.3]], bc_type="clamped")
    for t in np.linspace(0.05, 1.95, 17):
        q, rates, rises = map(np.array, at(t))
        assert np.allclose(tip(q, [0.5, 0.4])[:2], spline(t))
        h = 1e-5
        ahead, behind = (tip(q + k * h * rates + h * h / 2 * rises, [0.5, 0.4])[:2] for k in (1, -1))
        assert np.allclose((ahead - behind) / (2 * h), spline(t, 1), atol=1e-7)
        assert np.allclose((ahead - 2 * spline(t) + behind) / h**2, spline(t, 2), atol=1e-4)


def test_least_rates_integrated_by_scipy(tmp_path: Path) -> None:
    more = "start: {q1: pi, q2: -pi/2, q3: -pi/2}\n    method: inverse-velocity"
    around = AROUND.replace(', "sin(pi*t/24)"', "")
    found = {
        key: np.array(each) for key, each in question(THREE, around, more, tmp_path)["evaluated"].items()
    }

    def rates(t: float, q: Any) -> Any:
        sums = np.cumsum(q)
        J = [[-0.5 * np.sin(sums[k:]).sum(), 0.5 * np.cos(sums[k:]).sum()] for k in range(3)]
        v = 0.25 * np.pi * np.array([np.sin(np.pi * t), np.cos(np.pi * t)])
        return np.linalg.lstsq(np.array(J).T, v, rcond=None)[0]

    start = [np.pi, -np.pi / 2, -np.pi / 2]
    theirs = solve_ivp(rates, (0, 4), start, "DOP853", found["t"], rtol=1e-11, atol=1e-12)
    assert np.allclose(found["q"], theirs.y.T, atol=1e-6)
    assert np.allclose(found["qdot"], [rates(*each) for each in zip(found["t"], found["q"], strict=True)])
    h = 1e-5
    for t, q, rate, rise in zip(*(found[key] for key in ("t", "q", "qdot", "qddot")), strict=True):
        ends = (rates(t + k * h, q + k * h * rate) for k in (1, -1))
        assert np.allclose(rise, np.subtract(*ends) / (2 * h), atol=1e-4)


@pytest.mark.parametrize(
    ("ranges", "said"),
    [
        (("[-180 deg, 180 deg]", "[-150 deg, 0]"), ("q_2$ < 0", "All joints keep their ranges")),
        (("[-180 deg, 180 deg]", "[80 deg, 140 deg]"), ("q_2$ > 0", "leaves its range** at")),
        (("[-1 deg, 1 deg]", "[0, 140 deg]"), ("q_2$ > 0", "begins beyond its range")),
    ],
)
def test_joints_within_their_ranges(ranges: tuple[str, str], said: tuple[str, ...], tmp_path: Path) -> None:
    links = TWO.replace("alpha: 0}", "alpha: 0, range: LIMITS}")
    for each in ranges:
        links = links.replace("LIMITS", each, 1)
    text = SHEET.replace("LINKS", links).replace("PATH", LINE).replace("MORE", "")
    sheet = tmp_path / "arm.yaml"
    sheet.write_text(text, encoding="utf-8")
    told = next(page for page in pages(sheet, tmp_path / "out", "md") if page.suffix == ".md").read_text()
    assert said[0].replace("$", "") in told and said[1] in told


@pytest.mark.parametrize(
    ("path", "more", "said"),
    [
        ("{line: {from: [0.2, 0.3], to: [0.5, 0.5]}}", "", "not given: add timing"),
        (LINE.replace("0.5, 0.5", "0.9, 0.5"), "", "out of reach of the arm at t ="),
        (LINE.replace("0.2, 0.3", "0.9, 0"), "", "singular on the path at t = 0"),
        (LINE, "start: {q1: 0}", "start gives no value to q2"),
        (LINE, "start: {q1: 0, q2: 1, q3: 1}", "'q3' under start is no joint variable"),
        (LINE, "evaluate: {t: 3}", "the motion lasts from t = 0 s to 2 s"),
        ("{line: {from: [0, 0, 0], to: [1, 1, 1]}, timing: {law: cubic, time: 2}}", "", "has 3 coordinates"),
        ("{line: {from: [0, 0], to: [0, 0]}, timing: {law: cubic, time: 2}}", "", "ends where it starts"),
        ("{circle: {center: [0, 0]}}", "", "how large it is"),
        ("[1, 2]", "", "line:"),
        (LINE, "method: inverse-velocity", "add start"),
        (LINE, "method: inverse-velocity\n    evaluate: {t: 1}", "leave t out"),
        (LINE, "method: inverse-velocity\n    start: {q1: 0, q2: 90 deg}", "from where the path begins"),
        (AROUND, "method: inverse-velocity\n    start: {q1: 0, q2: 90 deg}", "2 joints cannot follow 3"),
        (LINE.replace("0.5, 0.5", "0.5, l"), "method: inverse-velocity", "no value is known for l"),
    ],
)  # fmt: skip
def test_what_no_joints_follow_is_refused(path: str, more: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        question(TWO, path, more, tmp_path)
    assert any(said in error.message + error.hint for error in caught.value.errors), caught.value.errors


def test_a_short_motion_is_told_over_time(tmp_path: Path) -> None:
    """The rates of a polar arm past an edge, as functions of the time."""
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(
        "title: A test\nsymbols: {d: positive, u: positive}\nproblems:\n- robot:\n    links:\n"
        "    - {theta: theta1*, d: 0, a: 0, alpha: 90 deg}\n    - {theta: 0, d: q2*, a: 0, alpha: 0}\n"
        "  find: joint-motion\n  path: {function: [d, u*t], parameter: t}\n", encoding="utf-8",
    )  # fmt: skip
    page = next(each for each in pages(sheet, tmp_path, "md") if each.suffix == ".md").read_text("utf-8")
    assert r"\dot\theta_1 = \frac{d u}{d^2 + u^2 t^2}" in page


def test_an_arm_that_is_said_to_come_back_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the least rates a redundant arm drifts on a closed path; the opposite is refused."""
    monkeypatch.setattr(integrated, "returns", lambda *_: Phrase("comes-back"))
    with pytest.raises(SheetErrors):
        derive_all([load_sheet(ROOT / "exercises" / "joint-motion.yaml")], True, lambda _: None)
