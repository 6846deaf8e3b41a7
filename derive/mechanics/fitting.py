"""The rigid motion that brings one set of points nearest to another.

R and p that make the sum of |R a_i + p - b_i|^2 smallest, by the singular values of
H = sum (a_i - a)(b_i - b)^T (Arun, Huang and Blostein 1987; the reflection case after Umeyama 1991).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.expression import Expr

Points: TypeAlias = tuple[tuple[Expr, ...], ...]
Floats: TypeAlias = list[list[float]]
NEARLY = 1e-9  # relative to the largest singular value


@dataclass(frozen=True, slots=True)
class PointPairs:
    """The same points in two frames, `source[i]` and `target[i]`; two or three coordinates each."""

    source: Points
    target: Points


@dataclass(frozen=True, slots=True)
class Fit:
    """H = U S V^T, R = V diag(1, 1, det(V U^T)) U^T; singular values from the largest."""

    U: Floats
    S: list[float]
    V: Floats
    det: int  # of V U^T
    R: Floats

    @property
    def is_flat(self) -> bool:
        """Whether the last singular value vanishes: the points of one set lie in a plane (on a line)."""
        return self.S[-1] <= NEARLY * self.S[0]

    @property
    def is_unique(self) -> bool:
        """Whether no other rotation fits as well."""
        if self.S[0] == 0 or (len(self.S) > 2 and self.S[1] <= NEARLY * self.S[0]):
            return False
        return self.det > 0 or self.is_flat or self.S[-2] - self.S[-1] > NEARLY * self.S[0]


def by_singular_values(H: Floats) -> Fit:
    """The rotation of a 2 by 2 or 3 by 3 matrix H."""
    import numpy as np

    U, S, Vt = np.linalg.svd(np.array(H))
    V = Vt.T
    for k in range(len(S)):  # of each pair of singular vectors the same one on every machine
        if U[np.argmax(np.abs(U[:, k])), k] < 0:
            U[:, k], V[:, k] = -U[:, k], -V[:, k]
    det = 1 if np.linalg.det(V @ U.T) > 0 else -1
    turned = V.copy()
    turned[:, -1] *= det
    return Fit(U.tolist(), S.tolist(), V.tolist(), det, (turned @ U.T).tolist())


def by_quaternion(H: Floats) -> Floats:
    """The same rotation by another route: the eigenvector of Horn's symmetric 4 by 4 matrix that belongs
    to its largest eigenvalue is the quaternion of R (Horn 1987). In the plane one angle."""
    import numpy as np

    if len(H) == 2:
        angle = np.arctan2(H[0][1] - H[1][0], H[0][0] + H[1][1])
        return [[float(np.cos(angle)), float(-np.sin(angle))], [float(np.sin(angle)), float(np.cos(angle))]]
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = H
    N = np.array(
        [
            [xx + yy + zz, yz - zy, zx - xz, xy - yx],
            [yz - zy, xx - yy - zz, xy + yx, zx + xz],
            [zx - xz, xy + yx, -xx + yy - zz, yz + zy],
            [xy - yx, zx + xz, yz + zy, -xx - yy + zz],
        ]
    )
    w, x, y, z = np.linalg.eigh(N)[1][:, -1]
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def centroid(points: Sequence[ScalarMatrix]) -> ScalarMatrix:
    """The mean of columns."""
    total = points[0]
    for point in points[1:]:
        total = total + point
    return total.scaled(Scalar.of(1) / len(points))


def covariance(source: Sequence[ScalarMatrix], target: Sequence[ScalarMatrix]) -> ScalarMatrix:
    """H = sum a_i b_i^T (3 by 3, in the plane 2 by 2) of points about their centroids."""
    total = source[0] @ target[0].T
    for a, b in zip(source[1:], target[1:], strict=True):
        total = total + a @ b.T
    return total


def exact_rotation(source: Sequence[ScalarMatrix], target: Sequence[ScalarMatrix]) -> ScalarMatrix | None:
    """R (3 by 3, in the plane 2 by 2) that brings every centred point exactly to its partner; None where
    there is none."""
    basis = _basis(source)
    if basis is None:
        return None
    columns_a = [source[k] for k in basis]
    columns_b = [target[k] for k in basis]
    if source[0].shape[0] == 3:
        columns_a.append(columns_a[0].cross(columns_a[1]))
        columns_b.append(columns_b[0].cross(columns_b[1]))
    R = _completed(columns_b) @ _completed(columns_a).inverse()
    size = R.shape[0]
    fits = all(R @ a == b for a, b in zip(source, target, strict=True))
    return R if fits and ScalarMatrix.identity(size) == R.T @ R and R.det() == 1 else None


def _completed(columns: list[ScalarMatrix]) -> ScalarMatrix:
    """Columns beside each other; in the plane a vector with its left normal."""
    if len(columns) == 1:
        x, y = columns[0].entries
        columns = [columns[0], ScalarMatrix.column((-y, x))]
    return ScalarMatrix.beside(columns)


def _basis(source: Sequence[ScalarMatrix]) -> list[int] | None:
    """One (in the plane) or two independent points about the centroid."""
    first = next((k for k, a in enumerate(source) if a), None)
    if first is None or source[first].shape[0] == 2:
        return None if first is None else [first]
    second = next((k for k, a in enumerate(source) if source[first].cross(a)), None)
    return None if second is None else [first, second]


def collinear(source: Sequence[ScalarMatrix]) -> bool:
    """Whether all centred points lie on one line (in the plane: coincide)."""
    return _basis(source) is None


def residual(R: Any, p: Any, source: Floats, target: Floats) -> float:
    """The root mean square of |R a_i + p - b_i|."""
    import numpy as np

    gaps = np.array(source) @ np.array(R).T + np.array(p) - np.array(target)
    return float(np.sqrt((gaps**2).sum(axis=1).mean()))
