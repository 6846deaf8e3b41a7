"""A matrix too wide for the page, with its long entries named and listed after it."""

from __future__ import annotations

from derive.expression import Expr, Matrix, Symbol
from derive.kinds.naming import entry_symbol
from derive.render.latex import Printer
from derive.render.layout import LINE
from derive.render.width import width

NAMED_BEYOND = LINE / 0.8  # em; what is a little too wide is better scaled
LONG = 8.0  # em from which an entry gets a name

Chain = tuple[Expr, ...]


def with_named_entries(chain: Chain, printer: Printer) -> tuple[Chain, tuple[Chain, ...]]:
    """The chain, and for each entry that had to be named the chain that says what it is.

    Only a chain from a name to a matrix changes: D = [d_11 ...], d_11 = ...
    """
    name, matrix = chain[0], chain[-1]
    if not isinstance(matrix, Matrix) or not isinstance(name, Symbol) or len(chain) < 2:
        return chain, ()
    if width(printer.write(matrix)) <= NAMED_BEYOND:
        return chain, ()
    stem, _, index = name.name.partition("^")[0].partition("_")
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
        tuple(entry(i, j, value) for j, value in enumerate(row, 1)) for i, row in enumerate(matrix.rows, 1)
    )
    return (*chain[:-1], Matrix(rows)), tuple(named)
