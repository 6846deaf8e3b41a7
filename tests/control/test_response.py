"""Step responses against SciPy, python-control and closed forms."""

from __future__ import annotations

import math
from fractions import Fraction

import mpmath
import numpy
import pytest
import sympy
from scipy import signal

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.control.oracle.inversion import inverted
from derive.control.rational import polynomial
from derive.control.response import StepResponse, step_response
from derive.control.roots import roots


def response(num: list[float], den: list[float]) -> StepResponse:
    return step_response(*([Scalar.of(Fraction(str(k))) for k in side] for side in (num, den)))


def typed(num: str, den: str) -> StepResponse:
    return step_response(*(polynomial(normal(parse(side))) for side in (num, den)))


@pytest.mark.parametrize(
    ("num", "den"),
    [
        ([0.5], [2, 2.5, 1.5, 0.5]),
        ([1.5, 1], [2, 2.5, 3, 1]),
        ([1, 0.2, 3], [1, 3, 3, 1]),  # feeds through, triple pole
        ([-1, 1], [1, 2, 1]),  # starts the wrong way
        ([1], [1e-3, 1.001, 1]),  # a fast and a slow pole
    ],
)
def test_the_curve_is_that_of_scipy(num: list[float], den: list[float]) -> None:
    found = response(num, den)
    times = numpy.array(found.times)
    _, values = signal.step((num, den), T=times)
    assert numpy.allclose(found.values, values, atol=1e-7)


def test_first_order_by_its_closed_form() -> None:
    found = response([3], [2, 1])
    assert found.steady_state == 3
    assert found.rise_time == pytest.approx(2 * math.log(9))
    assert found.settling_time == pytest.approx(2 * math.log(50))
    assert found.overshoot == 0


def test_second_order_overshoot_by_its_closed_form() -> None:
    zeta = 0.4
    found = response([4], [1, 1.6, 4])
    assert found.overshoot == pytest.approx(
        100 * math.exp(-math.pi * zeta / math.sqrt(1 - zeta**2)), rel=1e-6
    )
    assert found.peak_time == pytest.approx(math.pi / (2 * math.sqrt(1 - zeta**2)), rel=1e-9)


def test_python_control_agrees() -> None:
    control = pytest.importorskip("control")
    num, den = [1.5, 1.0], [2.0, 2.5, 3.0, 1.0]
    found = response(num, den)
    other = control.step_info(control.tf(num, den), T=numpy.linspace(0, 60, 60001))
    assert found.rise_time == pytest.approx(other["RiseTime"], abs=3e-3)
    assert found.settling_time == pytest.approx(other["SettlingTime"], abs=3e-3)
    assert found.overshoot == pytest.approx(other["Overshoot"], abs=1e-3)


@pytest.mark.parametrize("den", [[1.0, 0.0], [1.0, -1.0], [1.0, 0.0, 4.0]])
def test_what_does_not_settle_has_no_numbers(den: list[float]) -> None:
    found = response([1], den)
    assert found.steady_state is found.rise_time is found.overshoot is None


def test_what_returns_to_zero_has_no_rise() -> None:
    found = response([1, 0], [1, 2, 5])
    assert found.steady_state == 0
    assert found.rise_time is None


def test_an_inverse_transform() -> None:
    times = numpy.array([0.1, 3.0, 7.0])
    assert inverted(lambda s: 1 / (s * s + 1), times, 60) == pytest.approx(numpy.sin(times), abs=1e-7)


def test_repeated_roots_are_certified() -> None:
    found = roots([Scalar.of(each) for each in (1, 3, 3, 1)])
    assert found == (-1, -1, -1)
    assert roots([Scalar.of(each) for each in (1, 0, 4)]) == (2j, -2j)


@pytest.mark.parametrize(
    ("num", "den"),
    [
        ("1", "(s + 1)^6"),
        ("1", "(s + 1)^8"),
        ("1", "(s + 1)^20"),
        ("s + 1.001", "(s + 1)*(s + 2)*(s + 3)"),
        ("1", "(s + 1)*(s + 1.00001)*(s + 1.00002)*(s + 1.00003)"),
        ("1e2", "s^2 + 4*s + 1e2"),
        ("(1 - s)*(2 - s)", "(s + 1)^3"),
        ("-3", "(s + 1)^2*(s + 1000)"),
        ("9", "s^2 + sqrt(2)*3*s + 9"),
        ("s^2 + 1.1", "(s^2 + 0.4*s + 1)^2"),
        ("s^2 + 3", "(s + 1)^2"),
    ],
)
def test_what_is_read_off_stands_where_mpmath_has_it(num: str, den: str) -> None:
    """By Talbot's contour at 40 digits, on a grid fine enough for these curves."""
    found = typed(num, den)
    top, bottom = (
        sympy.lambdify("s", sympy.sympify(text.replace("^", "**")), "mpmath") for text in (num, den)
    )
    assert found.rises is not None and found.settling_time is not None and found.overshoot is not None
    with mpmath.workdps(40):

        def share(time: float) -> float:
            value = mpmath.invertlaplace(lambda s: top(s) / bottom(s) / s, time, method="talbot", degree=72)
            return float(value / (top(0) / bottom(0)))

        for time, level in zip(found.rises, (0.1, 0.9), strict=True):
            assert time == 0 or share(time) == pytest.approx(level, abs=1e-9)
        assert abs(share(found.settling_time) - 1) == pytest.approx(0.02, abs=1e-9)
        if found.peak_time:
            assert share(found.peak_time) == pytest.approx(1 + found.overshoot / 100, abs=1e-9)
        grid = [found.settling_time * k / 12 for k in range(1, 24)]
        shares = [share(time) for time in grid]
    assert max(shares) <= 1 + found.overshoot / 100 + 1e-9
    assert all(each <= 0.9 for time, each in zip(grid, shares, strict=True) if time < found.rises[1] - 1e-9)
    late = (each for time, each in zip(grid, shares, strict=True) if time > found.settling_time + 1e-9)
    assert all(abs(each - 1) <= 0.02 for each in late)


def test_light_damping_by_its_closed_form() -> None:
    found = typed("1", "s^2 + 0.002*s + 1")
    assert found.overshoot == pytest.approx(100 * math.exp(-math.pi * 0.001 / math.sqrt(1 - 1e-6)), rel=1e-12)
    assert found.settling_time == pytest.approx(3911.3232289755, rel=1e-12)  # 622 swings


@pytest.mark.parametrize(
    ("num", "den", "rise", "settling", "overshoot"),
    [
        ("5", "1", 0, 0, 0),
        ("0.98*s + 1", "s + 1", 0, 0, 0),  # begins at the edge of the band
        ("0.9*s + 1", "s + 1", 0, math.log(5), 0),
        ("2*s + 1", "s + 1", 0, math.log(50), 100),  # highest at the beginning
        ("2*(s + 1)^3 - 1", "(s + 1)^3", 0, 7.516603875609, 100),  # and flat there
    ],
)
def test_what_begins_with_a_jump(num: str, den: str, rise: float, settling: float, overshoot: float) -> None:
    found = typed(num, den)
    assert (found.rise_time, found.overshoot) == (rise, overshoot)
    assert found.settling_time == pytest.approx(settling, rel=1e-9)


def test_roots_are_decided_exactly() -> None:
    def found(text: str) -> tuple[complex, ...]:
        return roots(polynomial(normal(parse(text))))

    assert found("(s + 1)^8") == (-1,) * 8
    assert found("s^2 + 1e-30*s + 1") == (-5e-31 + 1j, -5e-31 - 1j)  # left of the axis
    assert found("(s^2 + 2)*(s + sqrt(2))^2") == (2**0.5 * 1j, -(2**0.5) * 1j, -(2**0.5), -(2**0.5))
    assert found("(s + 1)*(s + 1.000000001)") == (-1, -1.000000001)
    assert found("s^2*(s^2 - 4)") == (2, 0, 0, -2)
