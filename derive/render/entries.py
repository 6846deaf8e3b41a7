"""A matrix too wide for the page, with its long entries named and listed after it."""

from __future__ import annotations

from derive.expression import Expr, Indexed, Matrix, Symbol
from derive.kinds.naming import entry_symbol
from derive.render.latex import Printer
from derive.render.layout import LINE
from derive.render.width import width

NAMED_BEYOND = LINE / 0.8  # em; what is a little too wide is better scaled
LONG = 8.0  # em from which an entry gets a name
ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")  # of a Jacobian

Chain = tuple[Expr, ...]


def with_named_entries(chain: Chain, printer: Printer) -> tuple[Chain, tuple[Chain, ...]]:
    """The chain, and for each entry that had to be named the chain that says what it is.

    Only a chain from a name to a matrix changes: D = [d_11 ...], d_11 = ...; some rows of a Jacobian keep the
    numbers that they have in the whole one.
    """
    name, matrix = chain[0], chain[-1]
    if not isinstance(matrix, Matrix) or len(chain) < 2 or not (numbers := _numbers(name, matrix)):
        return chain, ()
    if width(printer.write(matrix)) <= NAMED_BEYOND:
        return chain, ()
    stem, _, index = _base(name).partition("^")[0].partition("_")
    letter = f"{stem[0].lower()}_{index}" if index else stem[0].lower()
    named: list[Chain] = []

    def entry(row: int, column: int, value: Expr) -> Expr:
        if width(printer.write(value)) < LONG:
            return value
        known = next((symbol for symbol, listed in named if listed == value), None)
        if known is None:
            known = entry_symbol(letter, row, column)
            named.append((known, value))
        return known

    rows = tuple(
        tuple(entry(i, j, value) for j, value in enumerate(row, 1))
        for i, row in zip(numbers, matrix.rows, strict=True)
    )
    return (*chain[:-1], Matrix(rows)), tuple(named)


def _base(name: Expr) -> str:
    return name.base if isinstance(name, Indexed) else name.name if isinstance(name, Symbol) else ""


def _numbers(name: Expr, matrix: Matrix) -> tuple[int, ...]:
    """Those of the rows; none where the matrix has no name to call its entries by."""
    match name:
        case Symbol():
            return tuple(range(1, len(matrix.rows) + 1))
        case Indexed(_, lower, ()):
            rows = [row.name for row in lower if isinstance(row, Symbol) and row.name in ROWS]
            return tuple(ROWS.index(row) + 1 for row in rows) if len(rows) == len(matrix.rows) else ()
    return ()
