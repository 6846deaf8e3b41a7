"""The kinds of `profile` against the notes, Craig, Lynch and Park, and SciPy's interpolators."""

from __future__ import annotations

from math import degrees, sqrt
from pathlib import Path
from typing import Any

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly, CubicSpline

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.build import assemble
from derive.derivation import Branch, Derivation, Panels
from derive.errors import SheetErrors
from derive.expression import Matrix
from derive.render.phrases import spoken
from derive.sheet.load import load_sheet

TRAPEZOID, SPLINE = "trapezoidal-profile", "spline-trajectory"


def ask(tmp_path: Path, profile: str, kind: str, *more: str, top: str = "") -> Derivation:
    lines = [
        "title: x",
        top,
        "problems:",
        f"- profile: {profile}",
        f"  find: {kind}",
        *(f"  {m}" for m in more),
    ]
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text("\n".join(lines) + "\n", encoding="utf-8")
    ((_, question),) = assemble(load_sheet(sheet)).questions()
    assert question.derivation
    assert all(claim.holds for claim in question.derivation.claims)
    return question.derivation


def said(branch: Branch) -> str:
    return spoken("profile", "trapezoidal-profile").when(branch.when)


def same(ours: Any, theirs: str) -> bool:
    return normal(ours) == normal(parse(theirs))


def value(tree: Any, **point: float) -> float:
    return number(tree, point)


# -- the notes, section 4 -----------------------------------------------------------------------------


def test_shortest_time_trapezoid_of_the_notes(tmp_path: Path) -> None:
    found = ask(tmp_path, "{distance: d, v_max: v_M, a_max: a_M}", "trapezoidal-profile")
    trapezoid, triangle = found.results["solutions"]
    published = {"t_1": "v_M/a_M", "t_2": "d/v_M", "t_3": "v_M/a_M + d/v_M", "v": "v_M", "a": "a_M"}
    assert all(same(trapezoid.values[name], theirs) for name, theirs in published.items())
    assert said(trapezoid) == "trapezoidal: v_M^2/a_M <= d"
    published = {"t_3": "sqrt(4*d/a_M)", "t_1": "sqrt(4*d/a_M)/2", "t_2": "sqrt(4*d/a_M)/2"}
    assert all(same(triangle.values[name], theirs) for name, theirs in published.items())
    assert said(triangle) == "triangular: v_M^2/a_M > d"


def test_the_misprint_of_the_notes(tmp_path: Path) -> None:
    """`t_1 = t_1` is t_2 = t_1: the deceleration begins where the acceleration ends."""
    found = ask(tmp_path, "{distance: 0.3, v_max: 1, a_max: 2}", "trapezoidal-profile")
    assert found.results["case"] == "triangular"
    assert normal(found.results["t_2"]) == normal(found.results["t_1"])


def test_fixed_time_of_the_notes(tmp_path: Path) -> None:
    found = ask(tmp_path, "{distance: d, v_max: v_M, a_max: a_M, time: t_3}", "trapezoidal-profile")
    triangle, trapezoid = found.results["solutions"]
    published = {"t_1": "t_3/2", "t_2": "t_3/2", "v": "d/(t_3/2)", "a": "d/(t_3/2)/(t_3/2)"}
    assert all(same(triangle.values[name], theirs) for name, theirs in published.items())
    t_m = "(2*d/v_M - t_3)"
    published = {
        "v": "v_M",
        "t_1": f"(t_3 - {t_m})/2",
        "t_2": f"t_3 - (t_3 - {t_m})/2",
        "a": f"v_M/((t_3 - {t_m})/2)",
    }
    assert all(same(trapezoid.values[name], theirs) for name, theirs in published.items())
    assert "2*d/t_3 <= v_M" in said(triangle) and "4*d/t_3^2 <= a_M" in said(triangle)
    assert "2*d/t_3 > v_M" in said(trapezoid) and "t_3 > d/v_M" in said(trapezoid)


@pytest.mark.parametrize(
    ("time", "case", "t_1", "v", "a"),
    [(7, "triangular", 3.5, 6 / 7, 12 / 49), (4, "trapezoidal", 1, 1, 1), (3.5, "trapezoidal", 0.5, 1, 2)],
)
def test_given_times(tmp_path: Path, time: float, case: str, t_1: float, v: float, a: float) -> None:
    found = ask(
        tmp_path, f"{{distance: 3 m, v_max: 1 m/s, a_max: 2 m/s^2, time: {time} s}}", "trapezoidal-profile"
    )
    assert found.results["case"] == case
    assert [value(found.results[name]) for name in ("t_1", "v", "a")] == pytest.approx([t_1, v, a])


@pytest.mark.parametrize("time", ["3.2", "3", "2", "0.1"])
def test_too_short_a_time(tmp_path: Path, time: str) -> None:
    """Also below d/v_M, where the test a > a_M of the notes fails, for t_1 is negative there."""
    found = ask(tmp_path, f"{{distance: 3, v_max: 1, a_max: 2, time: {time}}}", "trapezoidal-profile")
    assert found.results["case"] == "infeasible"
    assert value(found.results["t_min"]) == 3.5
    assert not found.plots


@settings(max_examples=40, deadline=None)
@given(v=st.integers(1, 30), a=st.integers(1, 30))
def test_lynch_and_park_trapezoidal_time_scaling(tmp_path_factory: Any, v: int, a: int) -> None:
    """Modern Robotics, section 9.2.2.2: s from 0 to 1; a plateau where v^2/a <= 1, T = (a + v^2)/(v a)."""
    found = ask(
        tmp_path_factory.mktemp("s"), f"{{distance: 1, v_max: {v}/10, a_max: {a}/10}}", "trapezoidal-profile"
    )
    v_, a_ = v / 10, a / 10
    plateau = v * v <= 10 * a
    assert found.results["case"] == ("trapezoidal" if plateau else "triangular")
    assert value(found.results["t_3"]) == pytest.approx((a_ + v_**2) / (v_ * a_) if plateau else 2 / sqrt(a_))


def test_evaluation_finds_the_case_at_the_point(tmp_path: Path) -> None:
    at = "evaluate: {d: 1, v_M: 2, a_M: 3}"
    found = ask(tmp_path, "{distance: d, v_max: v_M, a_max: a_M}", "trapezoidal-profile", at)
    assert found.evaluated["case"] == "triangular"
    assert found.evaluated["t_3"] == pytest.approx(2 / sqrt(3))
    assert found.plots


def test_backwards(tmp_path: Path) -> None:
    found = ask(tmp_path, "{distance: -3 m, v_max: 1 m/s, a_max: 2 m/s^2}", "trapezoidal-profile")
    assert value(found.results["t_3"]) == 3.5
    panels = found.plots[0]
    assert isinstance(panels, Panels)
    ((_, places),) = panels.plots[0].series.values()
    assert places[-1] == pytest.approx(-3)


def test_axes_wait_for_the_slowest(tmp_path: Path) -> None:
    axes = """
  - {distance: 90 deg, v_max: 45 deg/s, a_max: 90 deg/s^2}
  - {distance: -30 deg, v_max: 60 deg/s, a_max: 120 deg/s^2}
  - {distance: 120 deg, v_max: 60 deg/s, a_max: 120 deg/s^2}"""
    found = ask(tmp_path, axes, "trapezoidal-profile", "evaluate: true")
    assert found.results["case"] == ("trapezoidal", "triangular", "trapezoidal")
    assert same(found.results["t_3"], "5/2")
    v, a = found.results["v"], found.results["a"]
    assert isinstance(v, Matrix) and isinstance(a, Matrix)
    assert [degrees(value(row[0])) for row in v.rows] == pytest.approx([45, 24, 60])
    assert [degrees(value(row[0])) for row in a.rows] == pytest.approx([90, 19.2, 120])
    listed = "{axes: [{distance: 1, v_max: 1, a_max: 1}, {distance: 2, v_max: 1, a_max: 1}], time: 2}"
    late = ask(tmp_path, listed, "trapezoidal-profile")
    assert late.results["case"] == ("triangular", "infeasible")
    assert value(late.results["t_min"]) == 3


# -- polynomials --------------------------------------------------------------------------------------


def test_the_cubic_of_craig(tmp_path: Path) -> None:
    """Example 7.1: 15 to 75 degrees in 3 s: 15 + 20 t^2 - 4.44 t^3."""
    found = ask(tmp_path, "{from: 15 deg, to: 75 deg, time: 3 s}", "cubic-trajectory")
    printed = [degrees(value(found.results[f"a_{k}"])) for k in range(4)]
    assert printed == pytest.approx([15.0, 0.0, 20.0, -4.444], abs=5e-4)
    assert degrees(value(found.results["q"], t=3.0)) == pytest.approx(75)


def test_time_scalings_of_lynch_and_park(tmp_path: Path) -> None:
    """Modern Robotics, section 9.2.2.1."""
    cubic = ask(tmp_path, "{from: 0, to: 1, time: T}", "cubic-trajectory").results
    assert all(
        same(cubic[n], e)
        for n, e in {"a_2": "3/T^2", "a_3": "-2/T^3", "v_peak": "3/(2*T)", "a_peak": "6/T^2"}.items()
    )
    quintic = ask(tmp_path, "{from: 0, to: 1, time: T}", "quintic-trajectory").results
    published = {
        "a_3": "10/T^3",
        "a_4": "-15/T^4",
        "a_5": "6/T^5",
        "v_peak": "15/(8*T)",
        "a_peak": "10/(sqrt(3)*T^2)",
    }
    assert all(same(quintic[name], theirs) for name, theirs in published.items())


def test_the_general_quintic_of_craig(tmp_path: Path) -> None:
    """Section 7.3, fifth-order polynomials."""
    ends = "start_velocity: v_0, end_velocity: v_f, start_acceleration: w_0, end_acceleration: w_f"
    profile = f"{{from: q_0, to: q_f, time: t_f, {ends}}}"
    found = ask(tmp_path, profile, "quintic-trajectory").results
    a_3 = "(20*q_f - 20*q_0 - (8*v_f + 12*v_0)*t_f - (3*w_0 - w_f)*t_f^2)/(2*t_f^3)"
    a_4 = "(30*q_0 - 30*q_f + (14*v_f + 16*v_0)*t_f + (3*w_0 - 2*w_f)*t_f^2)/(2*t_f^4)"
    a_5 = "(12*q_f - 12*q_0 - (6*v_f + 6*v_0)*t_f - (w_0 - w_f)*t_f^2)/(2*t_f^5)"
    assert same(found["a_2"], "w_0/2")
    assert all(same(found[name], theirs) for name, theirs in {"a_3": a_3, "a_4": a_4, "a_5": a_5}.items())


@pytest.mark.parametrize("kind", ["cubic", "quintic"])
def test_against_bernstein_polynomials_of_scipy(tmp_path: Path, kind: str) -> None:
    ends = "start_velocity: 0.5, end_velocity: -0.2" + (
        ", start_acceleration: 1, end_acceleration: 0.3" if kind == "quintic" else ""
    )
    found = ask(tmp_path, f"{{from: 0.1, to: 1.7, time: 2.5, {ends}}}", f"{kind}-trajectory")
    sides = [[0.1, 0.5, 1.0], [1.7, -0.2, 0.3]] if kind == "quintic" else [[0.1, 0.5], [1.7, -0.2]]
    other = BPoly.from_derivatives([0, 2.5], sides)
    for t in (0.0, 0.4, 1.3, 2.5):
        assert value(found.results["q"], t=t) == pytest.approx(float(other(t)))


def test_limits_are_checked(tmp_path: Path) -> None:
    found = ask(
        tmp_path, "{from: 0, to: 60 deg, time: 3 s, v_max: 25 deg/s, a_max: 50 deg/s^2}", "cubic-trajectory"
    )
    velocity, acceleration = found.facts.limits
    assert not velocity.kept and acceleration.kept
    # 40 t - 40/3 t^2 = 25 deg/s
    assert value(velocity.first) == pytest.approx((3 - sqrt(9 - 7.5)) / 2, abs=0.03)


# -- lines with blends --------------------------------------------------------------------------------


def test_lspb_of_spong(tmp_path: Path) -> None:
    """Spong et al., section 5.5.3: 40 deg in 1 s at V = 60 deg/s: t_b = 1/3 s, a = 180 deg/s^2."""
    symbolic = ask(tmp_path, "{from: q_0, to: q_f, time: t_f, cruise: V}", "lspb-trajectory").results
    assert same(symbolic["t_b"], "(q_0 - q_f + V*t_f)/V")
    found = ask(tmp_path, "{from: 0, to: 40 deg, time: 1 s, cruise: 60 deg/s}", "lspb-trajectory").results
    assert same(found["t_b"], "1/3")
    assert degrees(value(found["a"])) == pytest.approx(180)
    assert [spoken("profile", "lspb-trajectory").when(branch.when) for branch in found["q"]] == [
        "0 <= t <= 1/3", "1/3 <= t <= 2/3", "2/3 <= t <= 1",
    ]  # fmt: skip


def test_lspb_by_acceleration_of_craig(tmp_path: Path) -> None:
    """Craig, section 7.3: t_b = t/2 - sqrt(a^2 t^2 - 4 a (q_f - q_0))/(2 a)."""
    found = ask(tmp_path, "{from: 0.1, to: 1.3, time: 2, acceleration: 2}", "lspb-trajectory").results
    assert value(found["t_b"]) == pytest.approx(1 - sqrt(4 * 4 - 4 * 2 * 1.2) / 4)
    back = ask(tmp_path, "{from: 1.3, to: 0.1, time: 2, acceleration: 2}", "lspb-trajectory").results
    assert value(back["t_b"]) == pytest.approx(value(found["t_b"]))
    assert value(back["v"]) == pytest.approx(-value(found["v"]))


def test_lspb_pieces_meet(tmp_path: Path) -> None:
    found = ask(tmp_path, "{from: 0.2, to: 1.2, v_max: 0.5, a_max: 1}", "lspb-trajectory", "evaluate: {t: 1}")
    first, second, third = (branch.values["q"] for branch in found.results["q"])
    assert value(first, t=0.5) == pytest.approx(value(second, t=0.5))
    assert value(second, t=2.0) == pytest.approx(value(third, t=2.0))
    assert value(third, t=2.5) == pytest.approx(1.2)
    assert found.evaluated["q"] == pytest.approx(0.575)


@pytest.mark.parametrize(
    ("given", "point"),
    [
        ("blend: tb", "tb: 0.4"),
        ("blend: t_b", "t_b: 0.4"),
        ("cruise: V", "V: -0.625"),
        ("acceleration: A", "A: -1.5625"),
    ],
)
@pytest.mark.parametrize("t", [0.1, 1.0, 1.9])
def test_lspb_at_a_time_in_letters(tmp_path: Path, given: str, point: str, t: float) -> None:
    """One metre back in 2 s, with blends of 0.4 s at 0.625 m/s: when a piece holds is told by t_b, whatever
    its author calls it."""
    found = ask(
        tmp_path,
        f"{{from: 1, to: 0, time: t_f, {given}}}",
        "lspb-trajectory",
        f"evaluate: {{t_f: 2, {point}, t: {t}}}",
    )
    a = 0.625 / 0.4
    there = 1 - a * t**2 / 2 if t < 0.4 else a * (2 - t) ** 2 / 2 if t > 1.6 else 1 - 0.625 * (t - 0.2)
    assert found.evaluated["t_b"] == pytest.approx(0.4)
    assert found.evaluated["q"] == pytest.approx(there)
    assert any(claim.key == "at-the-time" and claim.holds for claim in found.claims)


@pytest.mark.parametrize("more", ["cruise: 0.4", "cruise: 1.1", "acceleration: 1.9", "blend: 1.5"])
def test_impossible_blends(tmp_path: Path, more: str) -> None:
    """One metre in 2 s: the velocity between 0.5 and 1 m/s, the acceleration at least 1 m/s^2."""
    profile = f"{{from: 0, to: 1, time: 2, {more}}}"
    if more == "acceleration: 1.9":
        assert ask(tmp_path, profile, "lspb-trajectory")
        profile = profile.replace("1.9", "0.9")
    with pytest.raises(SheetErrors) as caught:
        ask(tmp_path, profile, "lspb-trajectory")
    assert len(caught.value.errors) == 1


# -- splines ------------------------------------------------------------------------------------------

TIMES, PLACES = [0.0, 0.7, 1.3, 2.0, 3.0], [0.0, 0.2, 0.5, 0.45, 1.0]
VIA = ", ".join(f"{{time: {t}, at: {q}}}" for t, q in zip(TIMES[1:-1], PLACES[1:-1], strict=True))


@pytest.mark.parametrize("ends", ["clamped", "natural"])
def test_splines_are_those_of_scipy(tmp_path: Path, ends: str) -> None:
    found = ask(tmp_path, f"{{from: 0, to: 1, time: 3, via: [{VIA}]}}", "spline-trajectory", f"ends: {ends}")
    other = CubicSpline(TIMES, PLACES, bc_type=ends)
    for k, t in enumerate(TIMES):
        assert value(found.results[f"v_{k}"]) == pytest.approx(float(other(t, 1)))
    pieces = found.results["q"]
    assert isinstance(pieces, tuple)
    for k, branch in enumerate(pieces):
        assert isinstance(branch, Branch)
        middle = (TIMES[k] + TIMES[k + 1]) / 2
        assert value(branch.values["q"], t=middle) == pytest.approx(float(other(middle)))


def test_ends_in_motion(tmp_path: Path) -> None:
    more = f"{{from: 0, to: 1, time: 3, start_velocity: 0.3, end_velocity: -0.1, via: [{VIA}]}}"
    found = ask(tmp_path, more, "spline-trajectory", "evaluate: {t: 1.7}")
    other = CubicSpline(TIMES, PLACES, bc_type=((1, 0.3), (1, -0.1)))
    assert found.evaluated["q"] == pytest.approx(float(other(1.7)))


def test_a_prescribed_velocity(tmp_path: Path) -> None:
    via = "[{time: 1, at: 1, velocity: 0}]"
    found = ask(tmp_path, f"{{from: 0, to: 0, time: 2, via: {via}}}", "spline-trajectory").results
    assert same(found["v_1"], "0")


# -- what is refused ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("profile", "kind", "said"),
    [
        ("{distance: 1 m, v_max: 1 rad/s, a_max: 1}", "trapezoidal-profile", "lengths and angles are mixed"),
        ("{distance: 1, v_max: 0, a_max: 1}", "trapezoidal-profile", "v_max must be positive"),
        ("{distance: 1, v_max: 1, a_max: -1}", "trapezoidal-profile", "a_max must be positive"),
        ("{distance: 0, v_max: 1, a_max: 1}", "trapezoidal-profile", "the distance is zero"),
        ("{distance: 1 kg, v_max: 1, a_max: 1}", "trapezoidal-profile", "this is a mass"),
        ("{distance: 1, v_max: 1, amax: 1}", "trapezoidal-profile", "amax"),
        ("{v_max: 1, a_max: 1}", "trapezoidal-profile", "write {distance"),
        ("{from: 0, to: 1, time: 2}", "trapezoidal-profile", "no distance within limits"),
        ("{from: 0, to: 1}", "cubic-trajectory", "no time is given"),
        ("{distance: 1, v_max: 1, a_max: 1}", "cubic-trajectory", "no time is given"),
        ("{from: 0, to: 1, time: 2}", "lspb-trajectory", "nothing says how fast"),
        ("{from: 0, to: 1, time: 2, cruise: 1, blend: 1}", "lspb-trajectory", "each follows from the other"),
        ("{from: 0, to: 1, time: 2}", "spline-trajectory", "there are no via points"),
        ("{from: 0, to: 1, time: 2, via: [{time: 3, at: 1}]}", "spline-trajectory", "before the end"),
        ("{from: 0, to: 1, time: 2, via: [{time: 1, at: 1}, {time: 1, at: 2}]}", SPLINE, "later"),
        ("[{distance: d, v_max: 1, a_max: 1}, {distance: 1, v_max: 1, a_max: 1}]", TRAPEZOID, "slowest"),
    ],
)  # fmt: skip
def test_faults_are_told(tmp_path: Path, profile: str, kind: str, said: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        ask(tmp_path, profile, kind)
    assert any(said in f"{error.message} {error.hint}" for error in caught.value.errors)


def test_names_of_the_author_are_no_obstacle(tmp_path: Path) -> None:
    found = ask(tmp_path, "{distance: d, v_max: v, a_max: a, time: T}", "trapezoidal-profile")
    assert same(found.results["v"], "2*d/T")


def test_names_of_where_stay_while_working(tmp_path: Path) -> None:
    found = ask(
        tmp_path,
        "{distance: d, v_max: v_M, a_max: a_M}",
        "trapezoidal-profile",
        top="where: {d: 3, v_M: 1, a_M: 2}",
    )
    assert found.results["case"] == "trapezoidal"
    assert same(found.results["t_3"], "7/2")
    assert same(found.step("t_1").chain[1], "v_M/a_M")


def test_angles_in_radians(tmp_path: Path) -> None:
    found = ask(tmp_path, "{distance: 2 rad, v_max: 1 rad/s, a_max: 1 rad/s^2}", "trapezoidal-profile")
    panels = found.plots[0]
    assert isinstance(panels, Panels)
    said = spoken("profile", "trapezoidal-profile").say
    assert said(panels.plots[0].y_label) == "q [rad]"
    assert numpy.isclose(value(found.results["t_3"]), 3.0)
