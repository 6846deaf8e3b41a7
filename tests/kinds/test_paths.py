"""Paths against published curvatures, and against splines and quadrature of SciPy."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy
from scipy.integrate import quad
from scipy.interpolate import CubicSpline, make_interp_spline
from scipy.spatial.transform import Rotation

from derive.audit.text import sympy_of_text
from derive.errors import SheetErrors
from tests.sheets import pages

NAMES = ("p", "v", "a", "t", "n", "b")


def asked(path: str, folder: Path, *more: str, symbols: str = "{}") -> dict[str, Any]:
    """The answer to the one question about a path."""
    sheet = folder / "sheet.yaml"
    lines = ("title: A path", f"symbols: {symbols}", "problems:", f"- path: {path}", "  find: path", *more)
    sheet.write_text("\n".join(lines) + "\n", encoding="utf-8")
    (page,) = pages(sheet, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]
    return found


def test_do_carmo_has_this_helix(tmp_path: Path) -> None:
    """Differential Geometry of Curves and Surfaces, section 1.5, exercise 1: the curvature a/(a^2 + b^2)."""
    path = "{helix: {radius: a, pitch: 2*pi*b}}"
    found = asked(path, tmp_path, symbols="{a: positive, b: positive}")["results"]
    assert found["curvature"] == "a/(a**2 + b**2)"
    assert found["length"] == "2*pi*sqrt(a**2 + b**2)"
    assert found["n"] == ["-cos(s)", "-sin(s)", "0"]


def test_a_parabola(tmp_path: Path) -> None:
    """y = k x^2 bends by 2 k/(1 + 4 k^2 x^2)^(3/2); from the vertex to 1 it is 1.4789 long for k = 1."""
    found = asked("{function: [s, k*s^2], range: [0, 1]}", tmp_path, "  evaluate: {k: 1, s: 0.5}")
    assert found["results"]["curvature"] == "2*Abs(k)/(4*k**2*s**2 + 1)**(3/2)"
    numbers = asked("{function: [s, s^2], range: [0, 1]}", tmp_path, "  evaluate: {s: 0.5}")["evaluated"]
    assert numbers["curvature"] == pytest.approx(2 / 2**1.5)
    assert numbers["length"] == pytest.approx(np.sqrt(5) / 2 + np.log(2 + np.sqrt(5)) / 4)


def test_a_circle_of_siciliano(tmp_path: Path) -> None:
    """Robotics, eq. (4.43): p = c + R (rho cos(s/rho), rho sin(s/rho), 0), for a circle anywhere."""
    path = "{circle: {center: [1, 2, 3], radius: 2, axis: [1, 2, 2], start: [2, 1, -2], angle: -90 deg}}"
    found = asked(path, tmp_path, "  evaluate: {s: 0.7}")["evaluated"]
    axis = np.array([1, 2, 2]) / 3
    turned = Rotation.from_rotvec(-0.7 / 2 * axis).as_matrix() @ (np.array([2, 1, -2]) / 3 * 2)
    assert np.allclose(found["p"], np.array([1, 2, 3]) + turned)
    assert np.allclose(found["n"], -turned / 2)
    assert np.allclose(found["b"], -axis)
    assert found["length"] == pytest.approx(np.pi)


@pytest.mark.parametrize(
    "places",
    [
        ("2*cos(s)", "sin(s)"),
        ("s", "s^2", "s^3"),
        ("s^2 + 1", "s^3"),
        ("exp(-s)*cos(s)", "exp(-s)*sin(s)", "s"),
    ],
)
def test_curves_as_splines_have_them(places: tuple[str, ...], tmp_path: Path) -> None:
    found = asked(f"{{function: [{', '.join(places)}], range: [0, 1.5]}}", tmp_path, "  evaluate: {s: 0.6}")
    numbers = found["evaluated"]

    trees = [sympy_of_text(each.replace("^", "**"), {}) for each in places]
    made = sympy.lambdify(sympy.Symbol("s"), trees, "numpy")

    def place(s: Any) -> Any:
        return np.array(made(s)).T

    nodes = np.linspace(-0.1, 1.6, 400)
    spline = make_interp_spline(nodes, place(nodes), k=7)
    v, a = spline(0.6, 1), spline(0.6, 2)
    t = v / np.linalg.norm(v)
    bend = (a - t * (a @ t)) / (v @ v)
    assert np.allclose(numbers["v"], v, atol=1e-8)
    assert np.allclose(numbers["a"], a, atol=1e-6)
    assert np.allclose(numbers["n"], bend / np.linalg.norm(bend), atol=1e-6)
    assert numbers["curvature"] == pytest.approx(np.linalg.norm(bend), rel=1e-6)
    length = quad(lambda s: np.linalg.norm(spline(s, 1)), 0, 1.5)[0]
    assert float(numbers["length"]) == pytest.approx(length, rel=1e-8)
    if len(places) == 3:
        assert np.allclose(numbers["b"], np.cross(t, bend / np.linalg.norm(bend)), atol=1e-6)


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("{line: {from: [1, 0], to: [1, 0]}}", "ends where it starts"),
        ("{circle: {center: [0, 0, 0], radius: 1, axis: z, start: [1, 0, 1]}}", "not on the circle"),
        ("{circle: {center: [0, 0]}}", "how large it is"),
        ("{function: [u, u^2]}", "does not depend on 's'"),
        ("{function: [0.1 m*s, s^2], range: [0, 1]}", "read as a unit"),
        ("{function: [s, s^2], range: [1, 0]}", "ends before it begins"),
    ],
)
def test_what_is_no_path_is_said(path: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        asked(path, tmp_path)
    assert said in str(fault.value.errors[0])


TURN = "{helix: {radius: 0.3, pitch: 0.1, turns: 2}, timing: {%s}}"
WAY = 2 * np.hypot(0.6 * np.pi, 0.1)
CURVE = "{function: [s, s^2], range: [1, 3], timing: {%s}}"


@pytest.mark.parametrize(
    ("path", "timing", "whole"),
    [
        (TURN, "law: quintic, time: 2", 2.0),
        (
            TURN,
            "law: trapezoidal, v_max: 2, a_max: 3",
            np.hypot(0.6 * np.pi, 0.1) + 2 / 3,
        ),  # 2 turns at 2 m/s
        (TURN, "law: trapezoidal, v_max: 5, a_max: 3", 2 * np.sqrt(WAY / 3)),
        (CURVE, "law: trapezoidal, time: 2, a_max: 3", 2.0),
        (CURVE, "law: trapezoidal, time: 2, v_max: 1.5", 2.0),
    ],
)
def test_motions_are_derivatives_of_the_place(path: str, timing: str, whole: float, tmp_path: Path) -> None:
    """From rest to rest, and at times between them by a spline through places of the answer itself."""

    def at(t: float) -> dict[str, Any]:
        numbers: dict[str, Any] = asked(path % timing, tmp_path, f"  evaluate: {{t: {t:.12f}}}")["evaluated"]
        return numbers

    assert at(0)["time"] == pytest.approx(whole)
    for end in (0.0, whole - 1e-9):
        assert np.allclose(at(end)["v"], 0, atol=1e-6)
    for share in (0.1, 0.55):
        here, step = share * whole, 1e-3
        behind, now, ahead = (at(here + k * step) for k in (-1, 0, 1))
        p = [np.array(each["p"]) for each in (behind, now, ahead)]
        assert np.allclose(now["v"], (p[2] - p[0]) / (2 * step), atol=1e-3)
        assert np.allclose(
            now["a"], (p[2] - 2 * p[1] + p[0]) / step**2, atol=1e-3 * max(1, *map(abs, now["a"]))
        )
        assert np.allclose(np.cross([*now["v"], 0][:3], [*now["t"], 0][:3]), 0, atol=1e-9)


@pytest.mark.parametrize("ends", ["clamped", "natural"])
@pytest.mark.parametrize("t", [0.4, 1.0, 2.2, 3.9])
def test_points_are_passed_by_the_spline_of_scipy(ends: str, t: float, tmp_path: Path) -> None:
    times, points = [0, 1, 2.5, 4], [[0, 0, 1], [1, -2, 0.3], [3, 1, 0.5], [4, 2, 2]]
    path = f"{{via: {points}, times: {times}, ends: {ends}}}"
    found = asked(path, tmp_path, f"  evaluate: {{t: {t}}}")["evaluated"]
    theirs = CubicSpline(times, points, bc_type=ends)
    p, v, a = (theirs(t, order) for order in range(3))
    for name, value in (("p", p), ("v", v), ("a", a), ("t", v / np.linalg.norm(v))):
        assert np.allclose(found[name], value), name
    assert found["curvature"] == pytest.approx(np.linalg.norm(np.cross(v, a)) / np.linalg.norm(v) ** 3)
    b = np.cross(v, a) / np.linalg.norm(np.cross(v, a))
    assert np.allclose(found["b"], b) and np.allclose(found["n"], np.cross(b, found["t"]))
    parts = [quad(lambda at: np.linalg.norm(theirs(at, 1)), *each)[0] for each in pairwise(times)]
    assert found["length"] == pytest.approx(sum(parts), rel=1e-6)


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("{via: [[0, 0], [1, 1], [2, 0]], times: [0, 1]}", "2 times for 3 points"),
        ("{via: [[0, 0], [1, 1]], times: [0, 1]}", "3"),
        ("{via: [[0, 0], [1, 1, 1], [2, 0]], times: [0, 1, 2]}", "this point has 3 coordinates"),
        ("{via: [[0, 0], [1, 1], [2, 0]], times: [0, 2, 1]}", "must be later than the one before"),
        ("{via: [[0, 0], [1, 1], [2, 0]], times: [0, T, 2]}", "this time has no value"),
        ("{via: [[0, 0], [1, 1], [2, 0]], times: [0, 1, 2], timing: {law: cubic, time: 1}}", "timing"),
        ("{via: [[0, 0], [1, 1], [2, 0]], times: [0, 1, 2], ends: free}", "natural"),
    ],
)
def test_what_passes_no_points_is_said(path: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        asked(path, tmp_path)
    assert any(said in error.message + error.hint for error in caught.value.errors), caught.value.errors


def test_a_spline_has_a_normal_where_it_bends(tmp_path: Path) -> None:
    """In the plane to the left and to the right; none where the acceleration is zero, or all is straight."""
    path = "{via: [[0, 0], [1, 2], [3, 1], [4, 2]], times: [0, 1, 2.5, 4], ends: natural}"
    theirs = CubicSpline([0, 1, 2.5, 4], [[0, 0], [1, 2], [3, 1], [4, 2]], bc_type="natural")
    for t in (0.5, 2.5):
        found = asked(path, tmp_path, f"  evaluate: {{t: {t}}}")["evaluated"]
        (x, y), a = found["t"], theirs(t, 2)
        side = np.sign(x * a[1] - y * a[0])
        assert np.allclose(found["n"], [-side * y, side * x])
    assert "n" not in asked(path, tmp_path, "  evaluate: {t: 0}")["evaluated"]
    straight = "{via: [[0, 1], [1, 2], [3, 4]], times: [0, 1, 2]}"
    assert "n" not in asked(straight, tmp_path)["results"]


def test_spong_has_this_cubic(tmp_path: Path) -> None:
    """q = 3 t^2 - 2 t^3 from 0 to 1 in a second (Spong et al., section 5.5.1)."""
    found = asked("{line: {from: [0, 0], to: [1, 0]}, timing: {law: cubic, time: 1}}", tmp_path)["results"]
    assert found["p"] == ["t**2*(3 - 2*t)", "0"] and found["v"] == ["6*t*(1 - t)", "0"]


def test_siciliano_has_this_trapezoid(tmp_path: Path) -> None:
    """Section 4.2.1: t_c = t_f/2 - sqrt((t_f^2 a - 4 L)/a)/2, here 1/2 for L = 3 in 2 s with a = 4."""
    path = "{line: {from: [0, 0], to: [3, 0]}, timing: {law: trapezoidal, time: 2, a_max: 4}}"
    found = asked(path, tmp_path, "  evaluate: {t: 1}")["evaluated"]
    assert found["v"] == pytest.approx([2, 0]) and found["p"] == pytest.approx([1.5, 0])


@pytest.mark.parametrize(
    ("timing", "more", "said"),
    [
        ("law: cubic, time: 1, v_max: 2", "", "by its time alone"),
        ("law: trapezoidal, time: 1", "", "1 of its sizes"),
        ("law: trapezoidal, time: 1, a_max: 1", "", "too short"),
        ("law: cubic, time: 1", "  evaluate: {t: 2}", "the motion is over"),
        ("law: trapezoidal, v_max: v, a_max: a", "", "depends on symbols"),
    ],
)
def test_what_is_no_motion_is_said(timing: str, more: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        asked(
            f"{{line: {{from: [0, 0], to: [3, 4]}}, timing: {{{timing}}}}}", tmp_path, *filter(None, [more])
        )
    assert said in str(fault.value.errors[0])
