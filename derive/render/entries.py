"""A matrix too wide for the page, with its long entries named and listed after it."""

from __future__ import annotations

from collections.abc import Mapping

from derive.algebra.readable.order import GREEK
from derive.expression import MINUS_ONE, ONE, ZERO, Expr, Indexed, Matrix, Symbol
from derive.names import entry_symbol
from derive.render.latex import Printer
from derive.render.layout import LINE
from derive.render.notation import Notation
from derive.render.width import width

NAMED_BEYOND = LINE / 0.8  # em; what is a little too wide is better scaled
LONG = 8.0  # em from which an entry gets a name
ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")  # of a Jacobian
VECTOR = (2, 3)  # rows of a column that is a vector of the plane or of space
PLAIN = (ZERO, ONE, MINUS_ONE)
DOTTED = ("i", "j")  # letters of which no one sees whether they have a dot

Chain = tuple[Expr, ...]
Names = Mapping[tuple[int, int], Symbol]  # of entries, by row and column from 0


def with_named_entries(
    chain: Chain, printer: Printer, widest: float = NAMED_BEYOND, given: Names | None = None
) -> tuple[Chain, tuple[Chain, ...]]:
    """The chain, and for each entry that had to be named the chain that says what it is.

    Only a chain from a name to a matrix wider than `widest` (em) changes: D = [d_11 ...], d_11 = ... Of
    entries with `given` names those of one letter are named together, so that a reader need not look which
    is short: the first letter, and others with an entry wider than half a line.
    """
    name, matrix = chain[0], chain[-1]
    if not isinstance(matrix, Matrix) or len(chain) < 2 or width(printer.write(matrix)) <= widest:
        return chain, ()
    names = _of_letters(matrix, printer, given) if given else _of_entries(name, matrix, printer)
    listed = {symbol: matrix.rows[i][j] for (i, j), symbol in sorted(names.items())}
    rows = enumerate(matrix.rows)
    shown = Matrix(tuple(tuple(names.get((i, j), e) for j, e in enumerate(row)) for i, row in rows))
    return (*chain[:-1], shown), tuple(listed.items())


def _letter(name: Symbol) -> str:
    return name.name.partition("_")[0]


def _of_letters(matrix: Matrix, printer: Printer, given: Names) -> Names:
    """The names that are used of those given; an entry that is plain needs none."""
    entries = {place: matrix.rows[place[0]][place[1]] for place in given}
    long = (place for place, entry in entries.items() if width(printer.write(entry)) > LINE / 2)
    letters = {_letter(next(iter(given.values()))), *(_letter(given[place]) for place in long)}
    return {
        place: name
        for place, name in given.items()
        if _letter(name) in letters and entries[place] not in PLAIN
    }


def _of_entries(name: Expr, matrix: Matrix, printer: Printer) -> Names:
    """The long entries, equal ones alike; some rows of a Jacobian keep the numbers that they have in the
    whole one."""
    whole, rate = _rate_apart(_base(name).partition("^")[0])
    stem, _, index = whole.partition("_")
    letter = stem.lower() if stem.lower() in GREEK else stem[:1].lower()
    if rate and letter in DOTTED:
        letter = letter.upper()
    letter = f"{letter}_{index}" if index else letter
    names: dict[tuple[int, int], Symbol] = {}
    known: dict[Expr, Symbol] = {}
    for i, (number, row) in enumerate(
        zip(_numbers(name, matrix, printer.notation), matrix.rows, strict=False)
    ):
        for j, value in enumerate(row):
            if width(printer.write(value)) >= LONG:
                place = (number,) if len(matrix.rows) in VECTOR and len(row) == 1 else (number, j + 1)
                names[i, j] = known.setdefault(value, Symbol(entry_symbol(letter, *place).name + rate))
    return names


def _rate_apart(name: str) -> tuple[str, str]:
    """J and _dot of J_dot: its entries are J_11_dot."""
    for rate in ("_ddot", "_dot"):
        if name.endswith(rate):
            return name.removesuffix(rate), rate
    return name, ""


def _base(name: Expr) -> str:
    return name.base if isinstance(name, Indexed) else name.name if isinstance(name, Symbol) else ""


def _numbers(name: Expr, matrix: Matrix, notation: Notation) -> tuple[int, ...]:
    """Those of the rows; none where the matrix has no name to call its entries by."""
    match name:
        case Symbol():
            return tuple(range(1, len(matrix.rows) + 1))
        case Indexed(_, lower, ()):
            rows = [row.name for row in lower if isinstance(row, Symbol) and row.name in ROWS]
            order = (*ROWS[3:], *ROWS[:3]) if notation.angular_first else ROWS
            return tuple(order.index(row) + 1 for row in rows) if len(rows) == len(matrix.rows) else ()
    return ()
