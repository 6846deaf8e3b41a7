"""Published LaTeX read into trees: a small grammar of its own, and nothing is ever run.

Products are written side by side, so letters stand alone unless the problem has the whole word as a name:
`m g L_c c_{12}` has four factors. A function without parentheses takes numbers and one name, as books do:
`\\sin\\theta_2 \\dot\\theta_1` is a product. What stands around a formula is read elsewhere (`statements`).

`a / b c` is a/(b c) to many an author and to SymPy's printer, and (a/b) c by the rules of arithmetic: there
both readings are given.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from derive.algebra.formulas.quantities import (
    Quantity,
    called,
    divided,
    multiplied,
    negated,
    raised,
    rational,
    summed,
)
from derive.answers.latex.cursor import OPENING
from derive.answers.latex.functions import RECIPROCALS, FunctionReader
from derive.answers.latex.letters import Letters
from derive.answers.latex.matrices import MAX_ENTRIES, require_commas
from derive.answers.latex.names import FUNCTIONS
from derive.answers.latex.rates import rate_at
from derive.answers.latex.scripts import FONTS, group_text
from derive.answers.latex.tokens import Token
from derive.errors import FormulaError
from derive.expression import PI, Degrees, Expr, Matrix, Number, Symbol

MAX_NESTING = 40
NUMBERED = "could be a factor or the number of the equation"
ALONE = "write the answer alone"
TRANSPOSED = ("T", "top", "intercal", "t")
NO_FACTORS = frozenset(("end", "rvert", "circ", "degree", "cdot", "times", "div", "pm", "mp", "over"))
FRACTIONS = ("frac", "dfrac", "tfrac", "cfrac")
RELATIONS = frozenset(
    {"ne", "neq", "le", "leq", "ge", "geq", "lt", "gt", "to"}
    | {"propto", "forall", "dots", "ldots", "cdots", "vdots", "ddots"}
)


def read_latex(found: Sequence[Token], letters: Letters) -> tuple[Expr, Expr | None]:
    """The scalar or the matrix that tokens stand for (an end token last), and where a quotient can be read in
    two ways the other reading. Raises FormulaError."""
    try:
        parser = _Parser(found, letters)
        tree = parser.whole()
        return tree, _Parser(found, letters, tight=True).whole() if parser.either else None
    except RecursionError as error:
        raise FormulaError("the answer is nested too deeply", 0) from error


class _Parser(FunctionReader):
    """One pass over the tokens of one answer."""

    def nested(self, found: tuple[Token, ...]) -> Expr:
        """An expression of its own, as in an index."""
        return _Parser(found, self.letters, self.tight).whole()

    def whole(self) -> Expr:
        """All of the tokens."""
        found = self.sum()
        if self.next.kind != "end":
            raise self.unexpected()
        return found.expr

    # -- sums, products, powers -------------------------------------------------------------------

    def sum(self) -> Quantity:
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise FormulaError("the answer is nested too deeply", self.next.offset)
        total = self.signed_product()
        while self.next.kind == "sign" and self.next.text in "+-":
            sign = self.take()
            term = self.product()
            total = summed(total, negated(term) if sign.text == "-" else term, sign.offset)
        self.depth -= 1
        return total

    def signed_product(self) -> Quantity:
        if self.next.kind == "sign" and self.next.text in "+-":
            sign = self.take()
            found = self.signed_product() if self.next.text in ("+", "-") else self.product()
            return negated(found) if sign.text == "-" else found
        return self.product()

    def product(self) -> Quantity:
        total = self.factor()
        while True:
            token = self.next
            if token.text in ("*", "cdot", "times") and token.kind in ("sign", "command"):
                self.take()
                total = multiplied(total, self.after_sign(), token.offset)
            elif token.text in ("/", "div") and token.kind in ("sign", "command"):
                self.take()
                total = divided(total, self.divisor(total), token.offset)
            elif self.is_number_of_equation():
                self.at += 3
            elif self.starts():
                total = multiplied(total, self.factor(), token.offset)
            else:
                return total

    def divisor(self, above: Quantity) -> Quantity:
        """What is divided by: a factor, or in the tight reading all that is written side by side. The half in
        1/2 m v^2 is a half to everybody."""
        below = self.after_sign()
        if self.starts() and (rational(above.expr) is None or rational(below.expr) is None):
            self.either = True
            while self.tight and self.starts():
                below = multiplied(below, self.factor(), self.next.offset)
        return below

    def is_number_of_equation(self) -> bool:
        """Whether a lone (1) ends the answer. Raises FormulaError for another number: a factor?"""
        opened, inside, closed = (*self.ahead(3), "", "", "")[:3]
        if (opened, closed) != ("(", ")") or self.tokens[self.at + 3].kind != "end" or not inside.isdigit():
            return False
        if inside != "1":
            hint = rf"write \tag{{{inside}}}, or {inside} in front"
            raise FormulaError(f"({inside}) {NUMBERED}", self.next.offset, hint)
        return True

    def after_sign(self) -> Quantity:
        """A factor after a written sign, which may have a sign of its own."""
        if self.next.kind == "sign" and self.next.text == "-":
            self.take()
            return negated(self.after_sign())
        return self.factor()

    def starts(self) -> bool:
        """Whether a factor begins here."""
        token = self.next
        if token.kind == "command":
            return token.text not in NO_FACTORS
        if token.kind == "sign":
            return token.text in "([{" or (token.text == "|" and not self.bars)
        return token.kind in ("number", "word")

    def factor(self) -> Quantity:
        return self.powers(self.atom())

    def powers(self, base: Quantity) -> Quantity:
        while True:
            token = self.next
            if token.kind == "command" and token.text in ("circ", "degree"):
                self.take()
                base = self.degrees(base, token)
            elif token.kind == "sign" and token.text == "^":
                self.take()
                base = self.power(base, token)
            else:
                return base

    def power(self, base: Quantity, sign: Token) -> Quantity:
        inner = group_text(self.tokens, self.at)
        if inner in ("circ", "degree"):
            self.skip_group()
            return self.degrees(base, sign)
        if inner in TRANSPOSED and isinstance(base.expr, Matrix):
            self.skip_group()
            columns = tuple(zip(*base.expr.rows, strict=True))
            return Quantity(Matrix(columns), None, False, base.terms)
        return raised(base, self.argument_group(), sign.offset)

    def degrees(self, base: Quantity, token: Token) -> Quantity:
        value = rational(base.expr)
        if value is None:
            raise FormulaError("only a number can be in degrees", token.offset)
        places = base.expr.places if isinstance(base.expr, Number) else 0
        return Quantity(Degrees(value, places), None)

    # -- atoms ------------------------------------------------------------------------------------

    def atom(self) -> Quantity:
        token = self.next
        match token.kind:
            case "number":
                self.take()
                places = len(token.text.partition(".")[2])
                return Quantity(Number(Fraction(token.text), places > 0, places=places))
            case "word":
                return self.word()
            case "command":
                return self.command()
            case "sign" if token.text in "([{":
                return self.enclosed()
            case "sign" if token.text == "|":
                return self.absolute("|")
        raise self.unexpected()

    def enclosed(self) -> Quantity:
        r"""What stands in parentheses or braces: {a \over b} is a quotient, (a, b) a column, turned too,
        [a, b; c, d] the rows of a program."""
        opened = self.take()
        found = self.sum()
        if self.next.text == "over" and opened.text == "{":
            over = self.take()
            found = divided(found, self.sum(), over.offset)
        rows = [[found]]
        while self.next.text in (",", ";") and opened.text != "{":
            rows += [[]] if self.take().text == ";" else []
            rows[-1].append(self.sum())
        if len(rows) > 1:
            require_commas(self.tokens[self.tokens.index(opened) + 1 : self.at])
        self.close(opened, {"{": "}"}.get(opened.text) or OPENING[opened.text])
        if len(rows) > 1 and any(len(row) > 1 for row in rows):
            return self.gathered(rows, opened)
        entries = [entry for row in rows for entry in row]
        return self.listed(entries) if len(entries) > 1 else found

    def listed(self, entries: list[Quantity]) -> Quantity:
        """A column of entries that are written side by side."""
        if self.next.text == "^" and group_text(self.tokens, self.at + 1) in TRANSPOSED:
            self.take()
            self.skip_group()
        self.entries += len(entries)
        if self.entries > MAX_ENTRIES:
            raise FormulaError(f"an answer has at most {MAX_ENTRIES} entries", self.next.offset)
        rows = tuple((entry.expr,) for entry in entries)
        return Quantity(Matrix(rows), None, False, sum(entry.terms for entry in entries))

    def absolute(self, closing: str) -> Quantity:
        opened = self.take()
        self.bars += 1
        found = self.sum()
        self.bars -= 1
        if self.next.text not in (closing, "rvert", "vert", "|"):
            raise FormulaError(f"this {opened.text} is never closed", opened.offset)
        self.take()
        return called("abs", (found,), opened.offset)

    def command(self) -> Quantity:
        token = self.next
        name = token.text
        if name in FRACTIONS:
            if rate := rate_at(self.tokens, self.at, self.letters):
                self.at = rate.end
                return self.moving(Symbol(rate.name))
            self.take()
            top, bottom = self.argument_group(), self.argument_group()
            return divided(top, bottom, token.offset)
        if name == "sqrt":
            return self.square_root()
        if name == "begin":
            return self.matrix()
        if name in ("lvert", "vert"):
            return self.absolute(name)
        if name == "pi":
            self.take()
            return Quantity(PI)
        if name in FUNCTIONS or name in RECIPROCALS:
            self.take()
            return self.function(name, token)
        if name in FONTS:
            return self.styled()
        if name in ("pm", "mp"):
            raise FormulaError(
                f"\\{name} stands for two answers", token.offset, "give each of them on its own"
            )
        if name in RELATIONS and not self.letters.find(name):
            raise FormulaError(f"\\{name} is no part of a formula", token.offset, ALONE)
        return self.named(self.scripted())

    def styled(self) -> Quantity:
        """A name in a font of its own: a function, \\mathrm{atan2}, or a letter."""
        token = self.tokens[self.at]
        inside = group_text(self.tokens, self.at + 1)
        if inside in FUNCTIONS or inside in RECIPROCALS:
            self.take()
            self.skip_group()
            return self.function(inside, token)
        return self.named(self.scripted())

    def argument_group(self) -> Quantity:
        """What stands in braces, or one digit or letter without them."""
        token = self.next
        if token.kind == "sign" and token.text == "{":
            return self.enclosed()
        if token.kind == "sign" and token.text == "-":
            self.take()
            return negated(self.argument_group())
        if token.kind == "number" and len(token.text) > 1 and token.text.isdigit():
            return self.first_digit(token)
        if token.kind == "end":
            raise self.unexpected()
        return self.atom()

    def square_root(self) -> Quantity:
        token = self.take()
        index = Fraction(2)
        if self.next.text == "[":
            index = rational(self.enclosed().expr) or Fraction(0)
            if index <= 0 or index.denominator != 1:
                raise FormulaError("the index of a root is a whole number", token.offset)
        inside = self.argument_group()
        if index == 2:
            return called("sqrt", (inside,), token.offset)
        return raised(inside, Quantity(Number(1 / index)), token.offset)
