"""Matrices in published LaTeX, row by row: environments, lists in parentheses, the rows of a program."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from derive.algebra.formulas.cursor import Cursor
from derive.algebra.formulas.quantities import Quantity
from derive.algebra.formulas.tokens import Token
from derive.answers.latex.scripts import group_text, skip_group
from derive.errors import FormulaError, Unfit
from derive.expression import Matrix

MAX_ENTRIES = 400
MATRICES = ("matrix", "bmatrix", "pmatrix", "Bmatrix", "smallmatrix", "array")
TRANSPOSED = ("T", "top", "intercal", "t")


class Matrices:
    """Reads a matrix where the cursor stands; `entry` reads one entry of it."""

    def __init__(self, cursor: Cursor, entry: Callable[[], Quantity]) -> None:
        self.cursor = cursor
        self.entry = entry
        self.entries = 0

    def environment(self) -> Quantity:
        r"""From \begin{bmatrix} to its \end. Raises FormulaError."""
        cursor = self.cursor
        opened = cursor.take()
        name = group_text(cursor.tokens, cursor.at).rstrip("*")
        if name not in MATRICES:
            raise FormulaError(
                f"no environment '{name}' here", cursor.next.offset, f"one of {', '.join(MATRICES)}"
            )
        skip_group(cursor)
        if name == "array":
            skip_group(cursor)
        rows = self._rows(opened)
        skip_group(cursor)
        if not rows[0]:
            raise FormulaError("this matrix is empty", opened.offset)
        return _matrix(rows, opened)

    def listed(self, first: Quantity, opened: Token) -> Quantity:
        """What stands in parentheses after its first entry: nothing more, a column (a, b), turned too, or the
        rows [a, b; c, d] of a program. Raises FormulaError."""
        cursor, rows = self.cursor, [[first]]
        while cursor.next.text in (",", ";"):
            rows += [[]] if cursor.take().text == ";" else []
            rows[-1].append(self.entry())
        if len(rows) > 1:
            _require_commas(cursor.tokens[cursor.tokens.index(opened) + 1 : cursor.at])
        cursor.close(opened, ")" if opened.text == "(" else "]")
        if len(rows) > 1 and any(len(row) > 1 for row in rows):
            return _matrix(rows, opened)
        entries = [entry for row in rows for entry in row]
        if len(entries) == 1:
            return first
        if cursor.next.text == "^" and group_text(cursor.tokens, cursor.at + 1) in TRANSPOSED:
            cursor.take()
            skip_group(cursor)
        self._count(len(entries), cursor.next)
        return _matrix([[entry] for entry in entries], opened)

    def _rows(self, opened: Token) -> list[list[Quantity]]:
        cursor = self.cursor
        rows: list[list[Quantity]] = [[]]
        while cursor.next.text != "end" or cursor.next.kind != "command":
            rows[-1].append(self.entry())
            self._count(1, opened)
            if cursor.next.text == ",":  # a, & b
                cursor.take()
            token = cursor.next
            if token.text == "&":
                cursor.take()
                if cursor.next.text in ("end", "&") or cursor.next.kind == "row":
                    raise FormulaError("an entry of this matrix is empty", token.offset)
            elif token.kind == "row":
                cursor.take()
                if cursor.next.text != "end":
                    rows.append([])
            elif token.kind == "end":
                raise FormulaError("this matrix has no \\end", opened.offset)
            elif token.text != "end":
                raise cursor.unexpected()
        cursor.take()
        return rows

    def _count(self, more: int, at: Token) -> None:
        self.entries += more
        if self.entries > MAX_ENTRIES:
            raise Unfit(f"an answer has at most {MAX_ENTRIES} entries", at.offset)


def _matrix(rows: Sequence[Sequence[Quantity]], opened: Token) -> Quantity:
    """The matrix of these rows."""
    if len({len(row) for row in rows}) != 1:
        raise FormulaError("the rows of this matrix are not equally long", opened.offset)
    terms = sum(entry.terms for row in rows for entry in row)
    return Quantity(Matrix(tuple(tuple(entry.expr for entry in row) for row in rows)), None, False, terms)


def _require_commas(between: Sequence[Token]) -> None:
    """Raises FormulaError where rows such as `0 1; -6 -11` have blanks between their entries: they would be
    read as products and differences."""
    for left, right, after in zip(between, between[1:], [*between[2:], between[-1]], strict=False):
        apart = left.end < right.offset and left.text not in list("+-*/^_([{,;")
        signed = right.text in "+-" and right.end == after.offset
        if apart and (right.kind == "number" or signed or (left.text == "0" and right.text not in "+-*/;,")):
            raise FormulaError("a blank stands between entries", left.end, "write commas between them")
