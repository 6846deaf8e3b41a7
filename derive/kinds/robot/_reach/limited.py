"""Workspaces of arms with slides and with ranges of joints, by how they are built."""

from __future__ import annotations

from derive.kinds.problem import Problem
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.boxes import box
from derive.kinds.robot._reach.planes import plane
from derive.kinds.robot._reach.ranged import Ranged
from derive.kinds.robot._reach.shapes import Shape
from derive.kinds.robot._reach.shells import shell
from derive.mechanics.chain import Chain
from derive.mechanics.slides import crossed, flat, sliding_only


def shape_within(problem: Problem, chain: Chain, point: Tracked) -> Shape | None:
    """The shape that a point of an arm reaches within the limits of its joints; None for an arm of another
    build."""
    ranged = Ranged(problem, chain, point)
    at = point.position, point.last
    if rows := sliding_only(chain, *at):
        return box(ranged, rows)
    if (level := flat(chain, *at)) is not None:
        return plane(ranged, level)
    if (two := crossed(chain, *at)) is not None:
        return shell(ranged, two)
    return None
