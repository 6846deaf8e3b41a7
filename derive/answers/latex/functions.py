"""Functions in published LaTeX, with parentheses or without, and which of what follows is their argument."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

from derive.algebra.formulas.cursor import Cursor
from derive.algebra.formulas.quantities import (
    Quantity,
    called,
    divided,
    multiplied,
    negated,
    raised,
    rational,
)
from derive.algebra.formulas.tokens import Token
from derive.answers.latex.names import FUNCTIONS, is_greek
from derive.answers.latex.scripts import group_text, skip_group
from derive.errors import FormulaError
from derive.expression import Degrees, Expr, Number, Symbol

INVERSES = {"cos": "acos", "sin": "asin", "tan": "atan"}
RECIPROCALS = {"sec": "cos", "csc": "sin", "cot": "tan"}
ONE = Quantity(Number(Fraction(1)))
TWO_ARGUMENTS = "atan2 takes two arguments"


class Grammar(Protocol):
    """What the arguments of a function are read by."""

    def sum(self) -> Quantity:
        """Terms with their signs."""

    def factor(self) -> Quantity:
        """A group, a name or a number with its powers."""

    def atom(self) -> Quantity:
        """The same without powers."""

    def argument_group(self) -> Quantity:
        """What stands in braces, or one digit or letter without them."""

    def starts(self) -> bool:
        """Whether a factor begins here."""


@dataclass(frozen=True, slots=True)
class Functions:
    """Reads a function whose name has been read; `xy` says that Atan2 has x first."""

    cursor: Cursor
    grammar: Grammar
    xy: bool
    printed: bool = False

    def read(self, name: str, token: Token) -> Quantity:
        """A function of what follows; cos^2 x is a square, cos^{-1} x the inverse. Raises FormulaError."""
        cursor = self.cursor
        function, exponent = FUNCTIONS.get(name, name), None
        if cursor.next.text == "^":
            cursor.take()
            exponent = self.grammar.argument_group()
        if function == "atan" and cursor.next.text == "_" and group_text(cursor.tokens, cursor.at + 1) == "2":
            function = "atan2"  # as SymPy prints it
            cursor.take()
            skip_group(cursor)
        if function == "atan2":
            return self._atan2(name, token)
        argument = self._argument()
        if exponent is not None and rational(exponent.expr) == -1 and function in INVERSES:
            return called(INVERSES[function], (argument,), token.offset)
        value = called(RECIPROCALS.get(function, function), (argument,), token.offset)
        if function in RECIPROCALS:
            value = divided(ONE, value, token.offset)
        return value if exponent is None else raised(value, exponent, token.offset)

    def _atan2(self, name: str, token: Token) -> Quantity:
        """With its arguments in parentheses, which SymPy's printer puts in braces."""
        cursor = self.cursor
        if cursor.ahead(2) in (("{", "("), ("{", "[")):
            braced = cursor.take()
            found = self._atan2(name, token)
            cursor.close(braced, "}")
            return found
        opened = cursor.next
        if opened.text not in ("(", "["):
            raise FormulaError(TWO_ARGUMENTS, token.offset, "write atan2(y, x)")
        cursor.take()
        first = self.grammar.sum()
        if cursor.next.text != ",":
            raise FormulaError(TWO_ARGUMENTS, token.offset, "write atan2(y, x)")
        cursor.take()
        second = self.grammar.sum()
        cursor.close(opened, ")" if opened.text == "(" else "]")
        y, x = (second, first) if self.xy and name != "atan2" else (first, second)
        return called("atan2", (y, x), token.offset)

    def _argument(self) -> Quantity:
        """What a function applies to: a group, or numbers and one name."""
        token, grammar = self.cursor.next, self.grammar
        if token.kind == "sign" and token.text in "([{|":
            return grammar.atom()
        if token.kind == "sign" and token.text == "-":
            self.cursor.take()
            return negated(self._argument())
        if not grammar.starts():
            raise self.cursor.unexpected("a function needs its argument")
        total = grammar.factor()
        if self.printed:
            return total
        while rational(total.expr) is not None and not isinstance(total.expr, Degrees) and grammar.starts():
            following = self.cursor.next
            if following.kind not in ("name", "command") or following.text in FUNCTIONS:
                return total
            total = multiplied(total, grammar.factor(), token.offset)
        if self._belongs(total.expr):
            total = multiplied(total, grammar.factor(), token.offset)
        return total

    def _belongs(self, angle: Expr) -> bool:
        """Whether the next name is part of the angle still: omega t, n theta."""
        if not isinstance(angle, Symbol):
            return False
        token, *after = self.cursor.ahead(2)
        time = self.cursor.next.kind == "name" and token == "t" and after not in (["_"], ["^"])
        return time or (len(angle.name) == 1 and is_greek(self.cursor.next))
