"""Names for the place on a path and its parameter that stand for nothing else in the problem."""

from __future__ import annotations

from derive.expression import Symbol
from derive.kinds.problem import Problem
from derive.mechanics.paths import Curve, Path
from derive.names import free


def place_name(problem: Problem) -> Symbol:
    """A letter for the place."""
    return Symbol(free(problem.taken, "p", "P", "p_e"))


def parameter_name(path: Path, problem: Problem) -> str:
    """The author's own, or s."""
    if isinstance(path.shape, Curve):
        return path.shape.parameter
    return free(problem.taken, "s", "lambda", "sigma", "u")
