"""Equations of motion against textbooks, another program, and a second route of our own."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings

from derive.algebra.formulas.grammar import parse
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.scalar import Scalar
from derive.expression import Matrix
from derive.kinds.checks import random_points
from derive.mechanics.dynamics import christoffel
from derive.mechanics.oracle import Oracle
from tests.mechanics.reference import (
    PUMA_BODIES,
    PUMA_GRAVLOAD,
    PUMA_INERTIA,
    PUMA_Q,
    PUMA_QD,
    PUMA_QDD,
    PUMA_RNE,
)
from tests.mechanics.robots import body, problem, robot, robots, row, symbols
from tests.trees import matrix

ELBOW = robot(
    row("q1*", "0", "l1", "0", body("m1", "lc1 - l1, 0, 0", "0, 0, I1, 0, 0, 0")),
    row("q2*", "0", "l2", "0", body("m2", "lc2 - l2, 0, 0", "0, 0, I2, 0, 0, 0")),
    gravity="0, -g, 0",
)


def result(derivation, name):
    found = derivation.results[name]
    return normal_matrix(found) if isinstance(found, Matrix) else normal(found)


def test_the_planar_elbow_manipulator() -> None:
    """Spong et al., Robot Modeling and Control, section 6.4."""
    found = problem(ELBOW).ask("dynamics")
    assert result(found, "D") == normal_matrix(
        matrix("""
        m1 lc1^2 + m2 (l1^2 + lc2^2 + 2 l1 lc2 cos(q2)) + I1 + I2; m2 (lc2^2 + l1 lc2 cos(q2)) + I2
        m2 (lc2^2 + l1 lc2 cos(q2)) + I2; m2 lc2^2 + I2""")
    )
    h = normal(parse("-m2 l1 lc2 sin(q2)"))
    symbols = {"111": 0, "121": h, "211": h, "221": h, "112": -h, "122": 0, "212": 0, "222": 0}
    for index, value in symbols.items():
        assert result(found, f"c_{index}") == value
    assert result(found, "P") == normal(parse("(m1 lc1 + m2 l1) g sin(q1) + m2 lc2 g sin(q1 + q2)"))
    assert result(found, "g") == normal_matrix(
        matrix("""
        (m1 lc1 + m2 l1) g cos(q1) + m2 lc2 g cos(q1 + q2)
        m2 lc2 g cos(q1 + q2)""")
    )


def test_the_two_link_cartesian_manipulator() -> None:
    """Spong et al., section 6.4: D is diagonal and constant, and no symbol is left."""
    arm = robot(
        row("0", "d1*", "0", "-90 deg", body("m1", "0, 0, 0", "0, 0, 0, 0, 0, 0")),
        row("0", "d2*", "0", "0", body("m2", "0, 0, 0", "0, 0, 0, 0, 0, 0")),
    )
    found = problem(arm).ask("dynamics")
    assert result(found, "D") == normal_matrix(matrix("m1 + m2; 0\n 0; m2"))
    assert all(result(found, name) == 0 for name in found.results if name.startswith("c_"))
    assert result(found, "g") == normal_matrix(matrix("g (m1 + m2)\n 0"))


def test_a_polar_arm() -> None:
    """A mass m at the distance r on a turning line: the Coriolis moment 2 m r rdot thetadot and the
    centrifugal force m r thetadot^2 of every mechanics book."""
    arm = robot(
        row("theta*", "0", "0", "90 deg"),
        row("0", "r*", "0", "0", body("m", "0, 0, 0", "0, I, 0, 0, 0, 0")),
        gravity="0, 0, 0",
    )
    found = problem(arm).ask("dynamics")
    assert result(found, "D") == normal_matrix(matrix("I + m r^2; 0\n 0; m"))
    assert result(found, "tau") == normal_matrix(
        matrix("""
        (I + m r^2) theta_ddot + 2 m r r_dot theta_dot
        m r_ddot - m r theta_dot^2""")
    )


def test_the_two_link_arm_of_point_masses() -> None:
    """Lynch and Park, Modern Robotics, section 8.1.1."""
    arm = robot(
        row("x*", "0", "L1", "0", body("m1", "0, 0, 0", "0, 0, 0, 0, 0, 0")),
        row("y*", "0", "L2", "0", body("m2", "0, 0, 0", "0, 0, 0, 0, 0, 0")),
        gravity="0, -g, 0",
    )
    first = (
        "(m1 L1^2 + m2 (L1^2 + 2 L1 L2 cos(y) + L2^2)) x_ddot + m2 (L1 L2 cos(y) + L2^2) y_ddot"
        " - m2 L1 L2 sin(y) (2 x_dot y_dot + y_dot^2) + (m1 + m2) L1 g cos(x) + m2 g L2 cos(x + y)"
    )
    second = "m2 (L1 L2 cos(y) + L2^2) x_ddot + m2 L2^2 y_ddot + m2 L1 L2 x_dot^2 sin(y) + m2 g L2 cos(x + y)"
    tau = matrix(f"{first}\n{second}")
    assert result(problem(arm).ask("dynamics"), "tau") == normal_matrix(tau)


PUMA = robot(
    *(row(*each["row"], body(each["mass"], each["com"], each["inertia"])) for each in PUMA_BODIES),
    gravity="0, 0, -9.81",
)


@pytest.fixture(scope="module")
def puma():
    return problem(PUMA).ask("dynamics")


def test_the_inertia_matrix_of_the_puma(puma) -> None:
    at = {f"theta{i}": q for i, q in enumerate(PUMA_Q["q"], 1)}
    D = result(puma, "D")
    assert np.allclose(
        [[scalar_number(entry, at) for entry in line] for line in D.rows], PUMA_INERTIA, atol=1e-12
    )


def test_the_torques_of_the_puma(puma) -> None:
    at = {}
    for i, values in enumerate(zip(PUMA_Q["q"], PUMA_QD, PUMA_QDD, strict=True), 1):
        at |= dict(zip((f"theta{i}", f"theta{i}_dot", f"theta{i}_ddot"), values, strict=True))
    torques = [scalar_number(entry, at) for entry in result(puma, "tau").entries]
    assert np.allclose(torques, PUMA_RNE, atol=1e-12)
    still = [scalar_number(entry, at) for entry in result(puma, "g").entries]
    assert np.allclose(still, PUMA_GRAVLOAD, atol=1e-12)


@settings(max_examples=12)
@given(robots(most=3, bodies=True))
def test_the_laws_of_random_arms(arm) -> None:
    found = problem(arm).ask("dynamics")
    assert all(claim.holds for claim in found.claims)
    D = result(found, "D")
    assert D == D.T
    names = arm.variables
    symbols_of = christoffel(D, names)
    rates = [Scalar.symbol(f"{name}_dot") for name in names]
    for j, k in product(range(len(names)), repeat=2):
        C_kj = sum((symbols_of[i + 1, j + 1, k + 1] * rate for i, rate in enumerate(rates)), Scalar.of(0))
        C_jk = sum((symbols_of[i + 1, k + 1, j + 1] * rate for i, rate in enumerate(rates)), Scalar.of(0))
        slope = sum(
            (D.diff(name)[k, j] * rate for name, rate in zip(names, rates, strict=True)), Scalar.of(0)
        )
        assert C_kj + C_jk == slope  # dD/dt - 2 C is skew-symmetric
        assert result(found, f"c_{j + 1}{k + 1}{1}") == symbols_of[j + 1, k + 1, 1]


@settings(max_examples=12)
@given(robots(most=3, bodies=True))
def test_torques_agree_with_newton_and_euler(arm) -> None:
    tau = result(problem(arm).ask("dynamics"), "tau")
    rates = [f"{name}_{dot}" for name in arm.variables for dot in ("dot", "ddot")]
    for at in random_points([*symbols(arm), "g", *rates], 2):
        ours = [scalar_number(entry, at) for entry in tau.entries]
        assert np.allclose(ours, Oracle(arm, {}).torques(at), atol=1e-8)


@settings(max_examples=12)
@given(robots(most=3, bodies=True))
def test_the_inertia_matrix_is_positive_definite_for_possible_bodies(arm) -> None:
    D = result(problem(arm).ask("inertia-matrix"), "D")
    for at in random_points(symbols(arm), 2):
        values = np.linalg.eigvalsh([[scalar_number(entry, at) for entry in line] for line in D.rows])
        assert values.min() > -1e-12


def test_energy_at_rest_is_what_gravity_takes() -> None:
    found = problem(ELBOW).ask("gravity")
    P, g = result(found, "P"), result(found, "g")
    assert ScalarMatrix.column([P.diff("q1"), P.diff("q2")]) == g
