"""The page read back: its mathematics is read by our LaTeX reader and compared with what it was printed from.

Every display is taken apart where its signs of equality stand, and each expression is read in the names of
its tree; a page that says something else is refused. What was read and what could not be is counted.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache

from derive.algebra.fingerprint import fingerprint
from derive.algebra.formulas.tokens import Kind, Token
from derive.answers.latex.printed import SIGNS, parts_of, read_part, require_tex
from derive.answers.latex.scripts import Tokens
from derive.answers.latex.units import without_units
from derive.errors import FormulaError, SheetError, SheetErrors, Unfit
from derive.expression import (
    Approximate,
    Expr,
    Indexed,
    Matrix,
    Measured,
    Symbol,
    children,
    rebuild,
    unmeasured,
    walk,
)
from derive.expression import replace as written_out
from derive.render.document import Document
from derive.render.layout import Chain
from derive.render.notation import Notation
from derive.render.own_templates import written_at
from derive.render.printed import Naming, Printed, Reading, Said
from derive.render.typed import is_law

REMEMBERED = 20_000  # formulas of one process: a sheet is printed in several formats
MISPRINTED = "the page says something else than was derived"
JACOBIAN = ("vx", "vy", "vz", "wx", "wy", "wz")
AXES = ("x", "y", "z")
EQUALS = ("=", r"\approx")
DEGREE = ("^", "circ")  # the sign in a text, of a unit
REPORT = "please report this with the sheet"


class Misprinted(Exception):
    """What stands on a page is not what it was printed from."""


def reading_of(document: Document) -> Reading:
    """What was read of the page of a document, and what could not be. Raises SheetErrors."""
    from derive.render.page import render_markdown

    found: list[Reading] = []

    def read(said: Sequence[Said]) -> Reading:
        found.append(read_back(said))
        return found[-1]

    render_markdown(document, read=read)
    return found[-1]


def read_back(said: Sequence[Said]) -> Reading:
    """How many formulas of a page were read and found to say what they were printed from. Raises SheetErrors
    for those that do not, with the question and the formula."""
    read, typed, unread, faults = 0, 0, dict[str, None](), list[SheetError]()
    for part in said:
        whole = dict.fromkeys(part.printed)
        for formula in whole:
            try:
                _require_part(formula, whole)
                doubts = _unread(formula)
            except Misprinted as error:
                message = f"question {part.question} failed its own check: {MISPRINTED}: {error}"
                own = None if formula.chains else written_at(formula.lines)
                faults.append(SheetError(message, own or part.place, "" if own else REPORT))
                continue
            typed += not formula.chains
            read += bool(formula.chains and not doubts)
            unread |= dict.fromkeys(doubts)
    if faults:
        raise SheetErrors(faults)
    return Reading(read, tuple(unread), typed)


@lru_cache(REMEMBERED)
def _unread(printed: Printed) -> tuple[str, ...]:
    """The formula, once for each of its expressions that could not be read, with the reason. Raises
    Misprinted."""
    shown = " ".join(printed.lines)
    if not all(_names_entries(naming, printed.notation) for naming in printed.namings):
        raise Misprinted(f"{shown} (the names of its entries stand for others)")
    if not printed.evaluated:
        raise Misprinted(f"{shown} (these are not the numbers that were evaluated)")
    try:
        if not printed.chains:
            _require_law(printed.lines)
            return ()
        chains = parts_of(printed.lines)
        if [*map(len, chains)] != [*map(len, printed.chains)]:
            raise Misprinted("a part is missing, or is one too many")
        both = zip(chains, printed.chains, strict=True)
        return tuple(f"{shown} ({why})" for pair in both for why in _doubts(*pair, printed.notation))
    except Unfit as error:
        return (f"{shown} ({error.message})",)
    except (FormulaError, Misprinted) as error:
        raise Misprinted(f"{shown} ({error})") from error


def _require_law(lines: Sequence[str]) -> None:
    """Raises FormulaError for typed mathematics that TeX would refuse, Misprinted where it is a formula that
    is no law of the house's words."""
    for line in lines:
        found = require_tex(line)
        if any(token.text in SIGNS for token in found) and not is_law(line):
            raise Misprinted("it was typed, and is no law that is listed")


def _require_part(formula: Printed, page: Iterable[Printed]) -> None:
    """Raises Misprinted for a typed name with an index, or an expression, that no formula beside it has."""
    for line in () if formula.chains else formula.lines:
        own = _signs(formula.notation.letters.latex(line))
        if len(own) < 2 or own == DEGREE or SIGNS.keys() & {*own} or is_law(line):
            continue
        known = (other for each in page for other in map(_signs, each.lines) if _is_whole(each, other))
        if not any(other[k : k + len(own)] == own for other in known for k in range(len(other))):
            raise Misprinted(f"{line} (it was typed, and stands in no formula)")


def _is_whole(formula: Printed, line: tuple[str, ...]) -> bool:
    """Whether it says something by itself: it was printed from trees, or is a law."""
    return bool(formula.chains) or any(sign in SIGNS for sign in line)


@lru_cache(REMEMBERED)
def _signs(line: str) -> tuple[str, ...]:
    """What a line is made of; nothing where it cannot be read, which is told by itself."""
    try:
        return tuple(token.text for token in require_tex(line) if token.kind not in ("gap", "end"))
    except (FormulaError, Unfit):
        return ()


def _doubts(found: Sequence[tuple[str, Tokens]], chain: Chain, notation: Notation) -> Iterator[str]:
    """Why expressions of a chain could not be read. Raises Misprinted."""
    rounded = False
    for (sign, part), link in zip(found, chain, strict=True):
        assert link.tree is not None  # what is laid out from trees knows them
        before, rounded = rounded, _is_rounded(link.tree)
        wanted = link.relation if link.relation not in EQUALS else EQUALS[rounded or before]
        if link is not chain[0] and sign != wanted:
            raise Misprinted(f"{sign} stands for {wanted}")
        try:
            same = _says(tuple((token.kind, token.text) for token in part), link.tree, notation)
        except Unfit as error:
            yield error.message
            continue
        except FormulaError as error:
            raise Misprinted(error.message) from error
        if not same:
            raise Misprinted("what stands there is another expression")


@lru_cache(REMEMBERED)
def _says(part: tuple[tuple[Kind, str], ...], tree: Expr, notation: Notation) -> bool:
    """Whether tokens say what a tree does, to the digits that are printed. Raises FormulaError."""
    tree = notation.letters.tree(tree)
    tokens = tuple(Token(kind, text, place, place) for place, (kind, text) in enumerate(part))
    if wanted := (*_units(tree),):
        tokens, units = without_units(tokens)
        if units != wanted:
            raise FormulaError(f"the units {', '.join(units)} stand for {', '.join(wanted)}", 0)
        tree = unmeasured(tree)
    tree = _without_brackets(tree)
    read = read_part(tokens, tree, notation.atan2 == "xy")
    return fingerprint(read, notation.digits) == fingerprint(tree, notation.digits)


def _without_brackets(tree: Expr) -> Expr:
    """With the number in place of a matrix (1 by 1), as it is printed."""
    match tree:
        case Matrix(((alone,),)):
            return _without_brackets(alone)
    return rebuild(tree, _without_brackets)


def _units(tree: Expr) -> Iterator[str]:
    """Those in it, in the order in which they are written."""
    for part in children(tree):
        yield from _units(part)
    if isinstance(tree, Measured):
        yield tree.unit


def _names_entries(naming: Naming, notation: Notation) -> bool:
    """Whether a matrix is the whole one again with its names written out, and each name has the indices of
    its place: d_12 that of row 1 and column 2, p_y that of row 2 and the last column, and of some rows of a
    Jacobian those that they have in all of it."""
    whole = naming.whole
    if not isinstance(whole, Matrix) or written_out(naming.shown, dict(naming.listed)) != whole:
        return False
    rows = [*range(1, len(whole.rows) + 1)]
    if isinstance(naming.head, Indexed):
        order = (*JACOBIAN[3:], *JACOBIAN[:3]) if notation.angular_first else JACOBIAN
        rows = [order.index(row.name) + 1 for row in naming.head.lower if isinstance(row, Symbol)]
    entries = {
        (i, j): entry for i, row in zip(rows, whole.rows, strict=True) for j, entry in enumerate(row, 1)
    }
    return all(entries.get(_place(name, len(whole.rows[0]))) == tree for name, tree in naming.listed)


def _place(name: Expr, last: int) -> tuple[int, int]:
    """The row and the column that a name says, from 1; of a column the row alone; 0, 0 for one that says
    none."""
    said = name.name.removesuffix("_dot").removesuffix("_ddot") if isinstance(name, Symbol) else ""
    index = said.rpartition("_")[2]
    if index in AXES:
        return AXES.index(index) + 1, last
    row, comma, column = index.partition(",")
    numbers = (row, column) if comma else (index[:1], index[1:] or ("1" if last == 1 else ""))
    return (int(numbers[0]), int(numbers[1])) if all(map(str.isdigit, numbers)) else (0, 0)


def _is_rounded(tree: Expr) -> bool:
    return any(isinstance(node, Approximate) for node in walk(tree))
