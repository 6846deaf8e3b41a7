"""sympy.physics.mechanics by Lagrange's method."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sympy.physics.mechanics import LagrangesMethod, Lagrangian

from benchmarks.cases import Asked
from benchmarks.peers import CannotDo, Point, frames
from benchmarks.rows import Rows, rows_of
from derive.mechanics.robot import Robot


def given(robot: Robot) -> Rows:
    return rows_of(robot)


def derive(rows: Rows, asked: Sequence[Asked]) -> tuple[Any, tuple[str, ...]]:
    """(mass matrix, names of the variables); the forces are derived with it."""
    if "D" not in asked:
        raise CannotDo("it makes equations of motion only")
    tree = frames.tree(rows)
    for body in tree.bodies:
        height = body.masscenter.pos_from(tree.origin)
        body.potential_energy = -body.mass * height.dot(tree.gravity)
    method = LagrangesMethod(Lagrangian(tree.base, *tree.bodies), tree.q)
    method.form_lagranges_equations()
    assert method.forcing.shape == (len(tree.q), 1)
    return method.mass_matrix, tree.names


def check(answer: tuple[Any, tuple[str, ...]], point: Point) -> float:
    M, names = answer
    return frames.value(M[0, 0] + M[0, M.shape[1] - 1], names, point)
