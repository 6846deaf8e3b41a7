"""The characteristic polynomial against the equations, the array of Routh against determinants of Hurwitz."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.infix import text
from derive.algebra.numbers.floats import number
from derive.control.oracle import hurwitz
from derive.control.oracle.equations import Numeric, is_close, value
from derive.expression import ONE, ZERO, Expr, Indexed, Symbol
from derive.expression import number as index
from derive.kinds.system._checked_array import Printed
from derive.kinds.system._oracle import Held, Point, reals

CLOSE = 1e-8


def characteristic(printed: Printed, at: Point) -> complex:
    """As the page ends with it."""
    chains = {step.name: step.chain for step in printed.steps}
    return value(chains.get("values", chains["characteristic"])[-1], at)


def is_of_array(printed: Printed, at: Point) -> Iterator[bool]:
    """The polynomial is that of the array, times the factor that is left out."""
    rows = 0j
    for coefficient in printed.coefficients:
        rows = rows * at["s"] + value(coefficient, at)
    factor = ONE if printed.told.factor is None else printed.told.factor
    ours = characteristic(printed, at)
    yield is_close(ours, value(factor, at) * rows) and bool(ours)


def is_determinant(held: Held, printed: Printed, at: Point) -> Iterator[bool]:
    """Up to what holds no s it is the determinant of the equations, the integral of a controller brought
    up."""
    import numpy

    shares = []
    for s in (at["s"], 2 * at["s"].conjugate() + 0.3):
        solved = Numeric.of(held.system, held.source, reals(at))
        controller = held.controller
        matrix = solved.matrix(s) if controller is None else solved.loop(s, held.strength(reals(at), s))
        below = s if controller is not None and "I" in controller.family else 1.0
        shares.append(characteristic(printed, {**at, "s": s}) / (below * numpy.linalg.det(matrix)))
    yield is_close(shares[0], shares[1], 1e-6)


def minors(printed: Printed) -> Iterator[bool]:
    """Entries by determinants of Hurwitz, down to the row that has to be mended; one is where the words say
    so."""
    regular = printed.first_mended
    for at, polynomial in list(printed.points())[:3]:
        size = max(map(abs, polynomial))
        for i, row in enumerate(printed.routh.rows[: regular - 1], 1):
            for j, tree in enumerate(row, 1):
                other = hurwitz.entry(polynomial, i, j)
                if other is not None:
                    ours = number(tree, at)
                    yield abs(ours - other) <= CLOSE * max(size, abs(ours), abs(other))
        if regular <= printed.degree + 1:
            first = hurwitz.entry(polynomial, regular, 1)
            yield first is None or abs(first) <= CLOSE * size
        mended = printed.epsilon is not None or any(s.rule == "auxiliary" for s in printed.steps)
        yield mended == (regular <= printed.degree + 1)


def as_printed(printed: Printed) -> Iterator[bool]:
    """The table and the first column hold the entries; a long one by its name, whose indices say where it
    is."""
    told, rows = printed.told, printed.routh.rows
    columns = [each.about["column"] for each in told.concluded if "column" in each.about]
    yield all(column == tuple(row[0] for row in rows) for column in columns)
    entries = {step.chain[0]: step for step in printed.steps if step.rule == "entry"}
    for name, step in entries.items():
        i, j = _place(name, printed.letter)
        yield step.name == f"entry_{i}_{j}" and text(step.result) == text(rows[i - 1][j - 1])
    if told.array is None:
        yield printed.degree < 2
        return
    heads = told.array.headings
    yield heads[:2] == (Symbol("i"), "") and len(heads) == 2 + len(rows[0])
    yield all(head == Indexed(printed.letter, (Symbol("i"), index(j))) for j, head in enumerate(heads[2:], 1))
    for i, (row, cells) in enumerate(zip(rows, told.array.rows, strict=True), 1):
        yield cells[0] == str(i) and cells[1] == _power(printed.degree + 1 - i)
        for j, (entry, cell) in enumerate(zip(row, cells[2:], strict=True), 1):
            blank = j > (printed.degree + 1 - i) // 2 + 1
            named = isinstance(cell, Symbol | Indexed) and cell != entry
            yield (
                _place(cell, printed.letter) == (i, j)
                if named
                else (cell == "" and entry == ZERO)
                if blank
                else cell == entry
            )


def _place(name: object, letter: str) -> tuple[int, int]:
    """The row and the column that a name r_ij says."""
    if isinstance(name, Indexed) and name.base == letter:
        i, j = (round(number(each, {})) for each in name.lower)
        return i, j
    written = name.name if isinstance(name, Symbol) else ""
    start, _, digits = written.partition("_")
    return (int(digits[0]), int(digits[1])) if start == letter and len(digits) == 2 else (0, 0)


def _power(power: int) -> Expr:
    s = Symbol("s")
    return ONE if power == 0 else s if power == 1 else s**power
