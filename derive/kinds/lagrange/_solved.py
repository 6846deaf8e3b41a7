"""Accelerations and multipliers solved for: a linear system, exactly."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable
from derive.kinds.lagrange._model import Model
from derive.mechanics.lagrangian import on_accelerations, without

LARGEST = 6  # unknowns
LONGEST = 600  # terms of the determinant


@dataclass(frozen=True, slots=True)
class Solved:
    """Each acceleration, then each multiplier."""

    accelerations: dict[str, Scalar]
    multipliers: dict[str, Scalar]


def solved(model: Model) -> Solved:
    """[M -A^T; A 0] (qddot, lambda) = (Q - h, -c). Raises NotDerivable where that has no unique solution
    or is too large."""
    system, n, m = model.system, len(model.system.coordinates), len(model.conditions)
    if n + m > LARGEST:
        raise NotDerivable(f"{n + m} unknowns are not solved for here; leave solve: out", "solve")
    across = [on_accelerations(condition, system) for condition in model.conditions]
    rows = [[*model.mass.rows[k], *(-condition.a[k] for condition in model.conditions)] for k in range(n)] + [
        [*(each.diff(name) for name in system.accelerations), *[Scalar.of(0)] * m] for each in across
    ]
    right = [model.forces[q] - model.rest[k] for k, q in enumerate(system.coordinates)]
    right += [-without(each, system.accelerations) for each in across]
    matrix = ScalarMatrix.of(rows)
    det = matrix.det()
    if not det:
        raise NotDerivable(_singular(bool(m)))
    if len(det.numerator) > LONGEST:
        raise NotDerivable("the accelerations are too long to be written down; leave solve: out", "solve")
    values = [
        sum((a * b for a, b in zip(row, right, strict=True)), Scalar.of(0)) / det
        for row in matrix.adjugate().rows
    ]
    names = [name.name for name in model.multipliers]
    return Solved(
        dict(zip(system.accelerations, values[:n], strict=True)), dict(zip(names, values[n:], strict=True))
    )


def _singular(constrained: bool) -> str:
    if constrained:
        return "the constraints depend on each other, or leave a coordinate without inertia: no unique motion"
    return "a coordinate has no inertia: its acceleration is not determined"


def satisfies(model: Model, found: Solved) -> bool:
    """Whether every equation and every constraint holds with what was found."""
    values = {**found.accelerations, **found.multipliers}
    for k, q in enumerate(model.system.coordinates):
        left = model.lefts[k] - model.forces[q] - model.reaction(k)
        if left.substitute(values):
            return False
    across = [on_accelerations(condition, model.system) for condition in model.conditions]
    return not any(each.substitute(values) for each in across)
