"""Every arm of exercises/robots/ with symbolic bodies: Euler-Lagrange and Newton-Euler have the same normal
forms, and dD/dt - 2C is skew-symmetric."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from derive.mechanics.robot import Robot
from derive.sheet.load import load_sheet
from tests.mechanics.robots import body
from tests.mechanics.two_derivations import Arm

ROBOTS = Path(__file__).parents[2] / "exercises" / "robots"
FULL = 4  # joints; arms with more have principal axes along their frames


def robot_of(path: Path, folder: Path) -> Robot:
    """The robot of a file, each link with a body in symbols of its own."""
    (folder / "robots").mkdir()
    (folder / "robots" / path.name).write_text(path.read_text(encoding="utf-8"), encoding="utf-8")
    sheet = folder / "sheet.yaml"
    text = f"title: t\nproblems:\n- robot: robots/{path.name}\n  find: forward-kinematics\n"
    sheet.write_text(text, encoding="utf-8")
    robot: Robot = load_sheet(sheet).problems[0].subject
    many = len(robot.variables) > FULL
    links = (replace(link, body=symbolic(i, many)) for i, link in enumerate(robot.links, 1))
    return replace(robot, links=tuple(links))


def symbolic(i: int, principal: bool):
    products = "0, 0, 0" if principal else f"Ixy{i}, Iyz{i}, Ixz{i}"
    return body(f"m{i}", f"x{i}, y{i}, z{i}", f"Ixx{i}, Iyy{i}, Izz{i}, {products}")


@pytest.mark.parametrize("name", sorted(path.stem for path in ROBOTS.glob("*.yaml")))
def test_both_derivations_agree_and_n_is_skew(name: str, tmp_path: Path) -> None:
    arm = Arm(robot_of(ROBOTS / f"{name}.yaml", tmp_path))
    (D, c, g), (D_of_forces, c_of_forces, g_of_forces) = arm.by_jacobians(), arm.by_forces()
    n = range(1, len(arm.robot.variables) + 1)
    assert D_of_forces == D
    assert all(c[ijk] == c_of_forces[ijk] for ijk in c)
    assert all(a == b for a, b in zip(g, g_of_forces, strict=True))
    for i, variable in enumerate(arm.robot.variables, 1):
        rate = D.diff(variable)  # the part of dD/dt - 2C that goes with the rate of joint i
        N = {(k, j): rate[k - 1, j - 1] - 2 * c[i, j, k] for k in n for j in n}
        assert all(N[k, j] == -N[j, k] for k in n for j in n if k <= j)
