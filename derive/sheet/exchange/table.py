"""A table in CSV as a robot: a row a joint, its columns Denavit-Hartenberg parameters or those of a screw."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from derive.errors import SheetError, SheetErrors
from derive.sheet.exchange.elements import Element
from derive.sheet.exchange.told import Data, Told
from derive.sheet.faults import did_you_mean
from derive.sheet.source import Faults, Source, Spot

ROWS = ("theta", "d", "a", "alpha")
SCREW = ("wx", "wy", "wz", "vx", "vy", "vz")
COM = ("com_x", "com_y", "com_z")
MOMENTS = ("ixx", "iyy", "izz")
PRODUCTS = ("ixy", "iyz", "ixz")
RANGE = ("min", "max")
BESIDE = ("name", "mass", *COM, *MOMENTS, *PRODUCTS, *RANGE)
SAID = ("name", "convention", "gravity", "home", "base", "tool")  # in lines as "# name: PUMA 560"
OTHERWISE = {"θ": "theta", "α": "alpha", "joint": "name", "m": "mass"} | {
    f"{old}{k}": f"{new}{axis}"
    for old, new in (("w", "w"), ("omega", "w"), ("omega_", "w"), ("v", "v"), ("s", "w"))
    for k, axis in zip("123" if old != "omega_" else "xyz", "xyz", strict=True)
}


@dataclass(frozen=True, slots=True)
class Row:
    """The cells of a line by their columns."""

    cells: dict[str, str]
    line: int
    source: Source

    def element(self, column: str = "") -> Element:
        """The place of a cell; of the whole line where it has none."""
        text = self.source.lines[self.line]
        start = 0
        for name, cell in self.cells.items():  # in their order: one cell stands behind the other
            at = max(text.find(cell, start), 0) if cell else start
            if name == column:
                return Element("cell", {}, self.source, self.line, at)
            start = at + len(cell)
        return Element("line", {}, self.source, self.line, 0)

    def some(self, columns: tuple[str, ...]) -> list[str]:
        """Cells that stand together, none where all are empty. Raises SheetErrors where one is missing."""
        found = [self.cells.get(column, "") for column in columns]
        if any(found) and not all(found):
            missing = columns[found.index("")]
            hint = f"{', '.join(columns)} stand together"
            raise self.element().error(f"'{missing}' is missing in this line", hint)
        return found if all(found) else []


def table(text: str, path: Path) -> Told:
    """The robot in a table. Raises SheetErrors with every fault of it."""
    from derive.sheet.exchange.screw_table import screw

    lines = tuple(text.split("\n"))
    source = Source(path, None, {(): Spot(0, 0)}, lines)
    rows = list(_rows(source))
    told = Told(Element("table", {}, source))
    for key, value, line in _said(source):
        told.put(value, Element("line", {}, source, line), key)
    faults = Faults()
    screws = SCREW[0] in rows[0].cells
    for index, row in enumerate(rows):
        with faults.gathered():
            if screws:
                screw(told, index, row)
            else:
                _parameters(told, index, row)
            _beside(told, index, row)
    faults.settle()
    return told


def _parameters(told: Told, index: int, row: Row) -> None:
    for column, cell in zip(ROWS, row.some(ROWS), strict=False):
        told.put(cell, row.element(column), "links", index, column)


def _beside(told: Told, index: int, row: Row) -> None:
    """What stands beside the columns of the joint: a body, limits, a name."""
    told.notes.append(row.cells.get("name", ""))
    if mass := row.cells.get("mass"):
        told.put(mass, row.element("mass"), "links", index, "mass")
    products = row.some(PRODUCTS)
    for columns, more, key in ((COM, [], "com"), (MOMENTS, products, "inertia"), (RANGE, [], "range")):
        if found := row.some(columns):
            entries: Data = [*found, *more]
            told.put(entries, row.element(columns[0]), "links", index, key)


def _rows(source: Source) -> Iterator[Row]:
    """The lines below the one that names the columns. Raises SheetErrors."""
    kept = [
        (k, line) for k, line in enumerate(source.lines) if line.strip() and not line.lstrip().startswith("#")
    ]
    if len(kept) < 2:
        hint = f"the first line names the columns: {', '.join(ROWS)}, or {', '.join(SCREW)}"
        raise SheetErrors([SheetError(f"{source.path}: this table has no rows", None, hint)])
    separator = max(",;\t", key=kept[0][1].count)
    names = _columns(source, kept[0][0], _cells(kept[0][1], separator))
    for line, text in kept[1:]:
        cells = _cells(text, separator)
        while len(cells) > len(names) and not cells[-1]:
            cells.pop()
        if len(cells) != len(names):
            message = f"this line has {len(cells)} cells, and there are {len(names)} columns"
            raise SheetErrors([SheetError(message, source.place(line, 0), "put cells with commas in quotes")])
        yield Row(dict(zip(names, cells, strict=True)), line, source)


def _cells(text: str, separator: str) -> list[str]:
    found = next(csv.reader([text], delimiter=separator, skipinitialspace=True), [])
    return [cell.strip() for cell in found]


def _columns(source: Source, line: int, typed: list[str]) -> list[str]:
    """The names of the columns. Raises SheetErrors for what is none."""
    faults = Faults()
    names = [OTHERWISE.get(name.lower(), name.lower()) for name in typed]
    known = (*ROWS, *SCREW, *BESIDE)
    for k, name in enumerate(names):
        place = source.place(line, max(source.lines[line].find(typed[k]), 0))
        if name not in known:
            faults.append(SheetError(f"there is no column '{typed[k]}'", place, did_you_mean(name, known)))
        elif name in names[:k]:
            faults.append(SheetError(f"the column '{typed[k]}' is there twice", place))
    faults.settle()
    wanted = SCREW if SCREW[0] in names else ROWS
    if missing := [name for name in wanted if name not in names]:
        message = f"the column '{missing[0]}' is missing"
        hint = f"a table has the columns {', '.join(ROWS)}, or {', '.join(SCREW)}"
        raise SheetErrors([SheetError(message, source.place(line, 0), hint)])
    return names


def _said(source: Source) -> Iterator[tuple[str, Data, int]]:
    """What lines as "# home: [[1, 0, 0, L], ...]" say of the whole robot. Raises SheetErrors."""
    from derive.sheet.reader import read_text

    for number, line in enumerate(source.lines):
        if found := re.fullmatch(rf"\s*#\s*({'|'.join(SAID)}):\s*(\S.*)", line):
            try:
                yield found[1], read_text(found[2], source.path).data, number
            except SheetErrors as errors:
                place = source.place(number, found.start(2))
                raise SheetErrors([SheetError(errors.errors[0].message, place)]) from errors
