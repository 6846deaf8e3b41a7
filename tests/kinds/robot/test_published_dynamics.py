"""Dynamics against other programs and books: the PUMA 560 by two robotics libraries at twenty points, the
three-link arm of Modern Robotics, and the two-link arm of Spong, Hutchinson and Vidyasagar."""

from __future__ import annotations

import json
import math
from pathlib import Path
from shutil import copyfile

import numpy as np
import pytest

from derive.algebra.numbers.floats import number_rows, numbers
from derive.build import assemble
from derive.derivation import Derivation
from derive.sheet.load import load_sheet
from tests.kinds.published import matrix, same

CASES = Path(__file__).parent / "cases"
ROBOTS = Path(__file__).parents[3] / "exercises" / "robots"
JOINTS = [f"theta{i}" for i in range(1, 7)]


def derived(folder: Path, robot: str, *questions: str) -> list[Derivation]:
    """The answers about a robot, written out or in a file of exercises/robots/."""
    if robot.endswith(".yaml"):
        (folder / "robots").mkdir(exist_ok=True)
        copyfile(ROBOTS / robot, folder / "robots" / robot)
        robot = f" robots/{robot}"
    asked = "".join(f"  - {{find: {question}}}\n" for question in questions)
    sheet = folder / "sheet.yaml"
    sheet.write_text(
        f"title: t\nproblems:\n- robot:{robot.rstrip()}\n  questions:\n{asked}", encoding="utf-8"
    )
    return [q.derivation for _, q in assemble(load_sheet(sheet)).questions() if q.derivation]


@pytest.fixture(scope="module")
def puma(tmp_path_factory: pytest.TempPathFactory) -> list[Derivation]:
    folder = tmp_path_factory.mktemp("puma")
    return derived(folder, "puma560-dynamics.yaml", "inertia-matrix", "coriolis-matrix", "gravity")


@pytest.mark.parametrize("library", ["roboticstoolbox", "pinocchio"])
def test_puma_560(puma, library: str) -> None:
    case = json.loads((CASES / f"puma560-{library}.json").read_text(encoding="utf-8"))
    inertia, coriolis, weight = puma
    assert len(case["points"]) == 20
    for point in case["points"]:
        at = dict(zip(JOINTS, point["q"], strict=True))
        at |= dict(zip((f"{name}_dot" for name in JOINTS), point["qdot"], strict=True))
        speed = np.array(number_rows(coriolis.results["C"], at)) @ point["qdot"]
        assert np.allclose(number_rows(inertia.results["D"], at), point["D"], rtol=0, atol=1e-9)
        assert np.allclose(speed, point["C_qdot"], rtol=0, atol=1e-9)
        assert np.allclose(numbers(weight.results["g"], at), point["g"], rtol=0, atol=1e-9)


# -- Lynch and Park, Modern Robotics, chapter 8: the arm in the documentation of its code ---------------

# Home positions of the coms and inertias about them along the axes of the base; the first screw of the
# book's arm is (1, 0, 1, 0, 1, 0), whose axis is no unit vector: its angle counts sqrt(2) times.
MODERN_ROBOTICS = """
    gravity: [0, 0, -9.8]
    links:
    - {screw: {axis: [1, 0, 1], through: [-1, 0, 0]}, variable: q1*, mass: 3.7, com: [0, 0, 0.089159],
       inertia: [0.010267, 0.010267, 0.00666]}
    - {screw: {axis: y, through: [0, 0, 0.089]}, variable: q2*, mass: 8.393, com: [0.28, 0.13585, 0.089159],
       inertia: [0.0151074, 0.22689, 0.22689]}
    - {screw: {axis: y, through: [0.425, 0, 0.089]}, variable: q3*, mass: 2.275,
       com: [0.675, 0.01615, 0.089159], inertia: [0.004095, 0.0494433, 0.0494433]}
"""


def test_modern_robotics(tmp_path: Path) -> None:
    """MassMatrix, VelQuadraticForces and GravityForces at theta = (0.1, 0.1, 0.1), rates (0.1, 0.2, 0.3)."""
    inertia, coriolis, weight, whole = derived(
        tmp_path, MODERN_ROBOTICS, "inertia-matrix", "coriolis-matrix", "gravity", "newton-euler"
    )
    scale = np.diag([math.sqrt(2), 1, 1])
    q, rates = scale @ [0.1, 0.1, 0.1], scale @ [0.1, 0.2, 0.3]
    at = {f"q{i}": value for i, value in enumerate(q, 1)}
    at |= {f"q{i}_dot": value for i, value in enumerate(rates, 1)}
    M = scale @ number_rows(inertia.results["D"], at) @ scale
    published = [[22.5433, -0.3071, -0.0072], [-0.3071, 1.9685, 0.4322], [-0.0072, 0.4322, 0.1916]]
    assert np.allclose(M, published, rtol=0, atol=6e-5)
    c = scale @ np.array(number_rows(coriolis.results["C"], at)) @ rates
    assert np.allclose(c, [0.2645, -0.0551, -0.0069], rtol=0, atol=6e-5)
    assert np.allclose(scale @ numbers(weight.results["g"], at), [28.4033, -37.6409, -5.4416], atol=6e-5)
    rises = scale @ [2, 1.5, 1]
    at |= {f"q{i}_ddot": value for i, value in enumerate(rises, 1)}
    tau = scale @ numbers(whole.results["tau"], at)
    assert np.allclose(tau, M @ [2, 1.5, 1] + c + [28.4033, -37.6409, -5.4416], rtol=0, atol=1e-4)


# -- Spong, Hutchinson and Vidyasagar, Robot Modeling and Control, equations 6.90 and section 6.5.3 ------

THETA = """
m1*l_c1^2 + m2*l1^2 + I1
m1*l_c1 + m2*l1
m2*l_c2^2 + I2
m2*l_c2
"""
C = """
-m2*l1*l_c2*sin(theta2)*theta2_dot, -m2*l1*l_c2*sin(theta2)*(theta1_dot + theta2_dot)
m2*l1*l_c2*sin(theta2)*theta1_dot, 0
"""


def test_spong_two_links(tmp_path: Path) -> None:
    """The book's third parameter is m2 l1 l_c2; with l1 known it is the fourth here, and five become four."""
    coriolis, regressor = derived(tmp_path, "two-link-general.yaml", "coriolis-matrix", "regressor")
    assert same(coriolis.results["C"], matrix(C))
    assert same(regressor.results["base_parameters"], matrix(THETA))
