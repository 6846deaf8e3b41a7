"""Which components of its end-effector's velocity an arm is built to command."""

from __future__ import annotations

from itertools import combinations

from derive.algebra.matrix import ScalarMatrix

ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")


def rows_of(J: ScalarMatrix, names: tuple[str, ...]) -> ScalarMatrix:
    """The named rows of a Jacobian (6 by n), in their order."""
    return ScalarMatrix(tuple(J.rows[ROWS.index(name)] for name in names))


def moving_rows(J: ScalarMatrix) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """(linear, angular) components that are not zero in every configuration."""
    found = tuple(name for name, row in zip(ROWS, J.rows, strict=True) if any(row))
    return tuple(name for name in found if name[0] == "v"), tuple(name for name in found if name[0] == "w")


def task_rows(J: ScalarMatrix) -> tuple[str, ...]:
    """The position where n joints command just that, as do two in a plane or three in space; the
    orientation where they command just that, as a wrist does; else all that moves."""
    linear, angular = moving_rows(J)
    n = J.shape[1]
    if _commanded(J, linear, n):
        return linear
    if len(linear) + len(angular) <= n:
        return linear + angular
    if _commanded(J, angular, n):
        return angular
    return linear + angular


def _commanded(J: ScalarMatrix, rows: tuple[str, ...], n: int) -> bool:
    if not n <= min(len(rows), 3):
        return False
    return any(rows_of(J, each).det() for each in combinations(rows, n))
