"""Screws that are found and then given in place of rows, held to the arm in numbers.

No question has them for an answer, so nothing else holds them.
"""

from __future__ import annotations

from typing import Any

from derive.algebra.numbers.floats import Point, number
from derive.kinds.checks import agreement
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.mechanics.oracle import Oracle
from derive.mechanics.oracle.poses import direction
from derive.mechanics.robot import Robot, ScrewRow


class Misgiven(Exception):
    """What would be given is not what the sheet gives; the message says what."""


def held(found: Robot, problem: Problem) -> Robot:
    """The screws that were found of the arm of a problem. Raises Misgiven where they take the end-effector
    elsewhere, or the axis of a joint is another line."""
    arm, screws = oracle_of(problem), Oracle(found, problem.where)
    still = dict.fromkeys(problem.subject.variables, 0.0)
    same = agreement(
        "arm-composed",
        problem.symbols,
        lambda at: screws.tool(arm.at(at)),
        lambda at: arm.tool(arm.at(at)),
        moving=problem.moving,
    )
    if not same.holds:
        raise Misgiven("the screws take the end-effector elsewhere")
    if problem.subject.coupled:  # an axis is that of several motions
        return found
    on_axes = agreement(
        "axes",
        problem.symbols - still.keys(),
        lambda at: _aside(found, arm, arm.at({**at, **still})),
        lambda _: [0.0] * 6 * len(found.links),
    )
    if not on_axes.holds:
        raise Misgiven("a screw is on another axis than its joint")
    return found


def _aside(found: Robot, arm: Oracle, at: Point) -> list[Any]:
    """What the directions of screws, and their points seen from the origins of the frames, have across the
    z-axes about which the rows turn: zero where they are the same lines (3 and 3 of each)."""
    import numpy as np

    frames = arm.poses(at)
    before = arm.robot.convention == "standard"
    moving = (i for i, link in enumerate(arm.robot.links, 1) if link.variable)
    across: list[Any] = []
    for i, link in zip(moving, found.links, strict=True):
        assert isinstance(link.row, ScrewRow)
        T = frames[i - 1 if before else i]
        through = np.array([number(part, at) for part in link.row.through])
        across += [np.cross(direction(link.row.axis, at), T[:3, 2]), np.cross(through - T[:3, 3], T[:3, 2])]
    return across
