"""Rotations typed as rounded numbers: the nearest rotation, exact, in their place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from derive.algebra.rationals import decimal_places
from derive.expression import Expr, Number, free_symbols, walk

if TYPE_CHECKING:
    from numpy.typing import NDArray

Axes = list[tuple[Expr, Expr, Expr]]
FEWEST = 3  # places with which a matrix counts as rounded
FINER = 5  # places more than were typed, to which the nearest rotation is found
FINEST = 12
DOUBLE = 1e-14  # what is left of one in floating point, as programs print it


def nearest_rotation(axes: Sequence[tuple[Expr, Expr, Expr]], where: Mapping[str, Expr]) -> tuple[Axes, int]:
    """(axes, places) of the rotation nearest to three axes in numbers that were rounded to so many places;
    no axes where they are no numbers, or none of a rotation to the digits given.

    R = U V^T of the singular value decomposition; then the unit quaternion with rational parts beside it, so
    that R^T R = 1 holds exactly.
    """
    import numpy as np

    from derive.algebra.numbers.floats import completed, number

    entries = [entry for axis in axes for entry in axis]
    known, places = completed({}, where), typed_places(axes)
    if places < FEWEST or any(free_symbols(entry) - known.keys() for entry in entries):
        return [], 0
    typed = np.array([[number(entry, known) for entry in axis] for axis in axes]).T
    rounding = max(2 * 10.0**-places, DOUBLE)  # of a product of two axes, each entry half a last place off
    if np.abs(typed.T @ typed - np.eye(3)).max() > rounding or np.linalg.det(typed) < 0:
        return [], 0
    U, _, V = np.linalg.svd(typed)
    R = _rational(_quaternion(U @ V), max(places + FINER, FINEST))
    return [(R[0][j], R[1][j], R[2][j]) for j in range(3)], places


def typed_places(axes: Sequence[tuple[Expr, Expr, Expr]]) -> int:
    """The most places of a decimal number in the axes; 0 where there is none."""
    decimals = [
        node
        for axis in axes
        for entry in axis
        for node in walk(entry)
        if isinstance(node, Number) and node.decimal
    ]
    return max((max(node.places, decimal_places(node.value) or 0) for node in decimals), default=0)


def _quaternion(R: NDArray[Any]) -> list[float]:
    """(w, x, y, z) with w >= 0: the eigenvector of the greatest eigenvalue of Bar-Itzhack's matrix (Journal
    of Guidance, Control, and Dynamics 23, 2000)."""
    import numpy as np

    antisymmetric = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    K = np.zeros((4, 4))
    K[0, 0], K[0, 1:], K[1:, 0] = np.trace(R), antisymmetric, antisymmetric
    K[1:, 1:] = R + R.T - np.trace(R) * np.eye(3)
    q = np.linalg.eigh(K)[1][:, -1]
    return [float(part) for part in (q if q[0] >= 0 else -q)]


def _rational(q: Sequence[float], places: int) -> list[list[Expr]]:
    """R (3 by 3) of the unit quaternion ((1 - s.s), 2 s)/(1 + s.s) beside q, s with so many places."""
    scale = 10**places
    s = [Fraction(round(part / (1 + q[0]) * scale), scale) for part in q[1:]]
    whole = 1 + sum((part * part for part in s), Fraction(0))
    w, v = (2 - whole) / whole, [2 * part / whole for part in s]
    square = sum((part * part for part in v), Fraction(0))
    skew = ((0, -v[2], v[1]), (v[2], 0, -v[0]), (-v[1], v[0], 0))
    R = [
        [2 * v[i] * v[j] + 2 * w * skew[i][j] + (w * w - square) * int(i == j) for j in range(3)]
        for i in range(3)
    ]
    return [[Number(Fraction(entry)) for entry in row] for row in R]
