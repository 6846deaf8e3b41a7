"""Rates of angles and angular velocities, against Siciliano et al., section 3.6, and differences by SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.algebra.numbers.floats import numbers
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.kinds.problem import Problem
from derive.mechanics.motion import Motion, Move
from tests.kinds.published import matrix, same
from tests.kinds.test_orientation import CONVENTIONS, motion

PHI, THETA, PSI = map(Symbol, ("phi", "theta", "psi"))
POINT = {"phi": 0.4, "theta": 0.9, "psi": -1.3}
H = 1e-6


def holds(derivation) -> bool:
    return all(claim.holds for claim in derivation.claims)


def problem(convention: str = "ZYZ") -> Problem:
    return Problem("motion", motion(convention, (PHI, THETA, PSI)))


def test_zyz_as_in_the_book() -> None:
    """Siciliano et al., eq. 3.64, and its singular set."""
    d = problem().ask("euler-rates", convention="ZYZ")
    book = "0,-sin(phi),cos(phi)*sin(theta)\n0,cos(phi),sin(phi)*sin(theta)\n1,0,cos(theta)"
    assert same(d.results["T"], matrix(book))
    assert same(d.results["det"], matrix("-sin(theta)").rows[0][0])
    assert [float(numbers(b.values["theta"], {})) for b in d.results["singular"]] == [0, pytest.approx(np.pi)]


@pytest.mark.parametrize("convention", CONVENTIONS)
@pytest.mark.parametrize("frame", ["base", "body"])
def test_every_sequence(convention: str, frame: str) -> None:
    d = problem(convention).ask("euler-rates", convention=convention, frame=frame)
    assert holds(d)
    angles = np.array(list(POINT.values()))
    R = Rotation.from_euler(convention, angles)
    for k in range(3):
        ahead = Rotation.from_euler(convention, angles + H * np.eye(3)[k])
        turn = ahead * R.inv() if frame == "base" else R.inv() * ahead
        assert np.allclose(np.array(numbers(d.results["T"], POINT))[:, k], turn.as_rotvec() / H, atol=1e-5)


def test_rates_solve_the_equation() -> None:
    d = problem().ask("euler-rates", convention="ZYZ")
    at = {**POINT, "omega_x": 0.3, "omega_y": -0.2, "omega_z": 1.1}
    back = np.array(numbers(d.results["T"], POINT)) @ numbers(d.results["rates"], at)
    assert np.allclose(back, [0.3, -0.2, 1.1])


def test_velocity_is_the_matrix_of_rates_times_the_rates() -> None:
    moving = problem()
    omega = moving.ask("velocity").results["omega"]
    T = np.array(numbers(moving.ask("euler-rates", convention="ZYZ").results["T"], POINT))
    rates = {"phi_dot": 0.7, "theta_dot": -0.2, "psi_dot": 0.5}
    assert np.allclose(numbers(omega, {**POINT, **rates}), T @ list(rates.values()))


def test_velocity_of_a_point_on_a_wheel() -> None:
    d = Problem("motion", Motion((Move("rotate", "z", PHI), Move("translate", "x", Symbol("r"))))).ask(
        "velocity", rates=("phi",)
    )
    assert same(d.results["v"], matrix("-r*phi_dot*sin(phi)\nr*phi_dot*cos(phi)\n0"))
    assert same(d.results["omega"], matrix("0\n0\nphi_dot"))
    assert holds(d)


def test_nothing_turns() -> None:
    still = Problem("motion", Motion((Move("translate", "x", Symbol("r")),)))
    with pytest.raises(NotDerivable, match="nothing turns"):
        still.ask("velocity")
    with pytest.raises(NotDerivable, match="no move is by b"):
        problem().ask("velocity", rates=("b",))
