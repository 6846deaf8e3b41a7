"""Names in published LaTeX: symbols of the problem, letters side by side, c_1 and s_{12}."""

from __future__ import annotations

from abc import abstractmethod

from derive.algebra.formulas.quantities import Quantity, called
from derive.answers.latex.cursor import Cursor
from derive.answers.latex.letters import GREEK_NAMES, TRIG, squeeze
from derive.answers.latex.scripts import Scripted, group_text, scripted
from derive.answers.latex.tokens import Kind, Token
from derive.errors import FormulaError
from derive.expression import Call, Expr, Sum, Symbol, negate

FUNCTIONS = {
    "cos": "cos", "sin": "sin", "tan": "tan", "arccos": "acos", "arcsin": "asin", "arctan": "atan",
    "acos": "acos", "asin": "asin", "atan": "atan", "exp": "exp", "ln": "log", "log": "log", "sgn": "sign",
    "sign": "sign", "sqrt": "sqrt", "abs": "abs", "atan2": "atan2", "Atan2": "atan2", "arctan2": "atan2",
    "ATAN2": "atan2",
}  # fmt: skip


class NameReader(Cursor):
    """Reads a name where the cursor stands. What comes after a function is read by others."""

    @abstractmethod
    def function(self, name: str, token: Token) -> Quantity:
        """A function of what follows."""

    @abstractmethod
    def argument_group(self) -> Quantity:
        """What stands in braces."""

    @abstractmethod
    def nested(self, found: tuple[Token, ...]) -> Expr:
        """An expression of its own, as in an index."""

    def word(self) -> Quantity:
        """A name of the problem, or several letters side by side; the last of them may carry a subscript."""
        token = self.next
        follows = self.tokens[self.at + 1]
        applied = follows.text in ("(", "{", "^") or follows.text in GREEK_NAMES
        if token.text in FUNCTIONS and applied and not self.letters.find(token.text):
            self.take()
            return self.function(token.text, token)
        pieces = self.split(token)
        if len(pieces) > 1:
            self.tokens[self.at : self.at + 1] = pieces
        return self.named(self.scripted())

    def split(self, token: Token) -> list[Token]:
        """The names in a word: the whole of it, or from the left the longest the problem knows."""
        subscript = self.tokens[self.at + 1].text == "_"
        script = group_text(self.tokens, self.at + 2) if subscript else ""
        whole = token.text
        if self.letters.find(whole) or (self.letters.abbreviated(whole) and not subscript):
            return [token]
        pieces: list[Token] = []
        at = 0
        while at < len(whole):
            if script and self.letters.find(f"{whole[at:]}_{script}"):  # the ZZ_1 of m ZZ_1
                return [*pieces, Token("word", whole[at:], token.offset + at, token.end)]
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
        self.tokens[self.at + 2 : self.at + 3] = [first, rest]
        return scripted(self.tokens, self.at)

    def named(self, name: Scripted) -> Quantity:
        """The symbol, the sine or the cosine that a letter with its subscript stands for."""
        letters = self.letters
        if name.upper and (found := letters.find(f"{name.plain}^{name.upper}{name.accent}")):
            self.at = name.end
            return self.moving(Symbol(found))
        self.at = name.power
        found = letters.find(name.plain + name.accent)
        turns = name.stem in TRIG and not name.lower and not name.accent and self.starts_angle()
        if turns and found not in letters.own:
            return self.function(TRIG[name.stem], self.next)
        if found:
            return self.moving(Symbol(found))
        if (value := self.abbreviation(name)) is not None:
            return self.moving(value)
        if name.stem == "e" and name.upper:
            self.take()
            return called("exp", (self.argument_group(),), name.offset)
        raise letters.unknown(name.plain + name.accent, name.offset)

    def moving(self, value: Expr) -> Quantity:
        r"""What a name stands for, an argument (t) after it left out: \theta_1(t) is \theta_1."""
        if self.ahead(3) == ("(", "t", ")"):
            if self.letters.find("t"):
                hint = "leave (t) out, or write a sign between the factors"
                raise FormulaError("(t) could be an argument or a factor", self.next.offset, hint)
            self.at += 3
        return Quantity(value, None, numeric=False)

    def abbreviation(self, name: Scripted) -> Expr | None:
        """c_1, s_{12}, c_{1+2}, c_\\theta; \\theta_{12} for a sum of angles. None for any other name."""
        if name.accent:
            return None
        if squeeze(name.stem) in ("theta", "q") and name.lower.isdigit():
            return self.letters.summed(name.lower)
        function = TRIG.get(name.stem)
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
        return self.nested((*found, end))

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
        if not terms:
            raise FormulaError("an index is missing", found[0].offset)
        return Sum(tuple(terms)) if len(terms) > 1 else terms[0]
