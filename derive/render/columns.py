"""The columns of a table of link parameters, in the order of a book."""

from __future__ import annotations

from collections.abc import Sequence

from derive.derivation import Cell, Table
from derive.expression import Indexed


def in_order(table: Table, columns: Sequence[str]) -> Table:
    """The table with these columns in this order, where it has all of them; the others stay."""
    at = {cell.base: k for k, cell in enumerate(table.headings) if isinstance(cell, Indexed)}
    if not columns or not at.keys() >= {*columns}:
        return table
    places = dict(zip(sorted(at[name] for name in columns), (at[name] for name in columns), strict=True))

    def moved(row: Sequence[Cell]) -> tuple[Cell, ...]:
        return tuple(row[places.get(k, k)] for k in range(len(row)))

    return Table(moved(table.headings), tuple(map(moved, table.rows)))
