"""Answers as their authors typed them, read into trees: a formula, rows or a list of formulas, or LaTeX."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from derive.algebra.grammar import parse
from derive.algebra.spelling import ARGUMENTS
from derive.algebra.tokens import tokens
from derive.algebra.units import ANY, UNITS
from derive.answers.grids import MAX_ENTRIES
from derive.answers.latex import read_latex
from derive.answers.letters import Letters
from derive.errors import FormulaError, Place, SheetError, SheetErrors
from derive.expression import PI, Call, Expr, Matrix, Product, Symbol, column, multiply, rebuild, walk

Route: TypeAlias = tuple[str | int, ...]
Locate: TypeAlias = Callable[[Route, int], Place]


@dataclass(frozen=True)
class Reader:
    """Reads the answer at one place of a sheet; what cannot be read is added to `faults`."""

    letters: Letters
    locate: Locate
    faults: list[SheetError] = field(default_factory=list)

    def tree(self, typed: Any, route: Route) -> Expr | None:
        """A scalar, or a matrix; a flat list is a column. None where it cannot be read."""
        if not isinstance(typed, list):
            return self.formula(typed, route)
        if not typed:
            self.fault("this list is empty", route)
            return None
        if isinstance(typed[0], list):
            return self.rows(typed, route)
        entries = [self.scalar(entry, (*route, k)) for k, entry in enumerate(typed[:MAX_ENTRIES])]
        return column([entry for entry in entries if entry is not None])

    def rows(self, typed: list[Any], route: Route) -> Expr | None:
        for k, row in enumerate(typed):
            if not isinstance(row, list) or len(row) != len(typed[0]) or not row:
                self.fault("the rows of this matrix are not equally long", (*route, k))
                return None
        if len(typed) * len(typed[0]) > MAX_ENTRIES:
            self.fault(f"an answer has at most {MAX_ENTRIES} entries", route)
            return None
        found = [[self.scalar(e, (*route, i, j)) for j, e in enumerate(row)] for i, row in enumerate(typed)]
        rows = tuple(tuple(entry for entry in row if entry is not None) for row in found)
        return Matrix(rows) if all(len(row) == len(typed[0]) for row in rows) else None

    def scalar(self, typed: Any, route: Route) -> Expr | None:
        """One entry of a list."""
        found = self.formula(typed, route)
        if isinstance(found, Matrix):
            self.fault("a matrix cannot be an entry of a list", route)
            return None
        return found

    def formula(self, typed: Any, route: Route) -> Expr | None:
        """What one text stands for."""
        if typed is None:
            self.fault("an answer is missing", route)
            return None
        if not isinstance(typed, str):
            self.fault("a formula is wanted here", route)
            return None
        try:
            return read_text(typed, self.letters)
        except FormulaError as error:
            self.fault(error.message, route, error.hint, error.offset)
            return None

    def fault(self, message: str, route: Route, hint: str = "", offset: int = 0) -> None:
        self.faults.append(SheetError(message, self.locate(route, offset), hint))

    def finish(self) -> None:
        """Raises SheetErrors with all that could not be read."""
        if self.faults:
            raise SheetErrors(self.faults)


def read_text(text: str, letters: Letters) -> Expr:
    """The scalar or matrix of a formula or of LaTeX, in the problem's own symbols. Raises FormulaError."""
    if any(sign in text for sign in "\\{}&$"):
        return _whole_matrix(read_latex(text, letters))
    try:
        return _read_formula(text, letters)
    except FormulaError:
        if "_" not in text:
            raise
        try:  # LaTeX has letters side by side: mgL_c
            return _whole_matrix(read_latex(text, letters))
        except FormulaError:
            pass
        raise


def _read_formula(text: str, letters: Letters) -> Expr:
    found = tokens(text)
    foreign = {token.text: token.offset for token in found[::-1] if token.kind == "name"}
    units = any(name in UNITS and not letters.find(name) for name in foreign)
    tree = parse(text, dimension=ANY if units else None, names=letters.known)
    return _renamed(tree, letters, foreign)


def _renamed(tree: Expr, letters: Letters, offsets: dict[str, int]) -> Expr:
    """The tree in the problem's own names, c1 and s_12 written out. Raises FormulaError."""
    if not isinstance(tree, Symbol):
        return rebuild(tree, lambda part: _renamed(part, letters, offsets))
    if tree == PI or tree.name in ARGUMENTS:
        return tree
    if name := letters.find(tree.name):
        return Symbol(name)
    if (written := letters.abbreviated(tree.name)) is not None:
        return written
    raise letters.unknown(tree.name, offsets.get(tree.name, 0))


def _whole_matrix(tree: Expr) -> Expr:
    """A number times a matrix with the number in each entry; other arithmetic of matrices stays as it is.

    Raises FormulaError where a matrix stands inside a function or a matrix.
    """
    match tree:
        case Matrix():
            if any(isinstance(node, Matrix) for row in tree.rows for entry in row for node in walk(entry)):
                raise FormulaError("a matrix cannot stand in a matrix", 0)
            return tree
        case Product(factors) if sum(isinstance(factor, Matrix) for factor in factors) == 1:
            scale = multiply(*(factor for factor in factors if not isinstance(factor, Matrix)))
            matrix = next(factor for factor in factors if isinstance(factor, Matrix))
            return Matrix(tuple(tuple(multiply(scale, entry) for entry in row) for row in matrix.rows))
    for node in walk(tree):
        if isinstance(node, Call) and any(isinstance(argument, Matrix) for argument in node.arguments):
            raise FormulaError(f"{node.function} of a matrix", 0)
    if any(isinstance(node, Matrix) for node in walk(tree)):
        return _worked_out(tree)
    return tree


def _worked_out(tree: Expr) -> Expr:
    """Sums and products of matrices as one matrix. Raises FormulaError."""
    from derive.algebra.normal import normal_matrix
    from derive.algebra.readable import readable_matrix
    from derive.errors import NotDerivable

    try:
        found = readable_matrix(normal_matrix(tree))
    except (NotDerivable, ValueError, ZeroDivisionError) as error:
        raise FormulaError(f"these matrices cannot be combined: {error}", 0) from error
    return found.rows[0][0] if found.shape == (1, 1) else found
