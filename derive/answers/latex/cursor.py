"""A place in the tokens of an answer, and how it moves on."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from derive.algebra.formulas.quantities import Quantity
from derive.answers.latex.letters import GREEK_NAMES, Letters, squeeze
from derive.answers.latex.tokens import Token
from derive.errors import FormulaError
from derive.expression import Number

OPENING = {"(": ")", "[": "]"}


class Cursor:
    """The tokens of one answer and the place of the next one."""

    def __init__(self, found: Sequence[Token], letters: Letters, tight: bool = False) -> None:
        self.tokens = list(found)
        self.letters = letters
        self.tight = tight  # a/b c is read as a/(b c)
        self.either = False  # whether there was such a quotient
        self.at = 0
        self.depth = 0
        self.bars = 0
        self.entries = 0

    @property
    def next(self) -> Token:
        return self.tokens[self.at]

    def take(self) -> Token:
        self.at += 1
        return self.tokens[self.at - 1]

    def close(self, opened: Token, closing: str) -> None:
        if self.next.text != closing:
            if self.next.kind == "end":
                raise FormulaError(f"this {opened.text} is never closed", opened.offset)
            raise self.unexpected()
        self.take()

    def first_digit(self, token: Token) -> Quantity:
        """TeX takes one digit: \\frac12 is a half, x^23 is x^2 times 3."""
        rest = Token("number", token.text[1:], token.offset + 1, token.end)
        self.tokens[self.at] = rest
        return Quantity(Number(Fraction(token.text[0])))

    def skip_group(self) -> None:
        """Past a group in braces, or one token."""
        depth = 0
        while True:
            token = self.take()
            depth += (token.text == "{") - (token.text == "}")
            if depth <= 0 or token.kind == "end":
                return

    def ahead(self, count: int) -> tuple[str, ...]:
        """The texts of the next tokens."""
        return tuple(token.text for token in self.tokens[self.at : self.at + count])

    def starts_angle(self) -> bool:
        return self.next.kind == "command" and squeeze(self.next.text) in GREEK_NAMES

    def unexpected(self, hint: str = "") -> FormulaError:
        token = self.next
        if token.kind == "end":
            return FormulaError("the answer ends too early", token.offset, hint)
        written = f"\\{token.text}" if token.kind == "command" else token.text
        return FormulaError(f"'{written}' cannot stand here", token.offset, hint)
