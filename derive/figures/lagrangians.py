"""Mechanical systems that their bodies and constraints alone say how to draw."""

from __future__ import annotations

from collections.abc import Mapping

from derive.derivation import Drawing
from derive.expression import Expr
from derive.figures import pendulums, pendulums_in_space, rolling
from derive.mechanics.lagrangian import LagrangianSystem


def drawn(system: LagrangianSystem, where: Mapping[str, Expr]) -> Drawing:
    """Masses on rods, a mass at the end of a rod in space, a wheel. Raises NotDerivable for all others."""
    alone = len(system.bodies) == 1
    if alone and len(system.bodies[0].position) == 3:
        return pendulums_in_space.drawn(system, where)
    if alone and system.bodies[0].inertia is not None:
        return rolling.drawn(system, where)
    return pendulums.drawn(system, where)
