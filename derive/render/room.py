"""What a page has room for: kinds give everything, and what is too long is left out here."""

from __future__ import annotations

from itertools import islice
from typing import get_args

from derive.derivation import Cell, Step, Table
from derive.expression import Expr, Matrix, walk
from derive.render.latex import Printer
from derive.render.layout import LINE, pieces
from derive.render.width import width

MOST_NODES = 500  # of a formula that can be short enough
NARROWEST = 0.7  # what a line is scaled to for a link that could be left out
WIDEST_TABLE = LINE / 0.8  # em
TREES = get_args(Expr)


def fits(link: Expr, printer: Printer, lines: int = 2) -> bool:
    """Whether a link that may be left out is short enough: no term wider than a line that is scaled, and all
    of it no longer than so many lines; the entries of a matrix, which does not break, no longer than four."""
    if sum(1 for _ in islice(walk(link), MOST_NODES)) == MOST_NODES:
        return False
    written = printer.write(link)
    if isinstance(link, Matrix):
        room = 4 * LINE - sum(width(printer.write(entry)) for row in link.rows for entry in row)
    else:
        room = lines * LINE - width(written)
    return room >= 0 and all(width(p) <= LINE / NARROWEST for p in pieces(written, LINE, fractions=False))


def kept(step: Step, printer: Printer, lines: int = 2) -> tuple[Expr, ...]:
    """The chain of a step without the spare links that are too long."""
    spare = [link for link in step.spare if not fits(link, printer, lines)]
    return tuple(link for link in step.chain if link not in spare)


def has_room(table: Table, printer: Printer) -> bool:
    """Whether the columns of a table, as wide as their widest formulas, stand side by side."""
    rows = ([width(printer.write(c)) if isinstance(c, TREES) else 0.0 for c in row] for row in table.rows)
    widest: list[float] = [max(column) for column in zip(*rows, strict=True)]
    return sum(widest) <= WIDEST_TABLE


def abridged(rows: tuple[tuple[Cell, ...], ...], most: int) -> tuple[tuple[Cell, ...], ...]:
    """The rows of a table, the middle left out where there are more."""
    return rows if len(rows) <= most else (*rows[: most - 2], ("...",) * len(rows[0]), *rows[-1:])
