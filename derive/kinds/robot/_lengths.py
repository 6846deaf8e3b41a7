"""In which unit the lengths of an arm are."""

from __future__ import annotations

from collections.abc import Iterable

from derive.expression import Expr, Number, walk
from derive.kinds.problem import Problem
from derive.mechanics.robot import Robot


def unit_of_lengths(problem: Problem, more: Iterable[Expr] = ()) -> str:
    """Metres where a length was typed in them; "" where none was; `more` are values of a point."""
    arm = problem.subject if isinstance(problem.subject, Robot) else None
    rows = (*arm.motions(), *(end for ends in arm.ranges.values() for end in ends)) if arm else ()
    trees = (*rows, *problem.where.values(), *more)
    units = (node.unit for tree in trees for node in walk(tree) if isinstance(node, Number))
    return "m" if "m" in units else ""
