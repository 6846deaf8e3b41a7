"""Each row of the transform by least squares, as in the notes; and why that need be no rotation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from derive.algebra.kernels import root
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numeric import matrix_numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, Result, Step
from derive.errors import NotDerivable
from derive.expression import Call, Product, Symbol, transpose
from derive.kinds.checks import SECOND_ROUTE, close, law, links
from derive.kinds.points._data import Data, point_table, rounded, shown
from derive.kinds.problem import Problem
from derive.mechanics.fitting import PointPairs, residual

A, T, R = Symbol("A"), Symbol("T"), Symbol("R")


def fitted(pairs: PointPairs, problem: Problem) -> Derivation:
    """Raises NotDerivable where the points do not fix the rows."""
    data = Data.of(pairs, problem)
    size = data.a[0].shape[0]
    table = ScalarMatrix.of([*a.entries, 1] for a in data.a)
    gram = table.T @ table
    if not gram.det():
        where = "in a plane" if size == 3 else "on a line"
        raise NotDerivable(
            f"the points in the first frame lie {where}, so a row has more unknowns than the points fix: "
            "the fit by rows needs points that do not; use method: svd"
        )
    targets = [ScalarMatrix.column(b.entries[k] for b in data.b) for k in range(size)]
    rows = [gram.inverse() @ (table.T @ target) for target in targets]
    lengths = [_length(row, size) for row in rows]
    normalised = ScalarMatrix.of(
        [entry / length for entry in row.entries[:size]] for row, length in zip(rows, lengths, strict=True)
    )
    position = ScalarMatrix.column(row.entries[size] for row in rows)
    product = normalised @ normalised.T
    rotation, p = shown(normalised, problem), shown(position, problem)
    rms = residual(*_floats(normalised, position), *data.floats)
    whole = _transform(rows, size)
    steps = (
        Step("A", (A, shown(table, problem)), "table"),
        *_row_steps(rows, targets, problem),
        Step("T", (T, shown(whole, problem)), "transform"),
        *_length_steps(lengths, problem),
        Step("R", (R, rotation), "normalised"),
        Step("R R^T", (Product((R, transpose(R))), shown(product, problem)), "law"),
        Step(
            "det R",
            (Call("det", (R,)), shown(ScalarMatrix.of([[normalised.det()]]), problem).rows[0][0]),
            "law",
        ),
        Step("rms", (Symbol("rms"), rounded(rms)), "law"),
    )
    results: dict[str, Result] = {"R": rotation, "p": p, "rms": rounded(rms), "T": shown(whole, problem)}
    facts: dict[str, Any] = {
        "method": "rows", "points": point_table(pairs), "count": len(pairs.source), "A": A, "size": size,
        "rotation": product == ScalarMatrix.identity(size) and normalised.det() == 1,
        "unit": all(length == 1 for length in lengths), "unknowns": size + 1,
        "reflected": product == ScalarMatrix.identity(size) and normalised.det() == -1,
    }  # fmt: skip
    claims = (*links(steps, problem.names), *_claims(data, table, rows, targets))
    return Derivation("fit-transform", steps, results, claims, facts=facts)


def _length(row: ScalarMatrix, size: int) -> Scalar:
    """Of the part that is a row of the rotation. Raises NotDerivable for a row of zeros."""
    square = sum((entry * entry for entry in row.entries[:size]), Scalar.of(0))
    if not square:
        raise NotDerivable(
            "a row of the fit vanishes: in the second frame the points do not vary along an axis"
        )
    return root(square)


def _floats(R_: ScalarMatrix, position: ScalarMatrix) -> tuple[list[list[float]], list[float]]:
    return matrix_numbers(R_, {}), [row[0] for row in matrix_numbers(position, {})]


def _transform(rows: Sequence[ScalarMatrix], size: int) -> ScalarMatrix:
    return ScalarMatrix.of([*(row.entries for row in rows), [0] * size + [1]])


def _row_steps(
    rows: Sequence[ScalarMatrix], targets: Sequence[ScalarMatrix], problem: Problem
) -> Iterator[Step]:
    """x = (A^T A)^-1 A^T b, a row at a time."""
    for k, (row, target) in enumerate(zip(rows, targets, strict=True), 1):
        yield Step(f"b_{k}", (Symbol(f"b_{k}"), shown(target, problem)), "coordinates")
        yield Step(f"x_{k}", (Symbol(f"x_{k}"), shown(row, problem)), "row")


def _length_steps(lengths: Sequence[Scalar], problem: Problem) -> Iterator[Step]:
    for k, length in enumerate(lengths, 1):
        value = shown(ScalarMatrix.of([[length]]), problem).rows[0][0]
        yield Step(f"length_{k}", (Call("abs", (Symbol(f"r_{k}"),)), value), "law")


def _claims(
    data: Data, table: ScalarMatrix, rows: Sequence[ScalarMatrix], targets: Sequence[ScalarMatrix]
) -> Iterator[Claim]:
    import numpy as np

    for k, (row, target) in enumerate(zip(rows, targets, strict=True), 1):
        left_over = table @ row - target
        yield law(f"what row {k} leaves over is orthogonal to the columns of A", not table.T @ left_over)
    numbers = np.array(matrix_numbers(table, {}))
    ours = [[entry[0] for entry in matrix_numbers(row, {})] for row in rows]
    theirs = [
        np.linalg.lstsq(numbers, np.array(matrix_numbers(target, {}))[:, 0], rcond=None)[0]
        for target in targets
    ]
    yield Claim(
        "the rows agree with the singular value solution",
        SECOND_ROUTE,
        close(ours, [*map(list, theirs)], 1e-7),
    )
