"""How fast three angles turn a body: omega = T(angles) times their rates (Siciliano et al., section 3.6)."""

from __future__ import annotations

from typing import Literal

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import trig_of
from derive.algebra.scalar import Scalar
from derive.mechanics.euler import Euler
from derive.mechanics.poses import UNIT, rotation


def rate_matrix(euler: Euler, seen_from: Literal["base", "body"] = "base") -> ScalarMatrix:
    """T (3 by 3), a column for each angle in the order in which the rotations are made: the axis of each
    rotation where those before it in the product have carried it; in the body's own axes by R^T."""
    carried = ScalarMatrix.identity(3)
    columns: dict[str, ScalarMatrix] = {}
    for move, name in zip(euler.factors, euler.outer, strict=True):
        columns[name] = carried @ ScalarMatrix.column(UNIT[str(move.axis)])
        carried = carried @ rotation(move.axis, trig_of(Scalar.symbol(name)))
    T = ScalarMatrix.beside([columns[name] for name in euler.names])
    return T if seen_from == "base" else euler.matrix.T @ T
