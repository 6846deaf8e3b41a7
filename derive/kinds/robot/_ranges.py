"""The ranges of the joints as relations."""

from __future__ import annotations

from derive.algebra.formulas.with_units import measured
from derive.expression import Relation, Symbol, between
from derive.mechanics.robot import Robot


def ranges_told(robot: Robot) -> tuple[Relation, ...]:
    """low <= variable <= high for each joint that has limits, with the units that were typed."""
    limits = robot.ranges.items()
    return tuple(between(measured(low), Symbol(name), measured(high)) for name, (low, high) in limits)
