"""Poses and Jacobians of the catalogue against those of the Robotics Toolbox (cases/)."""

from __future__ import annotations

import numpy as np
import pytest

from derive.algebra.numbers.floats import matrix_numbers, numbers
from tests.robots.arms import ARMS, CASES, last_pose, points, problem, tolerance

every_case = pytest.mark.parametrize("name", CASES)


def holds(derivation) -> bool:
    return all(claim.holds for claim in derivation.claims)


@every_case
def test_forward_kinematics(name: str) -> None:
    found = problem(name).ask("forward-kinematics")
    for at, published in points(name):
        assert np.allclose(
            numbers(found.results[last_pose(problem(name))], at), published["T"], atol=tolerance(name)
        )
    assert holds(found)


@every_case
def test_jacobian_in_the_base_frame(name: str) -> None:
    found = problem(name).ask("jacobian")
    for at, published in points(name):
        assert np.allclose(numbers(found.results["J"], at), published["J"], atol=tolerance(name))
    assert holds(found)


@every_case
def test_jacobian_in_the_frame_of_the_end_effector(name: str) -> None:
    found = problem(name).ask("space-jacobian", frame="body")
    for at, published in points(name):
        assert np.allclose(numbers(found.results["J_b"], at), published["J_e"], atol=tolerance(name))
    assert holds(found)


@every_case
def test_product_of_exponentials(name: str) -> None:
    found = problem(name).ask("product-of-exponentials")
    result = f"T_{len(problem(name).subject.variables)}^0"
    for at, published in points(name):
        assert np.allclose(numbers(found.results[result], at), published["T"], atol=tolerance(name))
    assert holds(found)


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_rows_of_both_conventions_make_the_same_arm(name: str, convention: str) -> None:
    """The rows restated, or found where the arm has others: proven by normal form on the way."""
    found = problem(name).ask("dh-table", convention=convention)
    assert holds(found)
    assert len(found.results["DH"].rows) == len(problem(name).subject.links)


@pytest.mark.parametrize("name", [arm for arm in ARMS if arm != "two-link-bars"])
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_rows_found_from_the_axes_alone(name: str, convention: str) -> None:
    from derive.kinds.robot._rows.dh_found import found_rows
    from derive.kinds.work import Work
    from derive.mechanics.chain import chain

    arm = problem(name)
    rows, _ = found_rows(arm.subject, convention, arm)
    claims = rows.proved(rows.lines(Work(arm))).claims
    assert all(claim.holds for claim in claims)
    at = {symbol: 0.3 + 0.1 * k for k, symbol in enumerate(sorted(arm.symbols))}
    given = matrix_numbers(chain(arm.subject).T_tool, at)
    assert np.allclose(matrix_numbers(rows.pose(), at), given)
