"""sympy.physics.mechanics by Kane's method."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy.physics.mechanics import KanesMethod, dynamicsymbols

from benchmarks.cases import Asked
from benchmarks.peers import CannotDo
from benchmarks.peers.frames import tree
from benchmarks.peers.lagrange import check, given
from benchmarks.rows import Rows

__all__ = ("check", "derive", "given")


def derive(rows: Rows, asked: Sequence[Asked]) -> tuple[Any, tuple[str, ...]]:
    """(mass matrix, names of the variables); the forces are derived with it."""
    if "D" not in asked:
        raise CannotDo("it makes equations of motion only")
    robot = tree(rows)
    speeds = [dynamicsymbols(f"{name}_speed") for name in robot.names]
    rates = {dynamicsymbols(name, 1): u for name, u in zip(robot.names, speeds, strict=True)}
    for body in robot.bodies:
        turning = body.frame.ang_vel_in(robot.base).subs(rates)
        body.frame.set_ang_vel(robot.base, turning)
        body.masscenter.set_vel(robot.base, body.masscenter.vel(robot.base).subs(rates))
    loads = [(body.masscenter, body.mass * robot.gravity) for body in robot.bodies]
    kinematic = [u - rate for rate, u in rates.items()]
    method = KanesMethod(robot.base, robot.q, speeds, kinematic)
    method.kanes_equations(robot.bodies, loads)
    assert method.forcing.shape == (len(speeds), 1)
    return method.mass_matrix, robot.names
