"""Dynamics of arms so long that no line has tau_1, or that only numbers are found: against NumPy."""

from __future__ import annotations

import random
from typing import Any

import numpy as np
import pytest

import derive
from tests.random_sheets import STANDARD, inertia, jacobian, torques, value


def arm(*twists: str) -> dict[str, Any]:
    """A joint for each twist, every length and every body in letters."""
    links = [
        {"theta": f"theta{i}*", "d": f"d{i}", "a": f"a{i}", "alpha": twist}
        | {"mass": f"m{i}", "com": [f"x{i}", f"y{i}", f"z{i}"], "inertia": [f"Ix{i}", f"Iy{i}", f"Iz{i}"]}
        for i, twist in enumerate(twists, 1)
    ]
    return {"gravity": [0, 0, "-g"], "links": links}


def point(described: dict[str, Any], variables: list[str], **forces: float) -> dict[str, float]:
    draw, n = random.Random(5), range(1, len(variables) + 1)
    letters = [f"{name}{i}" for name in ("d", "a", "m", "x", "y", "z", "Ix", "Iy", "Iz") for i in n]
    letters += [each["alpha"] for each in described["links"] if each["alpha"].isidentifier()]
    names = (*letters, *variables, *(f"{each}_dot" for each in variables))
    return {name: round(draw.uniform(0.2, 0.9), 3) for name in names} | {"g": 9.81, **forces}


def by_energies(described: dict[str, Any], variables: list[str], at: dict[str, float]) -> tuple[Any, Any]:
    """h, and the accelerations that the joint forces bring about."""
    standard = {**described, "convention": STANDARD}
    h = torques(standard, variables, at | {f"{each}_ddot": 0.0 for each in variables})
    forces = np.array([at[f"tau_{k}"] for k, _ in enumerate(variables, 1)])
    return h, np.linalg.solve(inertia(standard, variables, at), forces - h)


def test_two_joints_with_a_twist_and_bodies_in_letters() -> None:
    described, variables = arm("60 deg", "0"), ["theta1", "theta2"]
    answer = derive.robot(**described).forward_dynamics()
    assert all(claim.holds for claim in answer.claims)
    at = point(described, variables, tau_1=1.3, tau_2=-0.7)
    h, wanted = by_energies(described, variables, at)
    parts = {f"h_{k}": value(each, at) for k, each in enumerate(answer.results["h"], 1)}
    found = [value(each, at | parts) for each in answer.results["qddot"]]
    assert parts["h_2"] == pytest.approx(h[1], rel=1e-7)
    assert found == pytest.approx(list(wanted), rel=1e-7)


def test_three_joints_that_are_too_long_in_letters_are_solved_at_a_point() -> None:
    described, variables = arm("alpha1", "alpha2", "0"), ["theta1", "theta2", "theta3"]
    at = point(described, variables, tau_1=1.3, tau_2=-0.7, tau_3=0.2)
    evaluated = derive.robot(**described).forward_dynamics(evaluate=at).evaluated
    h, wanted = by_energies(described, variables, at)
    assert np.ravel(evaluated["h"]) == pytest.approx(list(h), rel=1e-6)
    assert np.ravel(evaluated["qddot"]) == pytest.approx(list(wanted), rel=1e-6)


def test_eight_joints_are_solved_at_a_point_and_so_is_the_inertia_at_the_hand() -> None:
    described = arm(*["90 deg", "-90 deg"] * 4)
    variables = [f"theta{i}" for i in range(1, 9)]
    at = point(described, variables, **{f"tau_{i}": 0.1 * i for i in range(1, 9)})
    robot = derive.robot(**described)
    h, wanted = by_energies(described, variables, at)
    found = robot.forward_dynamics(evaluate=at).evaluated
    assert np.ravel(found["h"]) == pytest.approx(list(h), rel=1e-5, abs=1e-6)
    assert np.ravel(found["qddot"]) == pytest.approx(list(wanted), rel=1e-5, abs=1e-6)
    still = {name: at[name] for name in at if not name.endswith("_dot") and name[:3] != "tau"}
    rows = ["vx", "vy", "vz", "wx", "wy", "wz"]
    shown = robot.operational_space_inertia(rows=rows, evaluate=still).evaluated["Lambda"]
    standard = {**described, "convention": STANDARD}
    J, D = jacobian(standard, variables, at), inertia(standard, variables, at)
    assert np.array(shown, dtype=float) == pytest.approx(np.linalg.inv(J @ np.linalg.solve(D, J.T)), rel=1e-5)
