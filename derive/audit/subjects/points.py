"""The same points in two frames: the rotation by a singular value decomposition in mpmath, or row by row."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import mpmath

from derive.audit.asked import Asked, Same, Test
from derive.audit.points import Point, floating
from derive.expression import Expr


def fit_transform(asked: Asked, point: Point) -> Iterator[Test]:
    """b = R a + p with the least sum of squares."""
    a, b = (_columns(points, asked, point) for points in (asked.subject.source, asked.subject.target))
    R, p, T = _by_rows(a, b) if asked.options.method == "rows" else _by_rotation(a, b)
    yield Same("R", R.tolist())
    yield Same("p", list(p))
    left = R * a + p * mpmath.ones(1, a.cols) - b
    yield Same("rms", mpmath.sqrt(sum(part**2 for part in left) / a.cols))
    if T is not None:
        yield Same("T", T.tolist())


def _columns(points: Sequence[Sequence[Expr]], asked: Asked, point: Point) -> mpmath.matrix:
    """One point a column."""
    rows = [[floating(point.at(asked.formula(part))) for part in each] for each in points]
    return mpmath.matrix(rows).T


def _middle(a: mpmath.matrix) -> mpmath.matrix:
    return a * mpmath.ones(a.cols, 1) / a.cols


def _by_rotation(a: mpmath.matrix, b: mpmath.matrix) -> tuple[mpmath.matrix, mpmath.matrix, None]:
    """Of H = sum (b - mean)(a - mean)^T = U S V the rotation U D V, D with a sign where that is needed."""
    one = mpmath.ones(1, a.cols)
    H = (b - _middle(b) * one) * (a - _middle(a) * one).T
    U, _, V = mpmath.svd_r(H)
    D = mpmath.eye(H.rows)
    D[H.rows - 1, H.rows - 1] = mpmath.sign(mpmath.det(U * V))
    R = U * D * V
    return R, _middle(b) - R * _middle(a), None


def _by_rows(a: mpmath.matrix, b: mpmath.matrix) -> tuple[mpmath.matrix, mpmath.matrix, mpmath.matrix]:
    """Each row [r p] for itself, by least squares (lu_solve); r is then made a unit vector."""
    size = a.rows
    A = mpmath.matrix(a.cols, size + 1)
    A[:, :size], A[:, size] = a.T, mpmath.ones(a.cols, 1)
    rows = [list(mpmath.lu_solve(A, b[i, :].T)) for i in range(size)]
    T = mpmath.matrix([*rows, [*[mpmath.mpf(0)] * size, mpmath.mpf(1)]])
    R = mpmath.matrix([[part / mpmath.norm(row[:size]) for part in row[:size]] for row in rows])
    return R, T[:size, size], T


KINDS = {"fit-transform": fit_transform}
