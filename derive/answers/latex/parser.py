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

from derive.algebra.formulas.cursor import Cursor
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
from derive.algebra.formulas.tokens import Token
from derive.answers.latex.functions import RECIPROCALS, Functions
from derive.answers.latex.letters import Letters
from derive.answers.latex.matrices import TRANSPOSED, Matrices
from derive.answers.latex.names import FUNCTIONS, Names
from derive.answers.latex.rates import derivative_at, rate_at
from derive.answers.latex.scripts import FONTS, Tokens, group_text, skip_group
from derive.errors import FormulaError, Unfit
from derive.expression import PI, Call, Degrees, Expr, Matrix, Number, Symbol, factors_of

NUMBERED = "could be a factor or the number of the equation"
ALONE = "write the answer alone"
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
        two = parser.either and not letters.printed  # ours is read as TeX sets it
        return tree, _Parser(found, letters, tight=True).whole() if two else None
    except RecursionError as error:
        raise Unfit("the answer is nested too deeply", 0) from error


class _Parser:
    """One pass over the tokens of one answer. `tight` reads a/b c as a/(b c); `either` tells whether there
    was such a quotient."""

    def __init__(self, found: Sequence[Token], letters: Letters, tight: bool = False) -> None:
        self.cursor = Cursor(found, "the answer")
        self.letters = letters
        self.tight = tight
        self.either = False
        self.bars = 0
        self.between = ("*", "cdot") if letters.printed else ("*", "cdot", "times")
        self.names = Names(self.cursor, letters, self._nested)
        self.functions = Functions(self.cursor, self, letters.xy, letters.printed)
        self.matrices = Matrices(self.cursor, self.sum)

    def _nested(self, found: Tokens) -> Expr:
        return _Parser(found, self.letters, self.tight).whole()

    def whole(self) -> Expr:
        """All of the tokens."""
        found = self.sum()
        if self.cursor.next.kind != "end":
            raise self.cursor.unexpected()
        return found.expr

    # -- sums, products, powers -------------------------------------------------------------------

    def sum(self) -> Quantity:
        self.cursor.enter()
        total = self.signed_product()
        while self.cursor.next.kind == "sign" and self.cursor.next.text in "+-":
            sign = self.cursor.take()
            term = self.term()
            total = summed(total, negated(term) if sign.text == "-" else term, sign.offset)
        self.cursor.leave()
        return total

    def signed_product(self) -> Quantity:
        if self.cursor.next.kind == "sign" and self.cursor.next.text in "+-":
            sign = self.cursor.take()
            found = self.signed_product() if self.cursor.next.text in ("+", "-") else self.term()
            return negated(found) if sign.text == "-" else found
        return self.term()

    def term(self) -> Quantity:
        """A product, or on our page the vector product of several."""
        found, at = [self.product()], self.cursor.next.offset
        while self.cursor.next.text == "times" and self.letters.printed:
            self.cursor.take()
            found.append(self.product())
        return found[0] if len(found) == 1 else called("cross", tuple(found), at)

    def product(self) -> Quantity:
        total = self.factor()
        while True:
            token = self.cursor.next
            if token.text in self.between and token.kind in ("sign", "command"):
                self.cursor.take()
                total = multiplied(total, self.after_sign(), token.offset)
            elif token.text in ("/", "div") and token.kind in ("sign", "command"):
                self.cursor.take()
                total = divided(total, self.divisor(total), token.offset)
            elif not self.letters.printed and self.is_number_of_equation():
                self.cursor.at += 3
            elif self.starts():
                self.require_apart(total)
                total = multiplied(total, self.factor(), token.offset)
            else:
                return total

    def require_apart(self, before: Quantity) -> None:
        """Raises FormulaError on our page where a number stands beside a number: 2 3, or 2 and a half."""
        last = factors_of(before.expr)[-1]
        number = self.cursor.next.kind == "number" or self.cursor.next.text in FRACTIONS
        if self.letters.printed and number and isinstance(last, Number):
            raise FormulaError("two numbers stand side by side", self.cursor.next.offset)

    def divisor(self, above: Quantity) -> Quantity:
        """What is divided by: a factor, or in the tight reading all that is written side by side. The half in
        1/2 m v^2 is a half to everybody."""
        below = self.after_sign()
        if self.starts() and (rational(above.expr) is None or rational(below.expr) is None):
            self.either = True
            while self.tight and self.starts():
                below = multiplied(below, self.factor(), self.cursor.next.offset)
        return below

    def is_number_of_equation(self) -> bool:
        """Whether a lone (1) ends the answer. Raises FormulaError for another number: a factor?"""
        opened, inside, *after = (*self.cursor.ahead(4), "", "")
        if opened != "(" or after[:2] != [")", ""] or not inside.isdigit():
            return False
        if inside != "1":
            hint = rf"write \tag{{{inside}}}, or {inside} in front"
            raise FormulaError(f"({inside}) {NUMBERED}", self.cursor.next.offset, hint)
        return True

    def after_sign(self) -> Quantity:
        """A factor after a written sign, which may have a sign of its own."""
        if self.cursor.next.kind == "sign" and self.cursor.next.text == "-":
            self.cursor.take()
            return negated(self.after_sign())
        return self.factor()

    def starts(self) -> bool:
        """Whether a factor begins here."""
        token = self.cursor.next
        if token.kind == "command":
            return token.text not in NO_FACTORS
        if token.kind == "sign":
            return token.text in "([{" or (token.text == "|" and not self.bars)
        return token.kind in ("number", "name")

    def factor(self) -> Quantity:
        return self.powers(self.atom())

    def powers(self, base: Quantity) -> Quantity:
        while True:
            token = self.cursor.next
            if token.kind == "command" and token.text in ("circ", "degree"):
                self.cursor.take()
                base = self.degrees(base, token)
            elif token.kind == "sign" and token.text == "^":
                self.cursor.take()
                base = self.power(base, token)
            else:
                return base

    def power(self, base: Quantity, sign: Token) -> Quantity:
        inner = group_text(self.cursor.tokens, self.cursor.at)
        if inner in ("circ", "degree"):
            skip_group(self.cursor)
            return self.degrees(base, sign)
        if inner == "T" and self.letters.turned:
            skip_group(self.cursor)
            return Quantity(Call("transpose", (base.expr,)), None, False, base.terms)
        if inner in TRANSPOSED and isinstance(base.expr, Matrix):
            skip_group(self.cursor)
            return Quantity(base.expr.T, None, False, base.terms)
        return raised(base, self.argument_group(), sign.offset)

    def degrees(self, base: Quantity, token: Token) -> Quantity:
        if isinstance(base.expr, Matrix):
            rows = tuple(tuple(self._in_degrees(each, token) for each in row) for row in base.expr.rows)
            return Quantity(Matrix(rows), None, False, base.terms)
        return Quantity(self._in_degrees(base.expr, token), None)

    def _in_degrees(self, expr: Expr, token: Token) -> Expr:
        value = rational(expr)
        if value is None:
            raise FormulaError("only numbers can be in degrees", token.offset)
        return Degrees(value, expr.places if isinstance(expr, Number) else 0)

    # -- atoms ------------------------------------------------------------------------------------

    def atom(self) -> Quantity:
        token = self.cursor.next
        match token.kind:
            case "number":
                self.cursor.take()
                if self.cursor.next.text == "_":
                    return self.block(token)
                places = len(token.text.partition(".")[2])
                return Quantity(Number(Fraction(token.text), places > 0, places=places))
            case "name":
                if self.names.is_function():
                    self.cursor.take()
                    return self.functions.read(token.text, token)
                self.names.part()
                return self.name()
            case "command":
                return self.command()
            case "sign" if token.text in "([{":
                return self.enclosed()
            case "sign" if token.text == "|":
                return self.absolute("|")
        raise self.cursor.unexpected()

    def enclosed(self) -> Quantity:
        r"""What stands in parentheses or braces: {a \over b} is a quotient, (a, b) a column."""
        opened = self.cursor.take()
        found = self.sum()
        if opened.text == "[" and self.letters.printed:
            self.cursor.close(opened, "]")
            return called("bracket", (found,), opened.offset)
        if opened.text != "{":
            return self.matrices.listed(found, opened)
        if self.cursor.next.text == "over":
            over = self.cursor.take()
            found = divided(found, self.sum(), over.offset)
        self.cursor.close(opened, "}")
        return found

    def absolute(self, closing: str) -> Quantity:
        opened = self.cursor.take()
        self.bars += 1
        found = self.sum()
        self.bars -= 1
        if self.cursor.next.text not in (closing, "rvert", "vert", "|"):
            raise FormulaError(f"this {opened.text} is never closed", opened.offset)
        self.cursor.take()
        return called("abs", (found,), opened.offset)

    def name(self) -> Quantity:
        """What a letter with its scripts stands for, a function of what follows with its argument."""
        token, found = self.cursor.next, self.names.read()
        if (
            isinstance(found, Symbol)
            and found.name in self.letters.functions
            and self.cursor.next.text == "("
        ):
            return called(found.name, self.listed(), token.offset)
        if not isinstance(found, str):
            return Quantity(found, None, numeric=False)
        if found != "exp":
            return self.functions.read(found, token)
        self.cursor.take()
        return called("exp", (self.argument_group(),), token.offset)

    def block(self, zero: Token) -> Quantity:
        r"""A block named by its number and its shape, 0_{3 \times 3}."""
        self.cursor.take()
        name = f"{zero.text}_{group_text(self.cursor.tokens, self.cursor.at)}"
        if not self.letters.find(name):
            raise self.letters.unknown(name, zero.offset)
        skip_group(self.cursor)
        return Quantity(Symbol(self.letters.find(name)), None, numeric=False)

    def listed(self) -> tuple[Quantity, ...]:
        """The arguments of a function, in parentheses."""
        opened = self.cursor.take()
        found = [self.sum()]
        while self.cursor.next.text == ",":
            self.cursor.take()
            found.append(self.sum())
        self.cursor.close(opened, ")")
        return tuple(found)

    def command(self) -> Quantity:
        token = self.cursor.next
        name = token.text
        if name in FRACTIONS:
            if derived := derivative_at(self.cursor.tokens, self.cursor.at, self.letters):
                self.cursor.at = derived.end
                of = self.atom().expr if derived.of is None else self._nested(derived.of)
                return Quantity(derived.applied(of, self._nested), None, numeric=False)
            if rate := rate_at(self.cursor.tokens, self.cursor.at, self.letters):
                self.cursor.at = rate.end
                return Quantity(self.names.moving(Symbol(rate.name)), None, numeric=False)
            self.cursor.take()
            top, bottom = self.argument_group(), self.argument_group()
            return divided(top, bottom, token.offset)
        if name == "sqrt":
            return self.square_root()
        if name == "begin":
            return self.matrices.environment()
        if name in ("lvert", "vert"):
            return self.absolute(name)
        if name == "pi":
            self.cursor.take()
            return Quantity(PI)
        if name in FUNCTIONS or name in RECIPROCALS:
            self.cursor.take()
            return self.functions.read(name, token)
        if name in FONTS:
            return self.styled()
        if name in ("pm", "mp"):
            raise FormulaError(
                f"\\{name} stands for two answers", token.offset, "give each of them on its own"
            )
        if name in RELATIONS and not self.letters.find(name):
            raise FormulaError(f"\\{name} is no part of a formula", token.offset, ALONE)
        return self.name()

    def styled(self) -> Quantity:
        """A name in a font of its own: a function, \\mathrm{atan2}, or a letter."""
        token = self.cursor.tokens[self.cursor.at]
        inside = group_text(self.cursor.tokens, self.cursor.at + 1)
        if inside in FUNCTIONS or inside in RECIPROCALS:
            self.cursor.take()
            skip_group(self.cursor)
            return self.functions.read(inside, token)
        return self.name()

    def argument_group(self) -> Quantity:
        """What stands in braces, or one digit or letter without them."""
        token = self.cursor.next
        if token.kind == "sign" and token.text == "{":
            return self.enclosed()
        if token.kind == "sign" and token.text == "-":
            self.cursor.take()
            return negated(self.argument_group())
        if token.kind == "number" and len(token.text) > 1 and token.text.isdigit():
            return self.first_digit()
        if token.kind == "end":
            raise self.cursor.unexpected()
        return self.atom()

    def first_digit(self) -> Quantity:
        r"""TeX takes one digit: \frac12 is a half, x^23 is x^2 times 3."""
        token = self.cursor.next
        rest = Token("number", token.text[1:], token.offset + 1, token.end)
        self.cursor.tokens[self.cursor.at] = rest
        return Quantity(Number(Fraction(token.text[0])))

    def square_root(self) -> Quantity:
        token = self.cursor.take()
        index = Fraction(2)
        if self.cursor.next.text == "[":
            index = rational(self.enclosed().expr) or Fraction(0)
            if index <= 0 or index.denominator != 1:
                raise FormulaError("the index of a root is a whole number", token.offset)
        inside = self.argument_group()
        if index == 2:
            return called("sqrt", (inside,), token.offset)
        return raised(inside, Quantity(Number(1 / index)), token.offset)
