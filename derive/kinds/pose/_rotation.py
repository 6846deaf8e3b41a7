"""A given rotation entry by entry, under the names r_11, r_12, ..."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.expression import Expr, Symbol, free_symbols
from derive.kinds.pose._given import Given
from derive.kinds.problem import Problem

LONGEST_ENTRY = 8  # operations above which an entry is left by its name
LONGEST_VALUE = 25  # likewise for what is made of the entries


@dataclass(frozen=True, slots=True)
class Rotation:
    """The matrix with the names of `where` replaced, and its entries by their names."""

    matrix: ScalarMatrix
    entries: dict[Expr, Expr]

    @property
    def numeric(self) -> bool:
        """Whether every entry is a number."""
        return not any(map(free_symbols, self.entries.values()))

    @property
    def short(self) -> bool:
        """Whether entries may be written out where their names stand."""
        return all(operations(entry) <= LONGEST_ENTRY for entry in self.entries.values())

    def shows(self, value: Expr) -> bool:
        """Whether what is made of the entries may be written out."""
        return self.short and operations(value) <= LONGEST_VALUE

    def value(self, name: str) -> Scalar:
        """The entry of a name, `r_32`."""
        return self.matrix[int(name[2]) - 1, int(name[3]) - 1]


def rotation_of(given: Given, problem: Problem) -> Rotation:
    """The rotation of a given pose."""
    matrix = given.exact(problem.readable_matrix(given.R))
    written = problem.readable_matrix(matrix)
    places = product(range(3), range(3))
    names: dict[Expr, Expr] = {Symbol(f"r_{i + 1}{j + 1}"): written.rows[i][j] for i, j in places}
    return Rotation(matrix, names)
