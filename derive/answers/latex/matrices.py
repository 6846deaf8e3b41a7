"""Matrices in published LaTeX, row by row."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence

from derive.algebra.formulas.quantities import Quantity
from derive.answers.latex.names import NameReader
from derive.answers.latex.scripts import group_text
from derive.answers.latex.tokens import Token
from derive.errors import FormulaError
from derive.expression import Matrix

MAX_ENTRIES = 400
MATRICES = ("matrix", "bmatrix", "pmatrix", "Bmatrix", "smallmatrix", "array")


def require_commas(between: Sequence[Token]) -> None:
    """Raises FormulaError where rows such as `0 1; -6 -11` have blanks between their entries: they would be
    read as products and differences."""
    for left, right, after in zip(between, between[1:], [*between[2:], between[-1]], strict=False):
        apart = left.end < right.offset and left.text not in list("+-*/^_([{,;")
        signed = right.text in "+-" and right.end == after.offset
        if apart and (right.kind == "number" or signed or (left.text == "0" and right.text not in "+-*/;,")):
            raise FormulaError("a blank stands between entries", left.end, "write commas between them")


class GridReader(NameReader):
    """Reads a matrix where the cursor stands; an entry is a sum."""

    @abstractmethod
    def sum(self) -> Quantity:
        """An entry."""

    def matrix(self) -> Quantity:
        opened = self.take()
        name = group_text(self.tokens, self.at).rstrip("*")
        if name not in MATRICES:
            raise FormulaError(
                f"no environment '{name}' here", self.next.offset, f"one of {', '.join(MATRICES)}"
            )
        self.skip_group()
        if name == "array":
            self.skip_group()
        return self.gathered(self.rows(opened), opened)

    def gathered(self, rows: list[list[Quantity]], opened: Token) -> Quantity:
        """The matrix of these rows."""
        if len({len(row) for row in rows}) != 1:
            raise FormulaError("the rows of this matrix are not equally long", opened.offset)
        terms = sum(entry.terms for row in rows for entry in row)
        return Quantity(Matrix(tuple(tuple(e.expr for e in row) for row in rows)), None, False, terms)

    def rows(self, opened: Token) -> list[list[Quantity]]:
        rows: list[list[Quantity]] = [[]]
        while True:
            if self.next.text == "end" and self.next.kind == "command":
                break
            rows[-1].append(self.sum())
            self.entries += 1
            if self.entries > MAX_ENTRIES:
                raise FormulaError(f"an answer has at most {MAX_ENTRIES} entries", opened.offset)
            if self.next.text == ",":  # a, & b
                self.take()
            token = self.next
            if token.text == "&":
                self.take()
                if self.next.text in ("end", "&") or self.next.kind == "row":
                    raise FormulaError("an entry of this matrix is empty", token.offset)
            elif token.kind == "row":
                self.take()
                if self.next.text != "end":
                    rows.append([])
            elif token.kind == "end":
                raise FormulaError("this matrix has no \\end", opened.offset)
            elif token.text != "end":
                raise self.unexpected()
        self.take()
        self.skip_group()
        if not rows[0]:
            raise FormulaError("this matrix is empty", opened.offset)
        return rows
