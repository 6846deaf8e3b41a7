"""Forward dynamics of arms so long that no line has tau_1: against the energies of NumPy."""

from __future__ import annotations

import random
from typing import Any

import numpy as np
import pytest

import derive
from tests.random_sheets import STANDARD, inertia, torques, value


def arm() -> dict[str, Any]:
    links = [
        {"theta": "theta1*", "d": "d1", "a": "a1", "alpha": "60 deg"},
        {"theta": "theta2*", "d": 0, "a": "a2", "alpha": 0},
    ]
    bodies = (
        {"mass": f"m{i}", "com": [f"x{i}", f"y{i}", f"z{i}"], "inertia": [f"Ix{i}", f"Iy{i}", f"Iz{i}"]}
        for i in (1, 2)
    )
    return {"gravity": [0, 0, "-g"], "links": [a | b for a, b in zip(links, bodies, strict=True)]}


def test_two_joints_with_a_twist_and_bodies_in_letters() -> None:
    described, variables = arm(), ["theta1", "theta2"]
    answer = derive.robot(**described).forward_dynamics()
    assert all(claim.holds for claim in answer.claims)
    draw = random.Random(5)
    letters = [f"{name}{i}" for name in ("d", "a", "m", "x", "y", "z", "Ix", "Iy", "Iz") for i in (1, 2)]
    names = (*letters, *variables, *(f"{each}_dot" for each in variables))
    at = {name: draw.uniform(0.2, 0.9) for name in names} | {"g": 9.81, "tau_1": 1.3, "tau_2": -0.7}
    still = {f"{each}_ddot": 0.0 for each in variables}
    h = torques({**described, "convention": STANDARD}, variables, at | still)
    D = inertia({**described, "convention": STANDARD}, variables, at)
    wanted = np.linalg.solve(D, np.array([at["tau_1"], at["tau_2"]]) - h)
    parts = {f"h_{k}": value(each, at) for k, each in enumerate(answer.results["h"], 1)}
    found = [value(each, at | parts) for each in answer.results["qddot"]]
    assert parts["h_2"] == pytest.approx(h[1], rel=1e-7)
    assert found == pytest.approx(list(wanted), rel=1e-7)
