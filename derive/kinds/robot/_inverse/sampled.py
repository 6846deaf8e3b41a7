"""Poses that an arm reaches, with the joint values they come from."""

from __future__ import annotations

import math
import random

from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal


def sample_points(chain: Chain, goal: Goal, problem: Problem, count: int) -> tuple[dict[str, float], ...]:
    """Configurations of the arm at random, and what is given of its end-effector there: lengths from 0.2 to
    1.9, angles of a whole turn, displacements of both signs but where they are said to be positive."""
    draw, oracle = random.Random(1), oracle_of(problem)
    joints = sorted((joint for _, joint in chain.moving), key=lambda joint: joint.type == "prismatic")
    points = []
    for _ in range(count):
        names = sorted(problem.symbols - {joint.variable for joint in joints})
        point = {name: draw.uniform(0.2, 1.9) for name in names}
        for joint in joints:
            name = joint.variable
            if joint.type != "prismatic":
                point[name] = draw.uniform(-math.pi, math.pi)
            else:
                positive = problem.assumptions.get(name) in ("positive", "nonnegative")
                point[name] = draw.uniform(0.2, 1.9) * (1 if positive else draw.choice((1, -1)))
        at = dict(oracle.at(point))
        points.append({**at, **goal.numbers(oracle.tool(at))})
    return tuple(points)
