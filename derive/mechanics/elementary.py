"""Elementary rotations and translations as they are written down: matrices with cos 30 deg left standing."""

from __future__ import annotations

from derive.expression import ONE, ZERO, Expr, Indexed, Matrix, cos, sin
from derive.mechanics.motion import Move

Vector = tuple[Expr, Expr, Expr]


def rotation_matrix(axis: str, angle: Expr) -> Matrix:
    """R (3 by 3) about a coordinate axis (Spong et al., eqs. 2.3 to 2.6)."""
    c, s = cos(angle), sin(angle)
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    entries: dict[tuple[int, int], Expr] = {(i, i): ONE, (j, j): c, (k, k): c, (k, j): s, (j, k): -s}
    return Matrix(tuple(tuple(entries.get((row, col), ZERO) for col in range(3)) for row in range(3)))


def skew(k: Vector) -> Matrix:
    """S(k) (3 by 3), which takes v to k x v (Spong et al., section 4.2)."""
    x, y, z = k
    return Matrix(((ZERO, -z, y), (z, ZERO, -x), (-y, x, ZERO)))


def homogeneous(R: Matrix | None, p: tuple[Expr, ...] = (ZERO, ZERO, ZERO)) -> Matrix:
    """T (4 by 4) of a rotation (none: the identity) and a position."""
    identity = tuple(tuple(ONE if i == j else ZERO for j in range(3)) for i in range(3))
    rows = R.rows if R else identity
    return Matrix((*((*row, x) for row, x in zip(rows, p, strict=True)), (ZERO, ZERO, ZERO, ONE)))


def translation(axis: str, by: Expr) -> Matrix:
    """T (4 by 4) along a coordinate axis."""
    return homogeneous(None, tuple(by if axis == letter else ZERO for letter in "xyz"))


def factor_name(move: Move, axis: Expr, letters: tuple[str, str]) -> Indexed:
    """R_{z, 30 deg} or Rot_{x, alpha}, Trans_{z, b}; `letters` are for rotations and translations."""
    letter = letters[0] if move.kind == "rotate" else letters[1]
    return Indexed(letter, (axis, move.by))
