"""Shortest times against published formulas, and against SciPy's polynomials and its root finder."""

from __future__ import annotations

from math import pi, sqrt
from pathlib import Path
from typing import Any

import numpy
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly
from scipy.optimize import brentq

from derive.algebra.numbers.floats import number
from derive.errors import SheetErrors
from derive.expression import Matrix
from derive.render.phrases import spoken
from tests.kinds.test_profile_kinds import ask

KIND = "minimum-time"
ENDS = {"cubic": [0, 0], "quintic": [0, 0, 0]}  # place and derivatives at a start


def found(tmp_path: Path, profile: str, law: str, *more: str, kind: str = KIND) -> dict[str, Any]:
    return dict(ask(tmp_path, profile, kind, f"law: {law}", *more).results)


def active(results: dict[str, Any], kind: str = "minimum_time") -> str:
    return spoken("profile", kind).say(results["active"])


def test_the_handout_of_cs225a(tmp_path: Path) -> None:
    """Stanford, spring 2013: t_f is the greater of 3 d/(2 v) and sqrt(6 d/a)."""
    results = found(tmp_path, "{distance: d, v_max: v, a_max: a}", "cubic")
    fast, strong = results["solutions"]
    at = {"d": 1.7, "v": 0.9, "a": 2.3}
    assert number(fast.values["time"], at) == pytest.approx(3 * 1.7 / (2 * 0.9))
    assert number(strong.values["time"], at) == pytest.approx(sqrt(6 * 1.7 / 2.3))
    assert number(fast.values["a_peak"], at) == pytest.approx(6 * 1.7 / (3 * 1.7 / 1.8) ** 2)


@pytest.mark.parametrize(
    ("law", "time", "limit"),
    [
        ("trapezoidal", pi / 4 + 1 / 2, "velocity and acceleration"),  # d/v + v/a, an exam
        ("cubic", sqrt(6 * (pi / 2) / 4), "acceleration"),
        ("quintic", sqrt(10 / sqrt(3) * (pi / 2) / 4), "acceleration"),  # Lynch and Park, section 9.2.2
        ("cycloidal", pi / 2, "velocity and acceleration"),  # 2 d/v and sqrt(2 pi d/a) are equal
    ],
)
def test_a_joint_within_its_limits(tmp_path: Path, law: str, time: float, limit: str) -> None:
    results = found(tmp_path, "{distance: 90 deg, v_max: 2 rad/s, a_max: 4 rad/s^2}", law)
    assert number(results["time"], {}) == pytest.approx(time)
    assert active(results) == limit


@settings(max_examples=15, deadline=None)
@given(d=st.integers(1, 40), v=st.integers(1, 30), a=st.integers(1, 30), law=st.sampled_from(sorted(ENDS)))
def test_the_polynomials_of_scipy_just_keep_the_limits(
    tmp_path_factory: Any, d: int, v: int, a: int, law: str
) -> None:
    """The time in which the extremes of SciPy's polynomial meet the limits, by its root finder."""
    profile = f"{{distance: {d}/10, v_max: {v}/10, a_max: {a}/10}}"
    results = found(tmp_path_factory.mktemp("s"), profile, law)

    def excess(time: float) -> float:
        ends = ENDS[law]
        course = BPoly.from_derivatives([0, time], [[0, *ends[1:]], [d / 10, *ends[1:]]])
        times = numpy.linspace(0, time, 3001)
        fast, strong = (abs(course.derivative(k)(times)).max() for k in (1, 2))
        return max(fast / (v / 10), strong / (a / 10)) - 1

    assert number(results["time"], {}) == pytest.approx(brentq(excess, 1e-2, 1e3), rel=1e-5)


def test_axes_wait_for_the_slowest(tmp_path: Path) -> None:
    axes = """
  - {distance: 90 deg, v_max: 45 deg/s, a_max: 90 deg/s^2}
  - {distance: -30 deg, v_max: 60 deg/s, a_max: 10 deg/s^2}"""
    results = found(tmp_path, axes, "cubic")
    assert number(results["time"], {}) == pytest.approx(sqrt(18))
    assert active(results) == "acceleration of axis 2"
    v, a = results["v_peak"], results["a_peak"]
    assert isinstance(v, Matrix) and isinstance(a, Matrix)
    degrees = [number(row[0], {}) * 180 / pi for row in (*v.rows, *a.rows)]
    assert degrees == pytest.approx([135 / sqrt(18), 45 / sqrt(18), 30, 10])


@settings(max_examples=15, deadline=None)
@given(d=st.integers(-30, 30), v=st.integers(-30, 30), a=st.integers(1, 30))
def test_the_double_integrator_of_athans_and_falb(tmp_path_factory: Any, d: int, v: int, a: int) -> None:
    """Optimal Control, section 7.2: from (x, y) to the origin in s y + sqrt(4 s x + 2 y^2), with s the
    side of the switching curve."""
    assume(v)
    profile = f"{{from: {-d}/10, to: 0, start_velocity: {v}/10, a_max: {a}/10}}"
    results = found(tmp_path_factory.mktemp("s"), profile, "bang-bang")
    x, y = -d / a, v / a
    side = 1 if x + y * abs(y) / 2 > 0 else -1
    assert number(results["time"], {}) == pytest.approx(side * y + sqrt(max(4 * side * x + 2 * y**2, 0)))
    assert active(results) == "acceleration"


def test_a_limit_of_velocity_is_reached_and_held(tmp_path: Path) -> None:
    """Backward at once, then forward at the greatest velocity: by areas under the velocity."""
    sizes = "start_velocity: -1 m/s, v_max: 2 m/s, a_max: 1 m/s^2"
    results = found(tmp_path, f"{{from: 0, to: 6 m, {sizes}}}", "bang-bang")
    # from -1 to 2 in 3 s over 1.5 m, to rest in 2 s over 2 m, and 2.5 m at 2 m/s
    times = [number(results[name], {}) for name in ("t_1", "t_2", "time", "v")]
    assert times == pytest.approx([3, 4.25, 6.25, 2])
    assert active(results) == "velocity and acceleration"


def test_the_cubic_of_craig_is_slowed_down(tmp_path: Path) -> None:
    """Example 7.1 turns by 60 degrees in 3 s: 30 deg/s and 40 deg/s^2 at most."""
    profile = "{from: 15 deg, to: 75 deg, time: 3 s, v_max: 25 deg/s, a_max: 45 deg/s^2}"
    results = found(tmp_path, profile, "cubic", kind="time-scaling")
    assert number(results["k"], {}) == pytest.approx(1.2)
    assert number(results["time"], {}) == pytest.approx(3.6)
    names = ("v_peak", "a_peak", "v_k", "a_k")
    peaks = [number(results[name], {}) * 180 / pi for name in names]
    assert peaks == pytest.approx([30, 40, 25, 40 / 1.44])
    assert active(results, "time_scaling") == "velocity"


@pytest.mark.parametrize("law", ["cubic", "quintic", "cycloidal"])
def test_a_scaled_motion_is_the_fastest(tmp_path: Path, law: str) -> None:
    """Scaling leads to the shortest time from whatever time is given."""
    sizes = "v_max: 0.7 m/s, a_max: 1.1 m/s^2"
    least = found(tmp_path, f"{{distance: -0.4 m, {sizes}}}", law)
    for time in (0.5, 4):
        scaled = found(tmp_path, f"{{distance: -0.4 m, {sizes}, time: {time} s}}", law, kind="time-scaling")
        assert number(scaled["time"], {}) == pytest.approx(number(least["time"], {}))
        assert number(scaled["k"], {}) == pytest.approx(number(least["time"], {}) / time)


@pytest.mark.parametrize(
    ("profile", "law", "said"),
    [
        ("{distance: 1, v_max: 1, a_max: 1, time: 3}", "cubic", "leave it out"),
        ("{from: 0, to: 1}", "quintic", "no limit"),
        ("{from: 0, to: 1, a_max: 1}", "trapezoidal", "both limits"),
        ("{from: 0, to: 1, a_max: 1, start_velocity: 1}", "cubic", "at rest"),
        ("{from: 0, to: 1, a_max: 1, v_max: 1, start_velocity: 2}", "bang-bang", "beyond v_max"),
        ("{from: 0, to: d, a_max: 1, start_velocity: 1}", "bang-bang", "without numbers"),
        ("{from: 2, to: 2, a_max: 1}", "cubic", "nothing to move"),
        (
            "[{distance: d, v_max: 1, a_max: 1}, {distance: 1, v_max: 1, a_max: 1}]",
            "cubic",
            "without numbers",
        ),
    ],
)
def test_what_is_refused(tmp_path: Path, profile: str, law: str, said: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        found(tmp_path, profile, law)
    assert any(said in f"{error.message} {error.hint}" for error in caught.value.errors)
