"""Rates of angles and angular velocities, against Siciliano et al., section 3.6, and differences by SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.algebra.formulas.grammar import parse
from derive.algebra.numbers.floats import numbers
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.kinds.problem import Problem
from derive.mechanics.motion import Motion, Move
from derive.mechanics.rotations import GivenRotation
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


# -- a rotation matrix that is given -----------------------------------------------------------------

PRECESSION = (("z", "Omega*t"), ("x", "beta"), ("z", "p*t"))


def test_steady_precession() -> None:
    """alpha is Omega x omega (Meriam and Kraige, Dynamics, section 7/6), of a motion and its matrix."""
    moving = Problem("motion", Motion(tuple(Move("rotate", axis, parse(by)) for axis, by in PRECESSION)))
    R = moving.ask("rotation-matrix").results["R"]
    at = {"t": 0.7, "Omega": 1.3, "beta": 0.4, "p": -2.0}
    about = np.array([0, 0, 1.3])
    spin = -2.0 * Rotation.from_euler("ZX", [0.91, 0.4]).as_matrix()[:, 2]
    for each in (moving, Problem("rotation", GivenRotation(R))):
        d = each.ask("acceleration")
        assert holds(d) and "a" not in d.results
        omega, alpha = (np.ravel(numbers(d.results[name], at)) for name in ("omega", "alpha"))
        assert np.allclose(omega, about + spin)
        assert np.allclose(alpha, np.cross(about, omega))


@pytest.mark.parametrize("convention", ["ZYX", "ZXZ", "xyz"])
def test_a_matrix_turns_as_scipy_says(convention: str) -> None:
    R = problem(convention).ask("rotation-matrix").results["R"]
    rates = {"phi_dot": 0.7, "theta_dot": -0.4, "psi_dot": 1.1}
    rises = {"phi_ddot": 0.2, "theta_ddot": 0.9, "psi_ddot": -0.5}
    start, first, second = (np.array([*each.values()]) for each in (POINT, rates, rises))
    h = 1e-4

    def there(t: float) -> Rotation:
        return Rotation.from_euler(convention, start + t * first + t * t / 2 * second)

    def omega(t: float) -> np.ndarray:
        return (there(t + h) * there(t - h).inv()).as_rotvec() / (2 * h)

    d = Problem("rotation", GivenRotation(R)).ask("acceleration")
    assert holds(d)
    ours = [np.ravel(numbers(d.results[name], POINT | rates | rises)) for name in ("omega", "alpha")]
    assert np.allclose(ours[0], omega(0), atol=1e-6)
    assert np.allclose(ours[1], (omega(h) - omega(-h)) / (2 * h), atol=1e-5)


def test_names_of_entries_do_not_turn() -> None:
    entries = matrix("r11,r12,r13\nr21,r22,r23\nr31,r32,r33")
    with pytest.raises(NotDerivable, match="nothing says how these change"):
        Problem("rotation", GivenRotation(entries)).ask("velocity")
    with pytest.raises(NotDerivable, match="nothing turns"):
        Problem("rotation", GivenRotation(matrix("0,-1,0\n1,0,0\n0,0,1"))).ask("acceleration")
    with pytest.raises(NotDerivable, match="no entry depends on psi"):
        given = GivenRotation(matrix("cos(phi),-sin(phi),0\nsin(phi),cos(phi),0\n0,0,1"))
        Problem("rotation", given).ask("velocity", rates=("psi",))
