"""The pose of an arm: that of its end-effector."""

from __future__ import annotations

from derive.expression import Symbol
from derive.kinds.pose._given import Given, PoseOptions
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, end_frame, oracle_of


def given(options: PoseOptions, problem: Problem, rotation_only: bool) -> Given:
    """T_n^0 or T_e^0, as the forward kinematics find it."""
    n, uses = end_frame(problem.subject), (problem.ask("forward-kinematics"),)
    T = chain_of(problem).T_tool
    return Given(problem, Symbol(f"T_{n}^0"), Symbol(f"R_{n}^0"), T, uses, oracle_of(problem).tool)
