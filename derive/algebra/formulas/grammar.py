"""Formulas as an author types them, read into trees. Parsed, never evaluated as code.

A Pratt parser over a closed grammar: numbers, names, `+ - * / ^`, products with a blank, functions
of a short list, and units. Values come out in SI base units, exactly: `100 mm` is 1/10.

**When a letter is a unit.** `m`, `g`, `s`, `A`, `V`, `N`, `H` are also names of quantities, so a unit is
read only directly after a number (`0.1 m`, `100mm`, `(1/2) m`), only in a field that has a dimension (deg
and rad anywhere), and never where a name or a parenthesis follows: in `2 m L` and `1/2 m v^2` the m is a
symbol. A `*` always makes a symbol: `2*m`. Where the sheet declares the symbol m, `2 m` is still two
metres where a length is wanted and two masses elsewhere; where either could be meant it is an error.
"""

from __future__ import annotations

from functools import lru_cache

from derive.algebra.formulas.cursor import Cursor
from derive.algebra.formulas.functions import ARGUMENTS, TRIGONOMETRIC, meant, unknown_function
from derive.algebra.formulas.likely_mistakes import meant_unit
from derive.algebra.formulas.quantities import (
    Quantity,
    called,
    divided,
    ends_in_number,
    measured,
    multiplied,
    negated,
    raised,
    summed,
)
from derive.algebra.formulas.tokens import MAX_TEXT, Token, places_of, tokens, value_of
from derive.algebra.formulas.unit_phrases import Phrase, unit_phrase
from derive.algebra.formulas.units import OTHER_UNITS, UNITS, Wanted, agree, compound, spoken
from derive.errors import FormulaError
from derive.expression import PI, Expr, Number, Sum, Symbol, free_symbols, negate

NAME_A_PART = "name a part of it under 'where'"
SUM, PRODUCT, POWER = 10, 20, 30  # binding powers
REMEMBERED = 1000  # numbers and names, which a formula has again and again
BINDING = {"+": SUM, "-": SUM, "*": PRODUCT, "/": PRODUCT, "^": POWER}


def parse(
    text: str, *, dimension: Wanted = None, names: frozenset[str] = frozenset(), longest: int = MAX_TEXT
) -> Expr:
    """The tree of a formula, in SI base units. Raises FormulaError.

    `dimension` is what the field takes (see `units`); a value known to have another is an error, while
    plain numbers and symbols are allowed anywhere. `names` are the declared symbols.
    """
    return _Parser(text, dimension, names, longest=longest).whole()


def parse_starred(
    text: str, *, dimension: Wanted = None, names: frozenset[str] = frozenset()
) -> tuple[Expr, str | None]:
    """A formula in which a star may mark the joint variable, and the name of that variable.

    `theta2* + 90 deg` gives theta2 + 90 deg and "theta2". Raises FormulaError: also where two are
    marked, or where the variable is no term of its own (the joint would not move by it).
    """
    parser = _Parser(text, dimension, names, stars=True)
    expr = parser.whole()
    if len(parser.starred) > 1:
        raise FormulaError("two stars in one place", parser.starred[1].offset, "a joint has one variable")
    for star in parser.starred:
        if not _is_term(Symbol(star.text), expr):
            hint = f"write {star.text}* on its own or with an offset: {star.text}* + 90 deg"
            raise FormulaError(
                f"the joint variable {star.text}* must be a term of its own", star.offset, hint
            )
    return expr, parser.starred[0].text if parser.starred else None


def parse_equation(
    text: str, *, dimension: Wanted = None, names: frozenset[str] = frozenset()
) -> tuple[Expr, Expr]:
    """Both sides of `left = right`. Raises FormulaError."""
    parser = _Parser(text, dimension, names)
    left = parser.expression(0)
    if parser.cursor.next.text != "=":
        raise parser.cursor.unexpected(hint="an equation is written left = right")
    parser.cursor.take()
    if parser.cursor.next.text == "=":
        raise parser.cursor.unexpected(hint="an equation has one =")
    return left.expr, parser.whole()


def _is_term(variable: Symbol, expr: Expr) -> bool:
    """Whether the variable or its opposite is one term of a sum, and stands nowhere else in it."""
    terms = expr.terms if isinstance(expr, Sum) else (expr,)
    holders = [term for term in terms if variable.name in free_symbols(term)]
    return len(holders) == 1 and holders[0] in (variable, negate(variable))


@lru_cache(REMEMBERED)
def _number(text: str) -> Quantity:
    """A number as typed."""
    value, decimal = value_of(text)
    return Quantity(Number(value, decimal, places=places_of(text)))


@lru_cache(REMEMBERED)
def _symbol(name: str) -> Quantity:
    """A letter, or pi."""
    return Quantity(PI) if name == "pi" else Quantity(Symbol(name), None, numeric=False)


class _Parser:
    """One pass over the tokens of one formula."""

    def __init__(
        self,
        text: str,
        wanted: Wanted,
        names: frozenset[str],
        stars: bool = False,
        longest: int = MAX_TEXT,
    ) -> None:
        self.cursor = Cursor(tokens(text, longest), "the formula", NAME_A_PART)
        self.wanted = wanted
        self.units = wanted is not None
        self.names = names
        self.stars = stars
        self.starred: list[Token] = []
        self.phrase: Phrase | None = None  # the first unit read, for messages

    def whole(self) -> Expr:
        """The rest of the text as one formula of the wanted dimension."""
        found = self.expression(0)
        if self.cursor.next.kind != "end":
            raise self.cursor.unexpected(self._instead())
        if isinstance(self.wanted, tuple) and not agree(found.dimension or self.wanted, self.wanted):
            raise self._wrong_dimension(found, spoken(self.wanted))
        return found.expr

    def _instead(self) -> str:
        """What to write where a formula should have ended."""
        before = self.cursor.tokens[self.cursor.at - 1]
        match self.cursor.ahead(2):
            case ",", digits if before.kind == "number" and digits.isdigit():
                return f"write a decimal with a point: {before.text}.{digits}"
            case "=", *_:
                return "a formula is wanted here, no equation"
            case ")", *_:
                return "it closes no parenthesis"
        return ""

    def expression(self, binding: int) -> Quantity:
        """What binds tighter than `binding`, from here on."""
        self.cursor.enter()
        left = self._first(binding)
        while (longer := self._longer(left, binding)) is not None:
            left = longer
        self.cursor.leave()
        return left

    def _first(self, binding: int) -> Quantity:
        token = self.cursor.take()
        if token.kind == "name":
            return self._name(token)
        if token.kind == "number":
            return _number(token.text)
        match token.text:
            case "(":
                inner = self.expression(0)
                self._close(token)
                return inner
            case "-":
                return negated(self.expression(max(SUM, binding)))
            case "+":
                return self.expression(max(SUM, binding))
        self.cursor.at -= 1
        if token.kind == "end" and self.cursor.at == 0:
            raise FormulaError("a formula is missing", 0)
        raise self.cursor.unexpected()

    def _longer(self, left: Quantity, binding: int) -> Quantity | None:
        """`left` and the operation that follows it, if that binds tightly enough."""
        token = self.cursor.next
        if token.kind == "name" or token.text == "(":
            return self._beside(left) if binding < PRODUCT else None
        if token.kind == "number":
            raise FormulaError(
                f"a sign is missing before {token.text}", token.offset, "write * between factors"
            )
        if BINDING.get(token.text, 0) <= binding:
            return None
        self.cursor.take()
        return self._operate(left, token)

    def _operate(self, left: Quantity, sign: Token) -> Quantity:
        right = self.expression(BINDING[sign.text] - (sign.text == "^"))
        match sign.text:
            case "+":
                return summed(left, right, sign.offset)
            case "-":
                return summed(left, negated(right), sign.offset)
            case "*":
                return multiplied(left, right, sign.offset)
            case "/":
                return divided(left, right, sign.offset)
            case _:
                return raised(left, right, sign.offset)

    def _beside(self, left: Quantity) -> Quantity:
        """A number with its unit, or a product written with a blank."""
        token = self.cursor.next
        before = self.cursor.tokens[self.cursor.at - 1]
        if (before.kind == "number" or before.text in (")", "pi")) and ends_in_number(left):
            phrase = unit_phrase(self.cursor.tokens, self.cursor.at, self.units)
            if phrase and self._is_unit(phrase, left):
                self.phrase = self.phrase or phrase
                self.cursor.at = phrase.end
                return measured(left, compound(phrase.parts), token.offset)
            self._refuse_unit(token)
        return multiplied(left, self.expression(PRODUCT), token.offset)

    def _refuse_unit(self, token: Token) -> None:
        """Raises FormulaError for what is a unit and cannot be read as one here."""
        if token.text in self.names:
            return
        if token.text in OTHER_UNITS:
            raise FormulaError(f"the unit {token.text} is not known", token.offset, meant_unit(token.text))
        if not self.units and token.text in UNITS and len(token.text) > 1:
            raise FormulaError(f"no unit can stand here: {token.text}", token.offset, "give a plain number")

    def _is_unit(self, phrase: Phrase, left: Quantity) -> bool:
        """Whether a phrase that names declared symbols is a unit all the same."""
        declared = [name for name, _ in phrase.parts if name in self.names]
        if not declared:
            return True
        if isinstance(self.wanted, tuple):
            return left.numeric and compound(phrase.parts).dimension[:4] == self.wanted[:4]
        if len(declared) < len(phrase.parts):
            return True
        name = phrase.parts[0][0]
        hint = f"{name} is declared: write * for the symbol, or a plain number, which is in SI units"
        raise FormulaError(f"{phrase.text} could be a unit or a symbol", phrase.offset, hint)

    def _name(self, token: Token) -> Quantity:
        opens = self.cursor.next.text == "("
        if token.text in ARGUMENTS:
            if not opens:
                hint = f"write its argument in parentheses, as {token.text}(x)"
                raise FormulaError(f"'{token.text}' is a function", token.offset, hint)
            return self._call(token)
        if opens and (self.cursor.next.offset == token.end or meant(token.text)):
            inside = self.cursor.ahead(3)[1:]
            argument = inside[0] if inside[-1] == ")" else ""
            raise unknown_function(token.text, argument, token.offset)
        self._star(token)
        return _symbol(token.text)

    def _call(self, token: Token) -> Quantity:
        parenthesis = self.cursor.take()
        outside = self.units
        self.units = outside and token.text not in TRIGONOMETRIC
        arguments = [self.expression(0)]
        while self.cursor.next.text == ",":
            self.cursor.take()
            arguments.append(self.expression(0))
        self.units = outside
        self._close(parenthesis)
        if len(arguments) != (wanted := ARGUMENTS[token.text]):
            message = f"{token.text} takes {wanted} argument{'s' * (wanted > 1)}, not {len(arguments)}"
            raise FormulaError(message, token.offset)
        return called(token.text, tuple(arguments), token.offset)

    def _star(self, name: Token) -> None:
        """Take the star that marks a joint variable, as against the sign of a product."""
        star = self.cursor.next
        if star.text != "*":
            return
        after = self.cursor.after.text
        touching = star.offset == name.end and after in ("+", "-")
        if not ((touching and self.stars) or after in ("", ")", ",")):
            return
        if not self.stars:
            hint = "only theta or d of a link, or a motion in it, has a star"
            raise FormulaError("a star marks a joint variable, and there is none here", star.offset, hint)
        self.cursor.take()
        self.starred.append(name)

    def _close(self, opened: Token) -> None:
        self.cursor.close(opened, ")", "parenthesis", "write the missing )")

    def _wrong_dimension(self, found: Quantity, wanted: str) -> FormulaError:
        message = f"this is {spoken(found.dimension or (0, 0, 0, 0, 0))}, but {wanted} is wanted"
        if self.phrase is None:
            return FormulaError(message, 0)
        name = self.phrase.parts[0][0]
        hint = f"; if {name} is a symbol here, write * before it" if self.phrase.letters else ""
        return FormulaError(message, self.phrase.offset, f"give {wanted}{hint}")
