"""Names for entries too long to stand in their matrix: r_11, r_12, ... listed below it."""

from __future__ import annotations

from derive.algebra.readable.operation_count import operations
from derive.derivation import Step
from derive.expression import Expr, Matrix, Symbol, number

# A row with more operations than this would not fit on a line of a page.
LONGEST_ROW = 24


def entry_symbol(letter: str, *indices: int) -> Symbol:
    """d_12, c_121; with an index of two digits d_1,11: without commas c_1111 would be three symbols."""
    between = "" if all(index < 10 for index in indices) else ","
    return Symbol(f"{letter}_{between.join(map(str, indices))}")


def fits(matrix: Matrix) -> bool:
    """Whether it is no wider than a line."""
    return all(sum(map(operations, row)) <= LONGEST_ROW for row in matrix.rows)


def with_named_entries(matrix: Matrix) -> tuple[Matrix, tuple[Step, ...]]:
    """A pose (4 by 4) with its long blocks named: the rotation r_11, ..., the position p_x, p_y, p_z.

    The rotation is named as a whole, so that a reader need not look which entry is short.
    """
    if fits(matrix):
        return matrix, ()
    named = {(i, j): Symbol(f"r_{i + 1}{j + 1}") for i in range(3) for j in range(3)}
    if any(operations(matrix.rows[i][3]) > LONGEST_ROW // 2 for i in range(3)):
        named |= {(i, 3): Symbol(f"p_{axis}") for i, axis in enumerate("xyz")}
    named = {place: name for place, name in named.items() if not _plain(matrix.rows[place[0]][place[1]])}
    return _with(matrix, named), tuple(
        Step(name.name, (name, matrix.rows[i][j]), "entry") for (i, j), name in sorted(named.items())
    )


def _plain(expr: Expr) -> bool:
    return expr in (number(0), number(1), number(-1))


def _with(matrix: Matrix, named: dict[tuple[int, int], Symbol]) -> Matrix:
    rows = enumerate(matrix.rows)
    return Matrix(tuple(tuple(named.get((i, j), e) for j, e in enumerate(row)) for i, row in rows))
