"""The axis of every joint and a point on it, and the poses they are read from, in the base frame."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.numbers.floats import matrix_numbers
from derive.derivation import Claim, Derivation, named_results
from derive.expression import Expr
from derive.kinds.checks import agreement, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import axis_steps, chain_of, oracle_of, pose_name
from derive.kinds.robot._columns import pose_steps
from derive.kinds.robot._couplings import motion_steps
from derive.mechanics.chain import Chain
from derive.mechanics.robot import Robot

RESULTS = {
    "z_0, z_1, ...": "the axis of each joint (3 by 1); z_i that of joint i in the modified convention",
    "o_0, o_1, ...": "the origins of their frames, points on the axes (3 by 1)",
    "k_1, k_2, ...": "the axis of a joint that is that of no frame (3 by 1)",
    "p_1, p_2, ...": "a point on such an axis (3 by 1)",
    "phi, Gamma": "of coupled joints: what the rows move by (m by 1), and its partial derivatives (m by n)",
}
EXAMPLE = """\
title: The axes of a planar arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  find: joint-axes
"""


class Options(OptionsModel):
    """None."""


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """The third columns of the poses are the axes, the fourth their points (Spong et al., section 4.6)."""
    found = chain_of(problem)
    poses = problem.ask("forward-kinematics")
    last = len(robot.links)
    axes = axis_steps(problem, found, last + 1)
    motions = motion_steps(problem, found.coupling) if found.coupling else ()
    frames = pose_steps(problem, found, last)
    steps = (*frames, *axes, *motions)
    definitions: dict[Expr, Expr] = {**poses.definitions}
    definitions |= {pose_name(i): problem.readable_matrix(found.T[i]) for i in range(1, last + 1)}
    definitions |= named_results((*frames, *axes))
    definitions |= {step.chain[0]: step.result for step in motions if step.rule != "law"}
    results = {step.name: problem.final(step.result) for step in (*axes, *motions) if step.rule != "law"}
    claims = (*links(steps, {**problem.names, **definitions}), *_second_route(problem, found))
    return Derivation("joint-axes", steps, results, claims, definitions, uses=(poses,))


def _second_route(problem: Problem, found: Chain) -> list[Claim]:
    """Each pose that is not the whole arm's, composed in numbers."""
    oracle = oracle_of(problem)

    def claim(i: int) -> Claim:
        def composed(at: Mapping[str, float]) -> Any:
            return oracle.poses(oracle.at(at))[i]

        def ours(at: Mapping[str, float]) -> Any:
            return matrix_numbers(found.T[i], oracle.at(at))

        return agreement("poses-composed", problem.symbols, ours, composed, frame=i)

    return [claim(i) for i in range(1, len(found.T_local))]
