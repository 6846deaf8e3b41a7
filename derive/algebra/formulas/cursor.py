"""A place among the tokens of a text, and how it moves on: of a formula as typed, and of published LaTeX."""

from __future__ import annotations

from collections.abc import Iterable

from derive.algebra.formulas.tokens import Token
from derive.errors import FormulaError, Unfit

MAX_NESTING = 40
OPERATORS = frozenset("+-*/^=")


class Cursor:
    """The tokens of one text, an end token last, and the place of the next one. Messages call the text
    `whole`, as "the formula", and advise `shorter` where it is nested too deeply."""

    def __init__(self, tokens: Iterable[Token], whole: str, shorter: str = "") -> None:
        self.tokens = list(tokens)
        self.whole = whole
        self.shorter = shorter
        self.at = 0
        self.depth = 0

    @property
    def next(self) -> Token:
        """The token that comes next; it stays there."""
        return self.tokens[self.at]

    @property
    def after(self) -> Token:
        """The token behind the next one, or the end."""
        return self.tokens[min(self.at + 1, len(self.tokens) - 1)]

    def take(self) -> Token:
        """The next token, with the cursor past it."""
        self.at += 1
        return self.tokens[self.at - 1]

    def ahead(self, count: int) -> tuple[str, ...]:
        """The texts of the next tokens, fewer than asked for near the end."""
        return tuple(token.text for token in self.tokens[self.at : self.at + count])

    def enter(self) -> None:
        """Begins a part of the text. Raises FormulaError where parts stand in too many others."""
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise Unfit(f"{self.whole} is nested too deeply", self.next.offset, self.shorter)

    def leave(self) -> None:
        """Ends the part that was entered last."""
        self.depth -= 1

    def close(self, opened: Token, closing: str, called: str = "", hint: str = "") -> None:
        """Takes the sign that ends what `opened` began. Raises FormulaError where another token stands."""
        if self.next.text == closing:
            self.take()
        elif self.next.kind == "end":
            raise FormulaError(f"this {called or opened.text} is never closed", opened.offset, hint)
        else:
            raise self.unexpected()

    def unexpected(self, hint: str = "") -> FormulaError:
        """The error for the next token, which cannot stand there."""
        token = self.next
        if token.kind == "end":
            before = self.tokens[self.at - 1].text if self.at else ""
            hint = hint or (f"write what stands behind the {before}" if before in OPERATORS else "")
            return FormulaError(f"{self.whole} ends too early", token.offset, hint)
        written = f"\\{token.text}" if token.kind == "command" else token.text
        return FormulaError(f"'{written}' cannot stand here", token.offset, hint)
