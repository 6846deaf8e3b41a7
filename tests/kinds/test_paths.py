"""Paths against published curvatures, and against splines and quadrature of SciPy."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import make_interp_spline
from scipy.spatial.transform import Rotation

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

    def place(s: Any) -> Any:
        names = {"s": s, "cos": np.cos, "sin": np.sin, "exp": np.exp}
        return np.array([eval(each.replace("^", "**"), names) for each in places]).T

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
        ("{function: [s, s^2], range: [1, 0]}", "ends before it begins"),
    ],
)
def test_what_is_no_path_is_said(path: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        asked(path, tmp_path)
    assert said in str(fault.value.errors[0])
