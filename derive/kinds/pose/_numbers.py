"""Trees in numbers where `where` gives names their values."""

from __future__ import annotations

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.expression import Approximate, Expr, Matrix, free_symbols
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed


def value_of(expr: Expr, problem: Problem) -> float | None:
    """The number a tree without symbols stands for; None where symbols are left."""
    known = completed({}, problem.where)
    return number(expr, known) if free_symbols(expr) <= known.keys() else None


def rounded(entry: Expr, problem: Problem) -> Expr:
    """A number without symbols as a decimal, unless it is 0, 1 or -1; anything else as it is."""
    value = value_of(entry, problem)
    if value is None or normal(entry, problem.names).constant in (0, 1, -1):
        return entry
    return Approximate(value)


def rounded_matrix(matrix: Matrix, problem: Problem) -> Matrix:
    """Entry by entry."""
    return Matrix(tuple(tuple(rounded(entry, problem) for entry in row) for row in matrix.rows))
