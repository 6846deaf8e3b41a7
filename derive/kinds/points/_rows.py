"""Each row of the transform by least squares, as in the notes; and why that need be no rotation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import matrix_numbers
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, Phrase, Step
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Matrix, Symbol, number, transpose
from derive.kinds.checks import close, law, route
from derive.kinds.points._data import (
    Data,
    Facts,
    RowsTold,
    rounded,
    rounded_matrix,
    shown,
)
from derive.kinds.points._fit_checks import Pairs, rows_fitted
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.fitting import PointPairs, residual

M, T, R = Symbol("M"), Symbol("T"), Symbol("R")
SHORT = 10**6  # a squared length as p/q with p q below this has a root worth printing


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
            "the fit by rows needs points that do not; use method: svd",
            "method",
        )
    targets = [ScalarMatrix.column(b.entries[k] for b in data.b) for k in range(size)]
    rows = [gram.inverse() @ (table.T @ target) for target in targets]
    scaled = Scaled.of(rows, size, problem)
    position = ScalarMatrix.column(row.entries[size] for row in rows)
    p = shown(position, problem)
    rms = residual(scaled.numbers, [row[0] for row in matrix_numbers(position, {})], *data.floats)
    whole = shown(_transform(rows, size), problem)
    steps = (
        Step("M", (M, shown(table, problem)), "table"),
        *_row_steps(rows, targets, problem),
        Step("T", (T, whole), "transform"),
        *(
            Step(f"length_{k}", (Call("abs", (Symbol(f"r_{k}"),)), each), "in-numbers")
            for k, each in enumerate(scaled.lengths, 1)
        ),
        Step("R", (R, scaled.R), "normalised"),
        Step("R R^T", (R * transpose(R), scaled.product), "in-numbers"),
        Step("det R", (Call("det", (R,)), scaled.det), "in-numbers"),
        Step("rms", (Symbol("rms"), rounded(rms)), "in-numbers"),
    )
    results: dict[str, Expr] = {"R": scaled.R, "p": p, "rms": rounded(rms), "T": whole}
    lengths = tuple(step.name for step in steps if step.name.startswith("length"))
    told = RowsTold(verdict=scaled.verdict, lengths=lengths)
    work = Work(problem, steps=steps).claim(*_claims(data, table, rows, targets))
    facts = Facts(rows=told, numbers=())
    work = work.claim(*rows_fitted(work, facts, results, Pairs.of(pairs, problem)))
    return work.answer("fit-transform", results, facts)


@dataclass(frozen=True, slots=True)
class Scaled:
    """The rows of the rotation part divided by their lengths: exactly where the lengths are short roots,
    else in floating point."""

    R: Matrix
    numbers: list[list[float]]
    lengths: tuple[Expr, ...]
    product: Matrix
    det: Expr
    orthogonal: bool

    @staticmethod
    def of(rows: Sequence[ScalarMatrix], size: int, problem: Problem) -> Scaled:
        """Raises NotDerivable for a row of zeros."""
        parts = ScalarMatrix.of(row.entries[:size] for row in rows)
        squares = [sum((entry * entry for entry in row), Scalar.of(0)) for row in parts.rows]
        if not all(squares):
            raise NotDerivable(
                "a row of the fit vanishes: in the second frame the points do not vary along an axis"
            )
        values = [square.constant for square in squares]
        if all(value is not None and value.numerator * value.denominator < SHORT for value in values):
            return Scaled._exactly(parts, [root(square) for square in squares], problem)
        return Scaled._in_floats(matrix_numbers(parts, {}))

    @property
    def verdict(self) -> Phrase:
        """What R is."""
        if self.orthogonal:
            return Phrase("rows-rotation" if self.det == number(1) else "rows-reflection")
        size = len(self.lengths)
        return Phrase("rows-neither", {"numbers": size * (size + 1), "freedoms": 6 if size == 3 else 3})

    @staticmethod
    def _exactly(parts: ScalarMatrix, lengths: Sequence[Scalar], problem: Problem) -> Scaled:
        R = ScalarMatrix.of([e / n for e in row] for row, n in zip(parts.rows, lengths, strict=True))
        product = R @ R.T
        return Scaled(
            shown(R, problem),
            matrix_numbers(R, {}),
            tuple(_entry(length, problem) for length in lengths),
            shown(product, problem),
            _entry(R.det(), problem),
            product == ScalarMatrix.identity(len(lengths)),
        )

    @staticmethod
    def _in_floats(parts: list[list[float]]) -> Scaled:
        import numpy as np

        lengths = np.linalg.norm(parts, axis=1)
        R = np.array(parts) / lengths[:, None]
        product = rounded_matrix((R @ R.T).tolist())
        det = rounded(float(np.linalg.det(R)))
        sizes = tuple(map(rounded, lengths.tolist()))
        return Scaled(rounded_matrix(R.tolist()), R.tolist(), sizes, product, det, False)


def _entry(value: Scalar, problem: Problem) -> Expr:
    return shown(ScalarMatrix.of([[value]]), problem).rows[0][0]


def _transform(rows: Sequence[ScalarMatrix], size: int) -> ScalarMatrix:
    return ScalarMatrix.of([*(row.entries for row in rows), [0] * size + [1]])


def _row_steps(
    rows: Sequence[ScalarMatrix], targets: Sequence[ScalarMatrix], problem: Problem
) -> Iterator[Step]:
    """x = (M^T M)^-1 M^T beta, a row at a time."""
    for k, target in enumerate(targets, 1):
        yield Step(f"beta_{k}", (Symbol(f"beta_{k}"), shown(target, problem)), "coordinates")
    for k, row in enumerate(rows, 1):
        yield Step(f"x_{k}", (Symbol(f"x_{k}"), shown(row, problem)), "row")


def _claims(
    data: Data, table: ScalarMatrix, rows: Sequence[ScalarMatrix], targets: Sequence[ScalarMatrix]
) -> Iterator[Claim]:
    import numpy as np

    for k, (row, target) in enumerate(zip(rows, targets, strict=True), 1):
        left_over = table @ row - target
        yield law("left-over", not table.T @ left_over, k=k)
    numbers = np.array(matrix_numbers(table, {}))
    ours = [[entry[0] for entry in matrix_numbers(row, {})] for row in rows]
    theirs = [
        np.linalg.lstsq(numbers, np.array(matrix_numbers(target, {}))[:, 0], rcond=None)[0]
        for target in targets
    ]
    yield route("singular-values", (close(a, list(b), 1e-7) for a, b in zip(ours, theirs, strict=True)))
