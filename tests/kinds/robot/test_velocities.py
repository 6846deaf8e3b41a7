"""Inverse velocity, statics, manipulability and derivatives of Jacobians against NumPy and published numbers.

The numbers of the PUMA 560 are those of Robotics Toolbox for Python 1.5 (models.DH.Puma560), at its pose qn;
Corke, Robotics, Vision and Control, section 8.2.2 has the same manipulability, 0.0786.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from derive.algebra.numbers.floats import numbers
from derive.errors import DivisionByZero, NotDerivable
from derive.expression import Symbol, free_symbols, number
from derive.kinds.linear_systems import solution_at, solved_as_written
from derive.kinds.problem import Problem
from derive.mechanics.oracle import Oracle
from tests.kinds.robot.test_singularities import (
    ELBOW,
    IIWA,
    NAMES,
    PUMA,
    SCARA,
    STANFORD,
    THREE_R,
    TWO_R,
    UR5,
    WRIST,
    arm,
)
from tests.mechanics.robots import problem

VALUES = {s: 0.4 + 0.07 * k for k, s in enumerate(NAMES)}
ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")
PUMA_560 = (
    ("q1*", "0.67183", "0", "90 deg"), ("q2*", "0", "0.4318", "0"), ("q3*", "0.15005", "0.0203", "-90 deg"),
    ("q4*", "0.4318", "0", "90 deg"), ("q5*", "0", "0", "-90 deg"), ("q6*", "0", "0", "0"),
)  # fmt: skip
QN = dict(
    zip(("q1", "q2", "q3", "q4", "q5", "q6"), (0, math.pi / 4, -math.pi, 0, math.pi / 4, 0), strict=True)
)
SLOW = dict(zip(("q1", "q2", "q3", "q4", "q5", "q6"), (0.1, 0.2, 0.3, 0.4, 0.5, 0.6), strict=True))


def jacobian(rows: Any, names: tuple[str, ...], at: dict[str, float]) -> Any:
    J = Oracle(arm(rows), {}).jacobian(at, len(rows), (0, 0, 0))
    return J[[ROWS.index(name) for name in names]]


CASES = [
    (TWO_R, ("vx", "vy")), (THREE_R, ("vx", "vy", "wz")), (THREE_R, ("vx", "vy")),
    (ELBOW, ("vx", "vy", "vz")), (SCARA, ("vx", "vy", "vz", "wz")), (WRIST, ("wx", "wy", "wz")),
    (PUMA, ROWS), (STANFORD, ROWS),
]  # fmt: skip


@pytest.mark.parametrize(("rows", "names"), CASES)
def test_joint_rates_are_those_of_the_pseudo_inverse(rows, names) -> None:
    found = problem(arm(rows)).ask("inverse-velocity", rows=names)
    assert all(claim.holds for claim in found.claims)
    wanted = {name: 0.3 + 0.2 * k for k, name in enumerate(names)}
    qdot = numbers(found.results["qdot"], {**VALUES, **wanted})
    expected = np.linalg.pinv(jacobian(rows, names, VALUES)) @ list(wanted.values())
    assert qdot == pytest.approx(list(expected), rel=1e-5)


def test_fewer_joints_than_velocities_leave_the_least_error() -> None:
    rows = (("q1*", "0", "0", "90 deg"), ("q2*", "0", "a2", "0"))
    found = problem(arm(rows)).ask("inverse-velocity")
    velocity = {"vx": 0.3, "vy": 0.5, "vz": -0.4}
    qdot = numbers(found.results["qdot"], {**VALUES, **velocity})
    expected, *_ = np.linalg.lstsq(
        jacobian(rows, ("vx", "vy", "vz"), VALUES), list(velocity.values()), rcond=None
    )
    assert qdot == pytest.approx(list(expected), rel=1e-6)


@pytest.mark.parametrize(
    ("rows", "names"), [(UR5, ()), (IIWA, ()), (IIWA, ("vx", "vy", "vz")), (PUMA[:5], ())]
)
def test_rates_that_fill_pages_are_told_by_equations(rows, names) -> None:
    """Inverse, least rates, least error: as NumPy's pseudo-inverse of the rows of J."""
    found = problem(arm(rows)).ask("inverse-velocity", rows=names).results["qdot"]
    wanted = names or ("vx", "vy", "vz", "wx", "wy", "wz")
    velocity = dict(zip(wanted, (0.3, 0.5, -0.4, 0.1, 0.7, -0.2), strict=False))
    at = {**VALUES, "d7": 0.2, "q7": 0.6}
    qdot = solution_at(found, {**at, **velocity})
    expected = np.linalg.pinv(jacobian(rows, wanted, at)) @ list(velocity.values())
    assert qdot == pytest.approx(list(expected), rel=1e-6)


def test_equations_are_solved_again_as_they_are_written() -> None:
    """x + y = a, x - y = b with b = 1: in ball arithmetic, from the text of the JSON."""
    told = {
        "unknowns": ["x"], "auxiliary": ["y"], "where": {"b": "2/2"},
        "equations": ["x + y = a", "x - y = b"],
    }  # fmt: skip
    assert solved_as_written(told, {"a": number(4)}) == [2.5, 1.5]
    with pytest.raises(DivisionByZero):
        solved_as_written({"unknowns": ["x", "y"], "equations": ["x + y = 1", "2*x + 2*y = 2"]}, {})


@pytest.mark.parametrize("rows", [TWO_R, THREE_R, ELBOW, SCARA, WRIST, PUMA])
def test_statics_is_the_transpose(rows) -> None:
    found = problem(arm(rows)).ask(
        "statics", rows=("vx", "vy", "wz"), force=(number(3), Symbol("fy"), number(2))
    )
    tau = numbers(found.results["tau"], {**VALUES, "fy": -1.5})
    expected = jacobian(rows, ("vx", "vy", "wz"), VALUES).T @ [3, -1.5, 2]
    assert tau == pytest.approx(list(expected), abs=1e-7)


@pytest.mark.parametrize("acting", ["on-environment", "on-robot"])
@pytest.mark.parametrize("frame", ["base", "tool"])
@pytest.mark.parametrize("rows", [TWO_R, THREE_R, ELBOW, SCARA, WRIST, PUMA])
def test_statics_in_both_frames(rows, frame, acting) -> None:
    """By the pose and the Jacobian in numbers: what acts on the robot is balanced by the opposite torques."""
    names, force = ("vx", "vz", "wy"), (3.0, -1.5, 2.0)
    robot = arm(rows)
    options = {"in": frame, "rows": names, "force": tuple(map(number, ("3", "-1.5", "2"))), "acting": acting}
    found = problem(robot).ask("statics", **options)
    given = np.zeros(6)
    given[[0, 2, 4]] = force
    R = Oracle(robot, {}).tool(VALUES)[:3, :3]
    turn = R if frame == "tool" else R.T
    wrench = np.concatenate([turn @ given[:3], turn @ given[3:]])
    assert np.allclose(numbers(found.results["wrench"], VALUES), wrench)
    tau = jacobian(rows, ROWS, VALUES).T @ (wrench if frame == "tool" else given)
    sign = 1 if acting == "on-environment" else -1
    assert np.allclose(numbers(found.results["tau"], VALUES), sign * tau, atol=1e-7)


def test_a_force_in_the_plane_is_enough() -> None:
    """tau of the chapter on the planar arm: J^T f."""
    found = problem(arm(TWO_R)).ask("statics", force=(Symbol("fx"), Symbol("fy")))
    at = {"l1": 0.5, "l2": 0.4, "q1": 0.3, "q2": 0.8, "fx": 2.0, "fy": -1.0}
    s1, c1, s12, c12 = math.sin(0.3), math.cos(0.3), math.sin(1.1), math.cos(1.1)
    expected = [2 * (-0.5 * s1 - 0.4 * s12) - (0.5 * c1 + 0.4 * c12), 2 * (-0.4 * s12) - 0.4 * c12]
    assert numbers(found.results["tau"], at) == pytest.approx(expected)


def test_a_force_with_too_many_components() -> None:
    with pytest.raises(NotDerivable, match="give one for each"):
        problem(arm(TWO_R)).ask("statics", force=(number(1),) * 4)


@pytest.mark.parametrize(("rows", "names"), CASES)
def test_manipulability_is_the_product_of_the_singular_values(rows, names) -> None:
    found = problem(arm(rows)).ask("manipulability", rows=names)
    values = np.linalg.svd(jacobian(rows, names, VALUES), compute_uv=False)
    assert numbers(found.results["w"], VALUES) == pytest.approx(float(np.prod(values)), rel=1e-6)


def test_manipulability_of_the_puma_is_the_published_one() -> None:
    w = problem(arm(PUMA_560)).ask("manipulability", rows=ROWS).results["w"]
    assert numbers(w, QN) == pytest.approx(0.07861716534599998, rel=1e-9)
    w = problem(arm(PUMA_560)).ask("manipulability", rows=("vx", "vy", "vz")).results["w"]
    assert numbers(w, QN) == pytest.approx(0.11118146146764128, rel=1e-9)


def test_axes_are_the_singular_values_and_their_vectors() -> None:
    point = tuple((name, parse_number(VALUES[name])) for name in ("q1", "q2", "l1", "l2"))
    found = problem(arm(TWO_R)).ask("manipulability", evaluate=point)
    J = jacobian(TWO_R, ("vx", "vy"), VALUES)
    U, values, _ = np.linalg.svd(J)
    assert found.evaluated["axes"] == pytest.approx(list(values), rel=1e-6)
    assert found.evaluated["force_axes"] == pytest.approx([1 / values[1], 1 / values[0]], rel=1e-6)
    for k, direction in enumerate(found.evaluated["directions"]):
        assert abs(np.dot(direction, U[:, k])) == pytest.approx(1, abs=1e-6)
    assert found.evaluated["force_directions"] == found.evaluated["directions"][::-1]


def parse_number(value: float) -> Any:
    from fractions import Fraction

    return number(Fraction(value))


def test_at_a_singular_configuration_a_force_is_unbounded() -> None:
    point = (("q1", number(0)), ("q2", number(0)), ("l1", number(1)), ("l2", number(1)))
    found = problem(arm(TWO_R)).ask("manipulability", evaluate=point)
    assert found.evaluated["axes"][1] == 0
    assert found.evaluated["force_axes"][0] == "infinite"
    endless, bounded = found.results["force_axes"]
    assert endless == "infinite" and numbers(bounded, {}) == found.evaluated["force_axes"][1]


def test_positive_lengths_come_out_of_the_bars() -> None:
    arm_2r = Problem("robot", arm(TWO_R), {}, {"l1": "positive", "l2": "positive"})
    w = arm_2r.ask("manipulability").results["w"]
    assert numbers(w, {"l1": 2, "l2": 3, "q2": -0.5}) == pytest.approx(6 * math.sin(0.5))


# Robotics Toolbox, jacob0_dot(qn, [0.1, ..., 0.6]) of the linear rows.
PUMA_J_DOT = [
    [-0.05963031, -0.20655296, -0.14548722, 0, 0, 0],
    [0.11378075, 0.00143543, 0.0319683, 0, 0, 0],
    [0, 0.09877575, 0.15984149, 0, 0, 0],
]


def test_the_derivative_of_the_jacobian_is_the_published_one() -> None:
    found = problem(arm(PUMA_560)).ask("jacobian-derivative", rows=("vx", "vy", "vz"))
    rates = {f"{name}_dot": rate for name, rate in SLOW.items()}
    assert np.array(numbers(found.results["J_dot"], {**QN, **rates})) == pytest.approx(
        np.array(PUMA_J_DOT), abs=1e-8
    )


# Robotics Toolbox, jacob0_analytical([0.1, ..., 0.6], representation="eul"): rates of ZYZ angles.
PUMA_ANALYTIC = [
    [1, -0.151510832, -0.151510832, 0.5631137475, 0.2713077689, 0],
    [0, 0.9743447166, 0.9743447166, -0.1078999054, 0.9743447166, 0],
    [0, 0.2713077689, 0.2713077689, 0.5631137475, -0.151510832, 1],
]
PUMA_RPY = [
    [1.4586141665, 0.6924823828, 0.6924823828, 1.31336484, 0.8863929831, 1],
    [0.430630061, -0.8980196484, -0.8980196484, 0.3347159892, -0.7159412484, 0],
    [1.1458610457, 0.6438351174, 0.6438351174, 0.5547253803, 1.1283264816, 0],
]


def rates_of_rotation(convention: str) -> Any:
    """The lower half of the analytic Jacobian of the PUMA 560, by differences of SciPy's angles."""
    from scipy.spatial.transform import Rotation

    oracle, h = Oracle(arm(PUMA_560), {}), 1e-6
    columns = []
    for name in SLOW:
        ahead, behind = (
            Rotation.from_matrix(oracle.tool({**SLOW, name: SLOW[name] + step})[:3, :3]).as_euler(convention)
            for step in (h, -h)
        )
        columns.append((ahead - behind) / (2 * h))
    return np.array(columns).T


@pytest.mark.parametrize("convention", ["ZYX", "ZYZ", "XYZ", "xyz", "YXY"])
def test_the_analytic_jacobian_gives_the_rates_of_scipys_angles(convention: str) -> None:
    point = tuple((name, parse_number(value)) for name, value in SLOW.items())
    found = problem(arm(PUMA_560)).ask("jacobian", kind="analytic", convention=convention, evaluate=point)
    assert all(claim.holds for claim in found.claims)
    assert np.array(found.evaluated["J"])[3:] == pytest.approx(rates_of_rotation(convention), abs=1e-6)


def test_the_analytic_jacobian_is_the_published_one() -> None:
    point = tuple((name, parse_number(value)) for name, value in SLOW.items())
    found = problem(arm(PUMA_560)).ask("jacobian", kind="analytic", convention="ZYZ", evaluate=point)
    assert np.array(found.evaluated["J"])[3:] == pytest.approx(np.array(PUMA_ANALYTIC), abs=1e-9)


def test_a_wrist_that_makes_the_rotations_of_its_angles_has_their_rates() -> None:
    found = problem(arm(WRIST)).ask("jacobian", kind="analytic", convention="ZYZ")
    own = found.step("J_own").result
    assert numbers(own, dict.fromkeys(free_symbols(own), 0.7))[3:] == [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
    ]


def test_angles_that_always_fail_are_refused() -> None:
    with pytest.raises(NotDerivable, match="choose another convention"):
        problem(arm(TWO_R)).ask("jacobian", kind="analytic", convention="ZYZ")


def test_rates_of_angles_belong_to_no_frame() -> None:
    with pytest.raises(NotDerivable, match="belong to no frame"):
        problem(arm(WRIST)).ask("jacobian", kind="analytic", frame="tool")
