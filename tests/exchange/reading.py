"""A robot from a file, and what it is in numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from derive.mechanics.oracle.arm import Oracle
from derive.mechanics.robot import Robot
from derive.sheet.exchange.files import Wish, imported
from derive.sheet.reader import read_text
from derive.sheet.source import At
from derive.sheet.subject import read_subject
from derive.sheet.subjects.registry import Known, load

HERE = Path(__file__).parent
ROBOTS = HERE / "robots"
WISH = Wish()


def built(at: At) -> Robot:
    """The robot that is written there."""
    robot: Robot = load("robot").build(read_subject(at, "robot", Known()), at, Known())
    return robot


def read(path: Path, wish: Wish = WISH) -> Robot:
    """The robot of a file; the YAML that is printed of it is the same robot."""
    told = imported(path, wish)
    robot = built(At(told.source()))
    assert built(At(read_text(told.yaml(), Path("robot.yaml")))) == robot
    return robot


def numbers(robot: Robot, q: dict[str, float]) -> dict[str, Any]:
    """T of the end-effector, its Jacobian, D and the torques of gravity; without bodies the first two."""
    oracle = Oracle(robot, {})
    rates = {f"{name}_{dots}": 0.0 for name in q for dots in ("dot", "ddot")}
    found = {"T": oracle.tool(q), "J": oracle.jacobian(q, len(robot.links) + 1, [0.0, 0.0, 0.0])}
    if any(link.body for link in robot.links):
        found |= {"D": oracle.inertia_matrix({**q, **rates}), "g": oracle.torques_at_rest({**q, **rates})}
    return {name: np.array(value) for name, value in found.items()}
