"""Step responses against SciPy, python-control and closed forms."""

from __future__ import annotations

import math

import numpy
import pytest
from scipy import signal

from derive.algebra.scalar import Scalar
from derive.control.laplace import inverted
from derive.control.response import exponential, step_response
from derive.control.roots import roots


def poles(den: list[float]) -> tuple[complex, ...]:
    return tuple(complex(root) for root in numpy.roots(den))


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
    found = step_response(num, den, poles(den))
    times = numpy.array(found.times)
    _, values = signal.step((num, den), T=times)
    assert numpy.allclose(found.values, values, atol=1e-7)


def test_first_order_by_its_closed_form() -> None:
    found = step_response([3.0], [2.0, 1.0], (-0.5 + 0j,))
    assert found.steady_state == 3
    assert found.rise_time == pytest.approx(2 * math.log(9))
    assert found.settling_time == pytest.approx(2 * math.log(50))
    assert found.overshoot == 0


def test_second_order_overshoot_by_its_closed_form() -> None:
    zeta = 0.4
    found = step_response([4.0], [1.0, 4 * zeta, 4.0], poles([1.0, 4 * zeta, 4.0]))
    assert found.overshoot == pytest.approx(
        100 * math.exp(-math.pi * zeta / math.sqrt(1 - zeta**2)), rel=1e-6
    )
    assert found.peak_time == pytest.approx(math.pi / (2 * math.sqrt(1 - zeta**2)), rel=1e-2)


def test_python_control_agrees() -> None:
    control = pytest.importorskip("control")
    num, den = [1.5, 1.0], [2.0, 2.5, 3.0, 1.0]
    found = step_response(num, den, poles(den))
    other = control.step_info(control.tf(num, den), T=numpy.linspace(0, 60, 60001))
    assert found.rise_time == pytest.approx(other["RiseTime"], abs=3e-3)
    assert found.settling_time == pytest.approx(other["SettlingTime"], abs=3e-3)
    assert found.overshoot == pytest.approx(other["Overshoot"], abs=1e-3)


@pytest.mark.parametrize("den", [[1.0, 0.0], [1.0, -1.0], [1.0, 0.0, 4.0]])
def test_what_does_not_settle_has_no_numbers(den: list[float]) -> None:
    found = step_response([1.0], den, poles(den))
    assert found.steady_state is found.rise_time is found.overshoot is None


def test_what_returns_to_zero_has_no_rise() -> None:
    found = step_response([1.0, 0.0], [1.0, 2.0, 5.0], poles([1.0, 2.0, 5.0]))
    assert found.steady_state == 0
    assert found.rise_time is None


def test_matrix_exponential_and_inverse_transform() -> None:
    turn = exponential(numpy.array([[0.0, -9.0], [9.0, 0.0]]))
    assert numpy.allclose(turn, [[math.cos(9), -math.sin(9)], [math.sin(9), math.cos(9)]])
    assert inverted(lambda s: 1 / (s * s + 1), 3.0, 60) == pytest.approx(math.sin(3.0), abs=1e-7)


def test_repeated_roots_are_certified() -> None:
    found = roots([Scalar.of(each) for each in (1, 3, 3, 1)])
    assert found == (-1, -1, -1)
    assert roots([Scalar.of(each) for each in (1, 0, 4)]) == (2j, -2j)
