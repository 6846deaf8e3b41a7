"""The best rotation and translation by the singular values of H."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import matrix_numbers, number
from derive.derivation import Claim, Derivation, Phrase, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Product, Symbol, column, transpose
from derive.expression import number as whole
from derive.kinds.checks import FLOATS, close, every, law, route
from derive.kinds.points._data import Data, Facts, SvdTold, rounded, rounded_matrix, shown
from derive.kinds.points._fit_checks import Pairs, best_rotation
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.fitting import (
    Fit,
    PointPairs,
    by_quaternion,
    by_singular_values,
    collinear,
    covariance,
    exact_rotation,
    residual,
)

A_MEAN, B_MEAN = Symbol("a_m"), Symbol("b_m")
X, Y, H = Symbol("X"), Symbol("Y"), Symbol("H")
U, S, V, D, R, P = map(Symbol, ("U", "S", "V", "D", "R", "p"))


def fitted(pairs: PointPairs, problem: Problem) -> Derivation:
    """R = V D U^T and p = b - R a. Raises NotDerivable where the points leave the rotation open."""
    data = Data.of(pairs, problem)
    a, b = data.centred
    _require_spread(a, b)
    exact_H = covariance(a, b)
    fit = by_singular_values(matrix_numbers(exact_H, {}))
    if not fit.is_unique:
        raise NotDerivable("several rotations fit these points equally well: add points or check their order")
    exact = exact_rotation(a, b)
    rotation: Matrix = rounded_matrix(fit.R) if exact is None else problem.readable_matrix(exact)
    position = _position(data, fit, exact, problem)
    means = [shown(each, problem) for each in data.centroids]
    rms = residual(fit.R, _floats(position), *data.floats) if exact is None else 0.0
    steps = (
        *_means(data, problem, means),
        *_spectral(exact_H, fit, problem),
        *_ends(fit, rotation, position),
        Step("rms", (Symbol("rms"), rounded(rms)), "in-numbers"),
    )
    results: dict[str, Expr] = {"R": rotation, "p": position, "rms": rounded(rms)}
    work = Work(problem).step(*steps).claim(*_claims(data, fit, exact, rms, exact_H))
    told = SvdTold(
        best=_best(fit),
        turned=(D, _diagonal(fit)) if fit.det < 0 else None,
        left=Phrase("nothing-left" if exact is not None else "something-left"),
        mirrored=Phrase("mirrored") if fit.det < 0 and not fit.is_flat else None,
    )
    facts = Facts(svd=told, numbers=())
    work = work.claim(*best_rotation(work, facts, results, Pairs.of(pairs, problem)))
    return work.answer("fit-transform", results, facts)


def _best(fit: Fit) -> Phrase:
    """How V U^T is made a rotation, where it is none."""
    if fit.det > 0:
        return Phrase("best-rotation")
    if not fit.is_flat:
        return Phrase("best-reflected")
    return Phrase("best-in-a-plane" if len(fit.S) == 3 else "best-on-a-line")


def _require_spread(a: list[ScalarMatrix], b: list[ScalarMatrix]) -> None:
    for points, which, key in ((a, "first", "from"), (b, "second", "to")):
        if collinear(points):
            where = "lie on a line" if points[0].shape[0] == 3 else "coincide"
            why = "turning about that line changes nothing" if points[0].shape[0] == 3 else "any turn fits"
            raise NotDerivable(
                f"the points in the {which} frame all {where}: {why}, so no rotation is the best", key
            )


def _position(data: Data, fit: Fit, exact: ScalarMatrix | None, problem: Problem) -> Matrix:
    """p = b - R a."""
    mean_a, mean_b = data.centroids
    if exact is not None:
        return problem.readable_matrix(mean_b - exact @ mean_a)
    at, to = (matrix_numbers(mean, {}) for mean in (mean_a, mean_b))
    turned = [sum(r * x[0] for r, x in zip(row, at, strict=True)) for row in fit.R]
    return column(rounded(y[0] - x) for y, x in zip(to, turned, strict=True))


def _floats(position: Matrix) -> list[float]:
    return [number(entry, {}) for (entry,) in position.rows]


def _means(data: Data, problem: Problem, means: list[Matrix]) -> Iterator[Step]:
    """The centroids, as sums over the number of points."""
    for name, points, mean in zip((A_MEAN, B_MEAN), (data.a, data.b), means, strict=True):
        total = points[0]
        for point in points[1:]:
            total = total + point
        over = 1 / whole(len(points)) * problem.readable_matrix(total)
        yield Step(name.name, (name, over, mean), "centroid")


def _spectral(exact_H: ScalarMatrix, fit: Fit, problem: Problem) -> Iterator[Step]:
    yield Step("H", (H, transpose(X) * Y, shown(exact_H, problem)), "in-numbers")
    yield Step("U", (U, rounded_matrix(fit.U)), "singular")
    yield Step("S", (S, rounded_matrix(_diagonal_rows(fit.S))), "singular")
    yield Step("V", (V, rounded_matrix(fit.V)), "singular")


def _diagonal_rows(values: list[float]) -> list[list[float]]:
    return [[value if i == j else 0.0 for j in range(len(values))] for i, value in enumerate(values)]


def _diagonal(fit: Fit) -> Matrix:
    return rounded_matrix(_diagonal_rows([1.0] * (len(fit.S) - 1) + [float(fit.det)]))


def _ends(fit: Fit, rotation: Matrix, position: Matrix) -> Iterator[Step]:
    """R and p; numbers in floating point are no links to compare exactly."""
    factors = (V, transpose(U)) if fit.det > 0 else (V, D, transpose(U))
    yield Step("R", (R, Product(factors), rotation), "in-numbers")
    yield Step("p", (P, B_MEAN - R * A_MEAN, position), "in-numbers")


def _claims(
    data: Data, fit: Fit, exact: ScalarMatrix | None, rms: float, exact_H: ScalarMatrix
) -> Iterator[Claim]:
    import numpy as np

    turned = np.array(fit.R)
    yield every("orthogonal-in-floats", close(turned.T @ turned, np.eye(len(turned))), FLOATS)
    yield every("right-handed-in-floats", close([float(np.linalg.det(turned))], [1.0]), FLOATS)
    other = by_quaternion(matrix_numbers(exact_H, {}))
    claim = "eigenvector" if len(other) == 3 else "angle"
    yield route(claim, close(fit.R, other, 1e-7))
    if exact is not None:
        yield law("exactly", exact_rotation(*data.centred) is not None)
        yield route("exact-agrees", close(fit.R, matrix_numbers(exact, {})))
