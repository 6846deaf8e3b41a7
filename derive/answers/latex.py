"""Published LaTeX read into trees: a small grammar of its own, and nothing is ever run.

Products are written side by side, so letters stand alone unless the problem has the whole word as a name:
`m g L_c c_{12}` has four factors. A function without parentheses takes numbers and one name, as books do:
`\\sin\\theta_2 \\dot\\theta_1` is a product. A chain a = b = c stands for its last part.
"""

from __future__ import annotations

from fractions import Fraction

from derive.algebra.quantities import (
    Quantity,
    called,
    divided,
    multiplied,
    negated,
    raised,
    rational,
    summed,
)
from derive.answers.letters import GREEK_NAMES, Letters
from derive.answers.scripts import FONTS, Scripted, group_text, scripted, subscripts_first
from derive.answers.tokens import Kind, Token, tokens
from derive.errors import FormulaError
from derive.expression import PI, Call, Degrees, Expr, Matrix, Number, Sum, Symbol, negate

MAX_NESTING = 40
MAX_ENTRIES = 400
FUNCTIONS = {
    "cos": "cos", "sin": "sin", "tan": "tan", "arccos": "acos", "arcsin": "asin", "arctan": "atan",
    "acos": "acos", "asin": "asin", "atan": "atan", "exp": "exp", "ln": "log", "log": "log", "sgn": "sign",
    "sign": "sign", "sqrt": "sqrt", "abs": "abs", "atan2": "atan2", "Atan2": "atan2", "arctan2": "atan2",
    "ATAN2": "atan2",
}  # fmt: skip
INVERSES = {"cos": "acos", "sin": "asin", "tan": "atan"}
RECIPROCALS = {"sec": "cos", "csc": "sin", "cot": "tan"}
FRACTIONS = ("frac", "dfrac", "tfrac", "cfrac")
MATRICES = ("matrix", "bmatrix", "pmatrix", "Bmatrix", "smallmatrix", "array")
OPENING = {"(": ")", "[": "]"}


def read_latex(text: str, letters: Letters) -> Expr:
    """The scalar or the matrix a LaTeX text stands for. Raises FormulaError."""
    return _Parser(subscripts_first(tokens(text)), letters).whole()


class _Parser:
    """One pass over the tokens of one answer."""

    def __init__(self, found: tuple[Token, ...], letters: Letters) -> None:
        self.tokens = found
        self.letters = letters
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

    def whole(self) -> Expr:
        """All of the text; of a chain of equations its last part."""
        equals = [place for place, token in enumerate(self.tokens) if token.text == "="]
        self.at = equals[-1] + 1 if equals else 0
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
                total = divided(total, self.after_sign(), token.offset)
            elif self.starts():
                total = multiplied(total, self.factor(), token.offset)
            else:
                return total

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
            return token.text not in ("end", "rvert", "circ", "degree", "cdot", "times", "div", "pm", "mp")
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
        if inner in ("T", "top", "mathsfT", "mathrmT") and isinstance(base.expr, Matrix):
            self.skip_group()
            columns = tuple(zip(*base.expr.rows, strict=True))
            return Quantity(Matrix(columns), None, False, base.terms)
        return raised(base, self.argument_group(), sign.offset)

    def degrees(self, base: Quantity, token: Token) -> Quantity:
        value = rational(base.expr)
        if value is None:
            raise FormulaError("only a number can be in degrees", token.offset)
        return Quantity(Degrees(value), None)

    # -- atoms ------------------------------------------------------------------------------------

    def atom(self) -> Quantity:
        token = self.next
        match token.kind:
            case "number":
                self.take()
                return Quantity(Number(Fraction(token.text), "." in token.text))
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
        opened = self.take()
        found = self.sum()
        self.close(opened, {"{": "}"}.get(opened.text) or OPENING[opened.text])
        return found

    def close(self, opened: Token, closing: str) -> None:
        if self.next.text != closing:
            if self.next.kind == "end":
                raise FormulaError(f"this {opened.text} is never closed", opened.offset)
            raise self.unexpected()
        self.take()

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

    def first_digit(self, token: Token) -> Quantity:
        """TeX takes one digit: \\frac12 is a half, x^23 is x^2 times 3."""
        rest = Token("number", token.text[1:], token.offset + 1, token.end)
        self.tokens = (*self.tokens[: self.at], rest, *self.tokens[self.at + 1 :])
        return Quantity(Number(Fraction(token.text[0])))

    def skip_group(self) -> None:
        """Past a group in braces, or one token."""
        depth = 0
        while True:
            token = self.take()
            depth += (token.text == "{") - (token.text == "}")
            if depth <= 0 or token.kind == "end":
                return

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

    # -- names ------------------------------------------------------------------------------------

    def word(self) -> Quantity:
        """A name of the problem, or several letters side by side; the last of them may carry a subscript."""
        token = self.next
        follows = self.tokens[self.at + 1]
        if token.text in FUNCTIONS and follows.text in ("(", "{", "^") and not self.letters.find(token.text):
            self.take()
            return self.function(token.text, token)
        pieces = self.split(token)
        if len(pieces) > 1:
            parts = tuple(self.tokens[: self.at]) + tuple(pieces) + tuple(self.tokens[self.at + 1 :])
            self.tokens = parts
        return self.named(self.scripted())

    def split(self, token: Token) -> list[Token]:
        """The names in a word: the whole of it, or from the left the longest the problem knows."""
        subscript = self.tokens[self.at + 1].text == "_"
        whole = token.text
        if self.letters.find(whole) or (self.letters.abbreviated(whole) and not subscript):
            return [token]
        pieces: list[Token] = []
        at = 0
        while at < len(whole):
            end = next(
                (stop for stop in range(len(whole), at, -1) if self.letters.find(whole[at:stop])), at + 1
            )
            while end < len(whole) and whole[end].isdigit():
                end += 1
            pieces.append(Token("word", whole[at:end], token.offset + at, token.offset + end))
            at = end
        return pieces

    def scripted(self) -> Scripted:
        """The letter here with its scripts, the place still before it; of L_cs the script is c only."""
        found = scripted(self.tokens, self.at)
        under = found.lower_tokens[0] if found.lower_tokens else None
        bare = under and under.kind == "word" and len(under.text) > 1 and self.tokens[self.at + 2] is under
        if under is None or not bare or self.letters.find(found.plain) or self.letters.find(under.text):
            return found
        first = Token("word", under.text[0], under.offset, under.offset + 1)
        kind: Kind = "number" if under.text[1:].isdigit() else "word"
        rest = Token(kind, under.text[1:], under.offset + 1, under.end)
        self.tokens = (*self.tokens[: self.at + 2], first, rest, *self.tokens[self.at + 3 :])
        return scripted(self.tokens, self.at)

    def named(self, name: Scripted) -> Quantity:
        """The symbol, the sine or the cosine that a letter with its subscript stands for."""
        letters = self.letters
        if name.upper and (found := letters.find(f"{name.plain}^{name.upper}{name.accent}")):
            self.at = name.end
            return _symbol(found)
        self.at = name.power
        if found := letters.find(name.plain + name.accent):
            return _symbol(found)
        if (value := self.abbreviation(name)) is not None:
            return Quantity(value, None, numeric=False)
        if name.stem in ("c", "s") and not name.lower and self.starts_angle():
            return self.function({"c": "cos", "s": "sin"}[name.stem], self.next)
        if name.stem == "e" and name.upper:
            self.take()
            return called("exp", (self.argument_group(),), name.offset)
        raise letters.unknown(name.plain + name.accent, name.offset)

    def abbreviation(self, name: Scripted) -> Expr | None:
        """c_1, s_{12}, c_{1+2}, c_\\theta; \\theta_{12} for a sum of angles. None for any other name."""
        if name.accent:
            return None
        if name.stem in ("theta", "q") and name.lower.isdigit():
            return self.letters.summed(name.lower)
        function = {"c": "cos", "s": "sin", "C": "cos", "S": "sin"}.get(name.stem)
        if function is None or not name.lower:
            return self.letters.abbreviated(name.stem)
        angle = self.letters.angle(",".join(token.text for token in name.lower_tokens if token.text != ","))
        angle = angle or self.letters.angle(name.lower)
        if angle is None and name.lower.isdigit():
            raise FormulaError(f"there is no joint angle {name.lower}", name.offset)
        if angle is None:
            angle = self.inside(name.lower_tokens)
        return Call(function, (angle,))

    def inside(self, found: tuple[Token, ...]) -> Expr:
        """An index that is an angle of its own: 1+2, \\theta_1+\\theta_2, 2\\theta."""
        plain = [token for token in found if token.text not in "{}"]
        if any(token.text in ("+", "-") for token in plain) and all(
            token.kind == "number" or token.text in ("+", "-") for token in plain
        ):
            return self.joints(plain)
        end = Token("end", "", found[-1].end, found[-1].end)
        return _Parser((*found, end), self.letters).whole()

    def joints(self, found: list[Token]) -> Expr:
        terms, negative = [], False
        for token in found:
            if token.text in ("+", "-"):
                negative = token.text == "-"
                continue
            angle = self.letters.summed(token.text)
            if angle is None:
                raise FormulaError(f"there is no joint angle {token.text}", token.offset)
            terms.append(negate(angle) if negative else angle)
        return Sum(tuple(terms)) if len(terms) > 1 else terms[0]

    # -- functions --------------------------------------------------------------------------------

    def starts_angle(self) -> bool:
        return self.next.kind == "command" and self.next.text in GREEK_NAMES

    def function(self, name: str, token: Token) -> Quantity:
        """A function of what follows; cos^2 x is a square, cos^{-1} x the inverse."""
        function, exponent = FUNCTIONS.get(name, name), None
        if self.next.kind == "sign" and self.next.text == "^":
            self.take()
            exponent = self.argument_group()
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

    # -- matrices ---------------------------------------------------------------------------------

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
        rows = self.rows(opened)
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
            token = self.next
            if token.text == "&":
                self.take()
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

    def unexpected(self, hint: str = "") -> FormulaError:
        token = self.next
        if token.kind == "end":
            return FormulaError("the answer ends too early", token.offset, hint)
        written = f"\\{token.text}" if token.kind == "command" else token.text
        return FormulaError(f"'{written}' cannot stand here", token.offset, hint)


def _symbol(name: str) -> Quantity:
    return Quantity(Symbol(name), None, numeric=False)
