"""The pose of a motion: where it has taken the frame in the end."""

from __future__ import annotations

from derive.expression import Symbol
from derive.kinds.pose._given import Given, PoseOptions
from derive.kinds.problem import Problem
from derive.mechanics.oracle import made
from derive.mechanics.poses import composed
from derive.mechanics.sequences import in_product_order


def given(options: PoseOptions, problem: Problem, rotation_only: bool) -> Given:
    """T, which rests on the rotation alone where no more is needed."""
    moves = in_product_order(problem.subject.moves)
    uses = problem.ask("rotation-matrix" if rotation_only else "transform")
    T = composed(moves)
    return Given(problem, Symbol("T"), Symbol("R"), T, (uses,), lambda at: made(problem.subject.moves, at))
