"""The columns of a table: a unit stands once, in the heading, and numbers below it are said in one way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import get_args

from derive.derivation import Cell, Table
from derive.expression import PI, ZERO, Approximate, Degrees, Expr, Number, free_symbols, number
from derive.render.measures import hold_number
from derive.render.values import Values

TREES = get_args(Expr)
SUPERSCRIPTS = {"^2": "²", "^3": "³"}


def columns_of(table: Table, values: Values) -> tuple[Table, tuple[str, ...]]:
    """The table with its numbers as they are printed, and the unit of each column, "" where it has none.
    Raises NotAsWritten where a cell is said as another number."""
    columns = [
        _column(heading, column, values)
        for heading, column in zip(table.headings, zip(*table.rows, strict=True), strict=True)
    ]
    shown = Table(table.headings, tuple(zip(*(cells for cells, _ in columns), strict=True)))
    for k, (_, unit) in enumerate(columns):
        for found, said in zip(table.rows, shown.rows, strict=True):
            _hold(found[k], said[k], unit)
    return shown, tuple(unit for _, unit in columns)


def _hold(found: Cell, said: Cell, unit: str) -> None:
    if isinstance(found, TREES) and isinstance(said, TREES):
        turned = unit.startswith("deg") and not isinstance(said, Degrees)
        hold_number(found, said * PI / number(180) if turned else said)


def unit_text(unit: str) -> str:
    """A unit in a line of text, "m/s²"; that of an angle in degrees "°/s"."""
    written = "°" + unit[3:] if unit.startswith("deg") else unit
    for plain, raised in SUPERSCRIPTS.items():
        written = written.replace(plain, raised)
    return written


def _column(heading: Cell, cells: Sequence[Cell], values: Values) -> tuple[tuple[Cell, ...], str]:
    if not any(isinstance(cell, TREES) for cell in cells):  # signs, or words
        return tuple(cells), ""
    unit = next((unit for name, unit in values.units.items() if name == heading), "")
    unit = unit or _typed(cells)
    if unit.startswith("deg"):
        return tuple(_without_degrees(cell, values) for cell in cells), unit
    zero = next((Degrees(Fraction(0)) for cell in cells if isinstance(cell, Degrees)), ZERO)
    return tuple(_said(zero if cell == ZERO else cell, values) for cell in cells), unit


def _typed(cells: Sequence[Cell]) -> str:
    """The unit that the author typed behind every number of a column but zero."""
    typed = {cell.unit for cell in cells if isinstance(cell, Number) and cell.value}
    return typed.pop() if len(typed) == 1 else ""


def _said(cell: Cell, values: Values) -> Cell:
    return values.cell(cell) if isinstance(cell, TREES) else cell


def _without_degrees(cell: Cell, values: Values) -> Cell:
    """An angle as its number of degrees."""
    match cell:
        case Degrees(value):
            return values.cell(Number(value, True))
        case Approximate():
            return replace(cell, value=values.degrees(cell))
        case _ if isinstance(cell, TREES) and cell != ZERO and not free_symbols(cell):
            return values.cell(Approximate(values.degrees(cell)))
    return _said(cell, values)


def headed(headings: Sequence[str], units: Sequence[str]) -> Iterator[str]:
    """The headings with their units."""
    for heading, unit in zip(headings, units, strict=True):
        yield f"{heading} [{unit}]" if unit else heading
