"""Functions in published LaTeX, with parentheses or without, and which of what follows is their argument."""

from __future__ import annotations

from abc import abstractmethod
from fractions import Fraction

from derive.algebra.formulas.quantities import (
    Quantity,
    called,
    divided,
    multiplied,
    negated,
    raised,
    rational,
)
from derive.answers.latex.cursor import OPENING
from derive.answers.latex.matrices import GridReader
from derive.answers.latex.names import FUNCTIONS
from derive.answers.latex.scripts import group_text
from derive.answers.latex.tokens import Token
from derive.errors import FormulaError
from derive.expression import Degrees, Expr, Number, Symbol

INVERSES = {"cos": "acos", "sin": "asin", "tan": "atan"}
RECIPROCALS = {"sec": "cos", "csc": "sin", "cot": "tan"}


class FunctionReader(GridReader):
    """Reads a function whose name has been read."""

    @abstractmethod
    def atom(self) -> Quantity:
        """A group, a name or a number."""

    @abstractmethod
    def factor(self) -> Quantity:
        """The same with its powers."""

    @abstractmethod
    def starts(self) -> bool:
        """Whether a factor begins here."""

    def function(self, name: str, token: Token) -> Quantity:
        """A function of what follows; cos^2 x is a square, cos^{-1} x the inverse."""
        function, exponent = FUNCTIONS.get(name, name), None
        if self.next.kind == "sign" and self.next.text == "^":
            self.take()
            exponent = self.argument_group()
        if function == "atan" and self.next.text == "_" and group_text(self.tokens, self.at + 1) == "2":
            function = "atan2"  # as SymPy prints it
            self.take()
            self.skip_group()
        if function == "atan2":
            return self.atan2(name, token)
        argument = self.argument()
        if exponent is not None and rational(exponent.expr) == -1 and function in INVERSES:
            return called(INVERSES[function], (argument,), token.offset)
        if function in RECIPROCALS:
            value = divided(
                Quantity(Number(Fraction(1))),
                called(RECIPROCALS[function], (argument,), token.offset),
                token.offset,
            )
        else:
            value = called(function, (argument,), token.offset)
        return value if exponent is None else raised(value, exponent, token.offset)

    def atan2(self, name: str, token: Token) -> Quantity:
        """With its arguments in parentheses, which SymPy's printer puts in braces."""
        if self.ahead(2) in (("{", "("), ("{", "[")):
            braced = self.take()
            found = self.atan2(name, token)
            self.close(braced, "}")
            return found
        opened = self.next
        if opened.text not in OPENING:
            raise FormulaError("atan2 takes two arguments", token.offset, "write atan2(y, x)")
        self.take()
        first = self.sum()
        if self.next.text != ",":
            raise FormulaError("atan2 takes two arguments", token.offset, "write atan2(y, x)")
        self.take()
        second = self.sum()
        self.close(opened, OPENING[opened.text])
        y, x = (second, first) if self.letters.xy and name != "atan2" else (first, second)
        return called("atan2", (y, x), token.offset)

    def argument(self) -> Quantity:
        """What a function applies to: a group, or numbers and one name."""
        token = self.next
        if token.kind == "sign" and token.text in "([{|":
            return self.atom()
        if token.kind == "sign" and token.text == "-":
            self.take()
            return negated(self.argument())
        if not self.starts():
            raise self.unexpected("a function needs its argument")
        total = self.factor()
        while rational(total.expr) is not None and not isinstance(total.expr, Degrees) and self.starts():
            if self.next.kind not in ("word", "command") or self.next.text in FUNCTIONS:
                return total
            total = multiplied(total, self.factor(), token.offset)
        if self.belongs(total.expr):
            total = multiplied(total, self.factor(), token.offset)
        return total

    def belongs(self, angle: Expr) -> bool:
        """Whether the next name is part of the angle still: omega t, n theta."""
        token = self.next
        if not isinstance(angle, Symbol):
            return False
        after = self.tokens[min(self.at + 1, len(self.tokens) - 1)].text
        time = token.kind == "word" and token.text == "t" and after not in ("_", "^")
        return time or (len(angle.name) == 1 and self.starts_angle())
