r"""What a text of a problem says by itself: the names, numbers and words that stand in it.

`\theta_1`, `\theta_{1}` and `{\theta}_1` are one name. Numbers count as digits and as words ("six"), and a
number at an index is none.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from derive.algebra.formulas.quantities import rational
from derive.expression import (
    Approximate,
    Degrees,
    Expr,
    Matrix,
    Measured,
    Number,
    free_symbols,
    number,
    rebuild,
    walk,
)
from derive.given.datum import Datum
from derive.render.latex import Printer
from derive.render.names import name_latex
from derive.render.notation import Notation

WORDS = r"\\(?:mathrm|text|mathcal)\{[A-Za-z]+\}"
LETTER = rf"(?:{WORDS}|(?:\\d?dot\s*)?\{{?(?:\\[A-Za-z]+|[A-Za-z])\}}?)"
INDEX = r"\s*_\s*(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\[A-Za-z]+|\w)"
NAME = re.compile(rf"{LETTER}(?:{INDEX})?")
EVERY = re.compile(r"\d+$")  # I_i says what each of I_1, I_2, ... is
FRACTION = re.compile(r"\\[dt]?frac\s*\{?(\d+)\}?\s*\{?(\d+)\}?|(\d+)\s*/\s*(\d+)")
NUMBER = re.compile(r"([-−]?\d+(?:\.\d+)?)\$?\s*(%|\\%|cm\b|mm\b|ms\b)?")
SIZES = {"%": 100, "\\%": 100, "cm": 100, "mm": 1000, "ms": 1000}
NUMERALS = ["two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"]
FORMULA = re.compile(r"\$([^$]+)\$")
BLANKS = re.compile(r"[\s{}]|\\[,;:!]")
AXES = ("x", "y", "z")
UNITS = (1, -1)  # inside of a formula


@dataclass(frozen=True, slots=True)
class Mentioned:
    """What stands in some texts."""

    names: frozenset[str]
    numbers: frozenset[Fraction]
    formulas: str
    dense: str
    plain: str

    @classmethod
    def of(cls, texts: Iterable[str]) -> Mentioned:
        """Of texts in Markdown with `$...$`."""
        text = "\n".join(texts)
        formulas = FORMULA.findall(text)
        found = {_bare(name) for formula in formulas for name in NAME.findall(formula)}
        plain = FORMULA.sub(" ", text).lower()
        numbers = {*_typed(re.sub(INDEX, " ", text))}
        numbers |= {Fraction(k) for k, word in enumerate(NUMERALS, 2) if re.search(rf"\b{word}\b", plain)}
        dense = _bare(text).replace("$", "")
        return cls(frozenset(found), frozenset(numbers), _bare(" ".join(formulas)), dense, plain)

    def says(self, datum: Datum) -> bool:
        """Whether all of a datum stands here."""
        trees = [*datum.trees()]
        matrices = _matrices(trees)
        wanted = {name for tree in trees for name in free_symbols(tree) - datum.ours}
        values = {value for tree in trees for value in _numbers(tree)} if not matrices else set()
        return (
            bool(wanted or values or datum.words or matrices)
            and all(map(self._has_name, wanted))
            and values <= self.numbers
            and all(map(self._has_word, datum.words))
            and all(map(self._has, matrices))
            and all(map(self._has_column, trees))
        )

    def _has_name(self, name: str) -> bool:
        written = _bare(name_latex(name.removesuffix("*")))
        every = EVERY.sub("i", written)
        axis = written in AXES and any(other.startswith(f"{written}_") for other in self.names)
        return axis or written in self.names or every in self.names - {written}

    def _has_word(self, alternatives: str) -> bool:
        return re.search(rf"\b(?:{alternatives})", self.plain, re.IGNORECASE) is not None

    def _has(self, matrix: Matrix) -> bool:
        """Whether it stands there, or with a common denominator in front."""
        return any(
            _bare(Printer(Notation()).write(each)) in self.formulas for each in (matrix, *self._whole(matrix))
        )

    def _has_column(self, tree: Expr) -> bool:
        """Whether its entries stand side by side, if it is a column with numbers in it."""
        tree = tree.value if isinstance(tree, Measured) else tree
        if not isinstance(tree, Matrix) or tree.shape[1] > 1:
            return True
        if not any(rational(entry) for (entry,) in tree.rows):
            return True
        written = Printer(Notation(), in_line=True).write(tree).removesuffix("^T")
        return _bare(written).strip("()") in self.dense

    def _whole(self, matrix: Matrix) -> Iterator[Expr]:
        """A matrix of fractions without their common denominator, if that stands in the text."""
        values = [rational(entry) for row in matrix.rows for entry in row]
        common = lcm(*(1 if value is None else value.denominator for value in values))
        if common > 1 and common in self.numbers and None not in values:
            yield rebuild(matrix, lambda entry: number(common * (rational(entry) or 0)))


def _bare(latex: str) -> str:
    """Without blanks and braces."""
    return BLANKS.sub("", latex)


def _numbers(tree: Expr) -> Iterator[Fraction]:
    tree = tree.value if isinstance(tree, Measured) else tree
    for node in walk(tree):
        match node:
            case Number(Fraction(numerator=above, denominator=below), False) if (
                below > 1 and node is not tree
            ):
                yield from {Fraction(abs(above)), Fraction(below)} - {1}  # it may stand in a longer fraction
            case Number(value) | Degrees(value) if value and (node is tree or value not in UNITS):
                yield value if node is tree else abs(value)
            case Approximate(value):
                yield abs(Fraction(value))


def _typed(text: str) -> Iterator[Fraction]:
    """The numbers that are typed in digits, in SI units, and fractions of them."""
    for digits, unit in NUMBER.findall(text):
        size = abs(Fraction(digits.replace("−", "-")))
        signs = (1, -1) if digits[0] in "-−" else (1,)
        yield from (sign * size for sign in signs)
        if unit:
            yield from (sign * size / SIZES[unit] for sign in signs)
    for above, below, top, bottom in FRACTION.findall(text):
        if divisor := int(below or bottom):
            yield Fraction(int(above or top), divisor)


def _matrices(trees: Iterable[Expr]) -> list[Matrix]:
    """Those of several columns; a column is as good as its entries."""
    return [tree for tree in trees if isinstance(tree, Matrix) and tree.shape[1] > 1]
