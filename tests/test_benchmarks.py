"""The cases of the benchmarks are the robots they say, and what is timed is right."""

from __future__ import annotations

import pytest

from benchmarks.arms import ARMS
from benchmarks.cases import CASES, case
from benchmarks.grid import KINDS, robot_of, values
from benchmarks.peers import ours
from benchmarks.rows import rows_of
from benchmarks.worker import point_of
from derive.algebra.numbers.floats import scalar_number
from derive.mechanics.oracle import Oracle


@pytest.mark.parametrize("each", CASES, ids=lambda each: each.letter)
def test_every_robot_can_be_told_to_every_peer(each) -> None:
    robot = each.robot()
    assert len(rows_of(robot).rows) == len(robot.links)


def test_two_joints_agree_with_newton_and_euler() -> None:
    robot = case("A").robot()
    answer = ours.derive(ours.given(robot), case("A").asked)
    rates = {f"{name}_dot": 0.3 * k for k, name in enumerate(robot.variables, 1)}
    rises = {f"{name}_ddot": 0.7 - k for k, name in enumerate(robot.variables, 1)}
    point = {**point_of(robot), **rates, **rises}
    n = range(1, len(robot.variables) + 1)
    qd, qdd = list(rates.values()), list(rises.values())
    torques = [
        sum(scalar_number(answer.D[k - 1, j - 1], point) * qdd[j - 1] for j in n)
        + sum(scalar_number(answer.c[i, j, k], point) * qd[i - 1] * qd[j - 1] for i in n for j in n)
        + scalar_number(answer.g[k - 1], point)
        for k in n
    ]
    assert torques == pytest.approx(list(Oracle(robot, {}).torques(point)), rel=1e-9)


@pytest.mark.parametrize("arm", ARMS, ids=lambda arm: arm.name)
def test_every_arm_of_the_grid_has_a_joint_in_each_row(arm) -> None:
    robot = robot_of(arm, KINDS[-1])
    assert len(robot.variables) == len(arm.table.split(";"))
    assert {name for name, _ in values(arm, KINDS[-1])} >= {*robot.variables, "m1", "Iz1"}
