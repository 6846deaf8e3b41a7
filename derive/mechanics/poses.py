"""Rotations and homogeneous transforms as matrices, elementary and composed.

Angles come as (cosine, sine) pairs of scalars, so that fixed and symbolic angles are alike.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import reduce

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, Walk, normal
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Like, Scalar
from derive.expression import ZERO
from derive.mechanics.motion import Axis, Move

Pair = tuple[Scalar, Scalar]

ELEMENTARY: dict[str, Callable[[Scalar, Scalar], list[list[Like]]]] = {
    "x": lambda c, s: [[1, 0, 0], [0, c, -s], [0, s, c]],
    "y": lambda c, s: [[c, 0, s], [0, 1, 0], [-s, 0, c]],
    "z": lambda c, s: [[c, -s, 0], [s, c, 0], [0, 0, 1]],
}
UNIT: dict[str, tuple[int, int, int]] = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def rotation(axis: Axis, angle: Pair, names: Names | None = None) -> ScalarMatrix:
    """R (3 by 3), a rotation about an axis by Rodrigues' formula (Siciliano et al., eq. 2.25)."""
    c, s = angle
    if isinstance(axis, str):
        return ScalarMatrix.of(ELEMENTARY[axis](c, s))
    k = unit_vector(axis, names)
    parts = [[k[i] * k[j] * (1 - c) for j in range(3)] for i in range(3)]
    turn = ((c, -k[2] * s, k[1] * s), (k[2] * s, c, -k[0] * s), (-k[1] * s, k[0] * s, c))
    return ScalarMatrix.of([parts[i][j] + turn[i][j] for j in range(3)] for i in range(3))


def unit_vector(axis: Axis, names: Names | None = None) -> tuple[Scalar, Scalar, Scalar]:
    """The direction of an axis; a written axis is divided by its length."""
    x, y, z = map(Scalar.of, _direction(axis, names))
    return x, y, z


def _direction(axis: Axis, names: Names | None) -> tuple[Like, Like, Like]:
    if isinstance(axis, str):
        return UNIT[axis]
    parts = [normal(part, names) for part in axis]
    length = root(parts[0] * parts[0] + parts[1] * parts[1] + parts[2] * parts[2])
    return parts[0] / length, parts[1] / length, parts[2] / length


def homogeneous(R: ScalarMatrix, p: Iterable[Like]) -> ScalarMatrix:
    """T (4 by 4) of a rotation and a position."""
    return ScalarMatrix.of([*([*row, x] for row, x in zip(R.rows, p, strict=True)), [0, 0, 0, 1]])


def rotation_part(T: ScalarMatrix) -> ScalarMatrix:
    """R (3 by 3) of T (4 by 4)."""
    return T.block(slice(0, 3), slice(0, 3))


def position_part(T: ScalarMatrix) -> ScalarMatrix:
    """The origin of the frame, a column of three."""
    return T.block(slice(0, 3), slice(3, 4))


def inverse_pose(T: ScalarMatrix) -> ScalarMatrix:
    """T^-1 (4 by 4) of R^T and -R^T p, without a division (Spong et al., section 2.7)."""
    R_T = rotation_part(T).T
    return homogeneous(R_T, (-(R_T @ position_part(T))).entries)


def pose(move: Move, names: Names | None = None) -> ScalarMatrix:
    """T (4 by 4) of one elementary motion."""
    if move.kind == "rotate":
        return homogeneous(rotation(move.axis, Walk(names or {}).trig(move.by), names), (0, 0, 0))
    length = normal(move.by, names)
    return homogeneous(ScalarMatrix.identity(3), [length * part for part in _direction(move.axis, names)])


def composed(moves: Iterable[Move], names: Names | None = None) -> ScalarMatrix:
    """T (4 by 4) of moves about current axes: each multiplies from the right."""
    poses = [pose(move, names) for move in moves if move.by != ZERO]
    return reduce(ScalarMatrix.__matmul__, poses) if poses else ScalarMatrix.identity(4)


def skew(w: ScalarMatrix) -> ScalarMatrix:
    """S(w) (3 by 3): S(w) p = w x p, for a column of three."""
    x, y, z = w.entries
    return ScalarMatrix.of([[0, -z, y], [z, 0, -x], [-y, x, 0]])
