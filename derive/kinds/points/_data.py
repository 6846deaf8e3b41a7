"""The points of a problem, exactly and in floats, and how numbers found from them are shown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import matrix_numbers
from derive.algebra.readable.operation_count import operations
from derive.derivation import PageFacts, Phrase, Record
from derive.errors import NotDerivable
from derive.expression import Approximate, Expr, Matrix, Number, number, walk
from derive.kinds.problem import Problem
from derive.mechanics.fitting import PointPairs, Points, centroid

NEGLIGIBLE = 1e-12
LONGEST = 4  # operations of an exact entry that is shown as it is
LARGEST = 999  # of a numerator or denominator that is


@dataclass(frozen=True, slots=True)
class Data:
    """Points a in frame A and b in frame B as columns, their centroids, and what is left about them."""

    a: tuple[ScalarMatrix, ...]
    b: tuple[ScalarMatrix, ...]

    @staticmethod
    def of(pairs: PointPairs, problem: Problem) -> Data:
        """Raises NotDerivable where a coordinate is no number."""
        return Data(_columns(pairs.source, problem, "from"), _columns(pairs.target, problem, "to"))

    @property
    def centroids(self) -> tuple[ScalarMatrix, ScalarMatrix]:
        return centroid(self.a), centroid(self.b)

    @property
    def centred(self) -> tuple[list[ScalarMatrix], list[ScalarMatrix]]:
        """The points about their centroids."""
        mean_a, mean_b = self.centroids
        return [a - mean_a for a in self.a], [b - mean_b for b in self.b]

    @property
    def floats(self) -> tuple[list[list[float]], list[list[float]]]:
        """Rows of coordinates."""
        return _rows(self.a), _rows(self.b)


def _columns(points: Points, problem: Problem, key: str) -> tuple[ScalarMatrix, ...]:
    columns = tuple(ScalarMatrix.column(normal(entry, problem.names) for entry in p) for p in points)
    for column in columns:
        try:
            matrix_numbers(column, {})
        except KeyError as error:
            message = f"a transform is fitted to numbers: {error.args[0]} has no value (give one under where)"
            raise NotDerivable(message, key) from error
    return columns


def _rows(columns: Sequence[ScalarMatrix]) -> list[list[float]]:
    return [[row[0] for row in matrix_numbers(column, {})] for column in columns]


def rounded(value: float) -> Expr:
    """A number found in floating point; whole numbers as such."""
    near = round(value)
    return number(near) if abs(value - near) < NEGLIGIBLE * max(1.0, abs(value)) else Approximate(value)


def rounded_matrix(rows: Sequence[Sequence[float]]) -> Matrix:
    """Entry by entry."""
    return Matrix(tuple(tuple(map(rounded, row)) for row in rows))


def shown(matrix: ScalarMatrix, problem: Problem) -> Matrix:
    """Exactly where every entry is short; else in decimals."""
    exact = problem.readable_matrix(matrix)
    if all(_is_short(entry) for row in exact.rows for entry in row):
        return exact
    return rounded_matrix(matrix_numbers(matrix, {}))


def _is_short(entry: Expr) -> bool:
    numbers = [node.value for node in walk(entry) if isinstance(node, Number)]
    return operations(entry) <= LONGEST and all(_is_small(value) for value in numbers)


def _is_small(value: Fraction) -> bool:
    return abs(value.numerator) <= LARGEST and value.denominator <= LARGEST


class SvdTold(Record):
    best: Phrase  # how the best rotation comes about
    turned: tuple[Expr, Expr] | None  # D = ..., where it turns the last direction over
    left: Phrase  # whether something is left over
    mirrored: Phrase | None  # what that says of the points, where they are better reflected


class RowsTold(Record):
    verdict: Phrase  # what the rows are that were found
    lengths: tuple[str, ...]  # steps


class Facts(PageFacts):
    svd: SvdTold | None = None
    rows: RowsTold | None = None
