"""Answers as their authors typed them, read into trees: a formula, rows or a list of formulas, or LaTeX."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias

from derive.algebra.formulas.functions import ARGUMENTS
from derive.algebra.formulas.grammar import parse
from derive.algebra.formulas.tokens import tokens
from derive.algebra.formulas.units import ANY, INSTEAD, UNITS
from derive.algebra.values import MATRIX_FUNCTIONS
from derive.answers.chains import read_published
from derive.answers.latex.letters import Letters
from derive.answers.latex.matrices import MAX_ENTRIES
from derive.answers.latex.parser import NUMBERED
from derive.answers.latex.tokens import MAX_TEXT
from derive.answers.published import Published, gathered
from derive.errors import FormulaError, Place, SheetError, SheetErrors
from derive.expression import PI, Call, Expr, Matrix, Product, Symbol, multiply, rebuild, walk

_SPACE = r"(?:\s|~|\\[,;:! ])*"
_MEASURED = re.compile(
    rf"{_SPACE}(?:[\w\\{{}}^()]+{_SPACE}(?:=|\\approx|≈){_SPACE})?"
    rf"(?P<number>-?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?){_SPACE}"
    rf"(?:\\(?:text|textrm|mathrm|mbox)\s*\{{{_SPACE}(?P<set>[^{{}}]*){_SPACE}\}}"
    r"|(?P<plain>%|[A-Za-z][\w/^ ]*))[\s.]*"
)
_LONGEST = 200
_NAME = re.compile(r"[A-Za-z]+")

Route: TypeAlias = tuple[str | int, ...]
Locate: TypeAlias = Callable[[Route, int], Place]
LATEX = "\\{}&$"
BESIDE = re.compile(r"[\w)\]]\s+[\w(\[]|\)[\w(]|(?<![\w.])\d+(?:\.\d+)?[A-Za-z(]")  # factors without a sign
NUMBER = re.compile(r"\s\(\d+\)\s*$")  # of an equation, or a factor
BEFORE_PARENTHESIS = re.compile(r"(?<!\w)[A-Za-z]\(")  # a factor: s(s + 1)
LOOSE = "_=,;:.|%"  # in a formula that is no formula of the sheet language, but may be one of a book


@dataclass(frozen=True)
class Reader:
    """Reads the answer at one place of a sheet; what cannot be read is added to `faults`."""

    letters: Letters
    locate: Locate
    faults: list[SheetError] = field(default_factory=list)

    def answer(self, typed: Any, route: Route) -> Published | None:
        """A scalar, or a matrix; a flat list is a column. None where it cannot be read."""
        if not isinstance(typed, list):
            return self.formula(typed, route)
        if not typed:
            self.fault("this list is empty", route)
            return None
        if isinstance(typed[0], list):
            return self.rows(typed, route)
        if len(typed) > MAX_ENTRIES:
            self.fault(f"an answer has at most {MAX_ENTRIES} entries", route)
            return None
        return self.grid([[self.scalar(entry, (*route, k))] for k, entry in enumerate(typed)])

    def rows(self, typed: list[Any], route: Route) -> Published | None:
        """A matrix from a list of rows. None where it cannot be read."""
        for k, row in enumerate(typed):
            if not isinstance(row, list) or len(row) != len(typed[0]) or not row:
                self.fault("the rows of this matrix are not equally long", (*route, k))
                return None
        if len(typed) * len(typed[0]) > MAX_ENTRIES:
            self.fault(f"an answer has at most {MAX_ENTRIES} entries", route)
            return None
        return self.grid(
            [[self.scalar(e, (*route, i, j)) for j, e in enumerate(row)] for i, row in enumerate(typed)]
        )

    def grid(self, found: list[list[Published | None]]) -> Published | None:
        """The matrix of entries, unless one of them cannot be read."""
        rows = [[entry for entry in row if entry is not None] for row in found]
        whole = all(len(row) == len(other) for row, other in zip(rows, found, strict=True))
        return gathered(rows) if whole else None

    def scalar(self, typed: Any, route: Route) -> Published | None:
        """One entry of a list."""
        found = self.formula(typed, route)
        if found is not None and isinstance(found.tree, Matrix):
            self.fault("a matrix cannot be an entry of a list", route)
            return None
        return found

    def formula(self, typed: Any, route: Route) -> Published | None:
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
        """Adds a fault of the text there, unless the same is known."""
        fault = SheetError(message, self.locate(route, offset), hint)
        if not any((fault.message, fault.place) == (other.message, other.place) for other in self.faults):
            self.faults.append(fault)  # both signs of a plus-minus have the faults of their text

    def finish(self) -> None:
        """Raises SheetErrors with all that could not be read."""
        if self.faults:
            raise SheetErrors(self.faults)


def read_text(text: str, letters: Letters) -> Published:
    """What a formula or LaTeX says, in the problem's own symbols. Raises FormulaError."""
    number = measured(text)
    try:
        found = _read_text(text, letters) if number is None else _read_text(text.replace(r"\%", "%"), letters)
    except FormulaError:
        if number is None:
            raise
        return Published(number)
    return found if number in (None, found.tree) else replace(found, measured=number)


def _read_text(text: str, letters: Letters) -> Published:
    if any(sign in text for sign in LATEX):
        return read_published(text, letters, _whole_matrix)
    try:
        tree = _read_formula(text, letters)
    except FormulaError:
        if not (any(sign in text for sign in LOOSE) or BEFORE_PARENTHESIS.search(text)):
            raise
        try:  # LaTeX has letters side by side: mgL_c, s(s + 1)
            return read_published(text, letters, _whole_matrix)
        except FormulaError as error:
            if "=" in text or "[" in text:
                raise error from None
        raise
    return Published(tree, _tight(text, tree, letters))


def _tight(text: str, tree: Expr, letters: Letters) -> Expr | None:
    """The other reading of a formula with a/b c in it. Raises FormulaError where its end is unclear."""
    if not ("/" in text and BESIDE.search(text)) and not NUMBER.search(text):
        return None
    try:
        found = read_published(text.replace("**", "^"), letters, _whole_matrix)
    except FormulaError as error:
        if NUMBERED in error.message:
            raise
        return None
    return found.tight if found.tree == tree else None


def _read_formula(typed: str, letters: Letters) -> Expr:
    text = re.sub(r"\bAbs(?=\()", "abs", typed)  # as SymPy writes it, and our own JSON
    found = tokens(text, MAX_TEXT)
    foreign = {token.text: token.offset for token in found[::-1] if token.kind == "name"}
    units = any(name in UNITS and not letters.find(name) for name in foreign)
    tree = parse(text, dimension=ANY if units else None, names=letters.known, longest=MAX_TEXT)
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
        holds = isinstance(node, Call) and any(isinstance(argument, Matrix) for argument in node.arguments)
        if isinstance(node, Call) and holds and node.function not in MATRIX_FUNCTIONS:
            raise FormulaError(f"{node.function} of a matrix", 0)
    if any(isinstance(node, Matrix) for node in walk(tree)):
        return _worked_out(tree)
    return tree


def _worked_out(tree: Expr) -> Expr:
    """Sums and products of matrices as one matrix. Raises FormulaError."""
    from derive.algebra.normal import normal_matrix
    from derive.algebra.readable.form import readable_matrix
    from derive.errors import NotDerivable

    try:
        found = readable_matrix(normal_matrix(tree))
    except (NotDerivable, ValueError, ZeroDivisionError) as error:
        raise FormulaError(f"these matrices cannot be combined: {error}", 0) from error
    return found.rows[0][0] if found.shape == (1, 1) else found


def measured(text: str) -> Expr | None:
    """What a text stands for that is nothing but a number and a unit, or per cent; None for any other."""
    plain = text.replace(r"\%", "%").replace("$", "")
    found = _MEASURED.fullmatch(plain) if len(plain) <= _LONGEST else None
    if not found:
        return None
    unit = (found["set"] or found["plain"] or "").strip()
    if unit == "%":
        return parse(f"{found['number']}/100")
    unit = _NAME.sub(lambda name: INSTEAD.get(name[0], name[0]), unit)
    if not set(_NAME.findall(unit)) <= UNITS.keys():
        return None
    try:
        return parse(f"{found['number']} {unit}", dimension=ANY)
    except FormulaError:
        return None
