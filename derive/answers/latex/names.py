"""Names in published LaTeX: symbols of the problem, letters side by side, c_1 and s_{12}."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from derive.algebra.formulas.cursor import Cursor
from derive.algebra.formulas.tokens import Kind, Token
from derive.answers.latex.letters import GREEK_NAMES, TRIG, Letters, squeeze
from derive.answers.latex.scripts import Scripted, Tokens, group_text, scripted
from derive.errors import FormulaError
from derive.expression import Call, Expr, Indexed, Sum, Symbol

FUNCTIONS = {
    "cos": "cos", "sin": "sin", "tan": "tan", "arccos": "acos", "arcsin": "asin", "arctan": "atan",
    "acos": "acos", "asin": "asin", "atan": "atan", "exp": "exp", "ln": "log", "log": "log", "sgn": "sign",
    "sign": "sign", "sqrt": "sqrt", "abs": "abs", "atan2": "atan2", "Atan2": "atan2", "arctan2": "atan2",
    "ATAN2": "atan2", "det": "det", "adj": "adj",
}  # fmt: skip
OPENING, CLOSING = ("(", "[", "{"), (")", "]", "}")
STARS = ("ast", "star", "*")


def is_greek(token: Token) -> bool:
    """Whether a token is a Greek letter, as angles are called."""
    return token.kind == "command" and squeeze(token.text) in GREEK_NAMES


@dataclass(frozen=True, slots=True)
class Names:
    """Reads a name where the cursor stands; `nested` reads an index that is an expression of its own."""

    cursor: Cursor
    letters: Letters
    nested: Callable[[Tokens], Expr]

    def is_function(self) -> bool:
        """Whether the word here is a function of what follows it, and no name of the problem."""
        if self.letters.printed:
            return False
        name, *following = self.cursor.ahead(2)
        applied = following[0] in ("(", "{", "^") or following[0] in GREEK_NAMES
        return applied and name in FUNCTIONS and not self.letters.find(name)

    def part(self) -> None:
        """Parts a word into the names that stand side by side in it: all of it, or from the left the longest
        that the problem knows; the last of them may carry a subscript."""
        cursor, letters = self.cursor, self.letters
        token = cursor.next
        if letters.printed:
            if len(token.text) > 1:
                raise FormulaError(f"the letters '{token.text}' stand without a space", token.offset)
            return
        script = group_text(cursor.tokens, cursor.at + 2) if cursor.ahead(2)[1] == "_" else ""
        whole = token.text
        if letters.find(whole) or (letters.abbreviated(whole) and cursor.ahead(2)[1] != "_"):
            return
        pieces: list[Token] = []
        at = 0
        while at < len(whole):
            end = next((stop for stop in range(len(whole), at, -1) if letters.find(whole[at:stop])), at + 1)
            while end < len(whole) and whole[end].isdigit():
                end += 1
            if script and letters.find(f"{whole[at:]}_{script}"):  # the ZZ_1 of m ZZ_1
                end = len(whole)
            pieces.append(Token("name", whole[at:end], token.offset + at, token.offset + end))
            at = end
        cursor.tokens[cursor.at : cursor.at + 1] = pieces

    def read(self) -> Expr | str:
        """What a letter with its scripts stands for: an expression, or the name of the function that begins
        with it (cos where a c stands before an angle, exp for an e with an exponent). Raises FormulaError."""
        name, cursor, letters = self._scripted(), self.cursor, self.letters
        if name.upper and (found := letters.find(_raised(name))):
            cursor.at = name.end
            return self.moving(Symbol(found))
        cursor.at = name.power
        found = letters.find(name.plain + name.accent)
        stem = name.stem + name.accent
        if not found and name.lower and stem in letters.indexed:
            return Indexed(stem, self._indices(name.lower_tokens))
        turns = name.stem in TRIG and not name.lower and not name.accent and is_greek(cursor.next)
        if turns and found not in letters.own:
            return TRIG[name.stem]
        if found:
            return self.moving(Symbol(found))
        if (value := self._abbreviation(name)) is not None:
            return self.moving(value)
        if name.stem == "e" and name.upper:
            return "exp"
        raise letters.unknown(name.plain + name.accent, name.offset)

    def moving(self, value: Expr) -> Expr:
        r"""What a name stands for, an argument (t) after it left out: \theta_1(t) is \theta_1. Raises
        FormulaError where t is a name of the problem."""
        if not self.letters.printed and self.cursor.ahead(3) == ("(", "t", ")"):
            if self.letters.find("t"):
                hint = "leave (t) out, or write a sign between the factors"
                raise FormulaError("(t) could be an argument or a factor", self.cursor.next.offset, hint)
            self.cursor.at += 3
        return value

    def _scripted(self) -> Scripted:
        """The letter here with its scripts, the place still before it; of L_cs the script is c only."""
        tokens, at = self.cursor.tokens, self.cursor.at
        found = scripted(tokens, at, self.letters.printed)
        under = found.lower_tokens[0] if found.lower_tokens else None
        bare = under and under.kind == "name" and len(under.text) > 1 and tokens[at + 2] is under
        if under is None or not bare or self.letters.find(found.plain) or self.letters.find(under.text):
            return found
        first = Token("name", under.text[0], under.offset, under.offset + 1)
        kind: Kind = "number" if under.text[1:].isdigit() else "name"
        tokens[at + 2 : at + 3] = [first, Token(kind, under.text[1:], under.offset + 1, under.end)]
        return scripted(tokens, at, self.letters.printed)

    def _abbreviation(self, name: Scripted) -> Expr | None:
        """c_1, s_{12}, c_{1+2}, c_\\theta; \\theta_{12} for a sum of angles. None for any other name."""
        if name.accent:
            return None
        if self.letters.printed and name.stem not in TRIG:
            return None
        if squeeze(name.stem) in ("theta", "q") and name.lower.isdigit():
            return self.letters.angle(name.lower)
        function = TRIG.get(name.stem)
        if function is None or not name.lower:
            return self.letters.abbreviated(name.stem)
        angle = self.letters.angle(",".join(token.text for token in name.lower_tokens if token.text != ","))
        angle = angle or self.letters.angle(name.lower)
        if angle is None and name.lower.isdigit():
            raise FormulaError(f"there is no joint angle {name.lower}", name.offset)
        return Call(function, (angle or self._index(name.lower_tokens),))

    def _indices(self, found: Tokens) -> tuple[Expr, ...]:
        """Indices that are formulas, with commas between them: the z and 30 degrees of R_{z,30}."""
        pieces: list[list[Token]] = [[]]
        depth = 0
        for token in found:
            depth += (token.text in OPENING) - (token.text in CLOSING)
            if token.text == "," and not depth:
                pieces.append([])
            else:
                pieces[-1].append(token)
        end = Token("end", "", found[-1].end, found[-1].end)
        return tuple(self.nested((*piece, end)) for piece in pieces)

    def _index(self, found: Tokens) -> Expr:
        """An index that is an angle of its own: 1+2, \\theta_1+\\theta_2, 2\\theta."""
        plain = [token for token in found if token.text not in "{}"]
        if any(token.text in ("+", "-") for token in plain) and all(
            token.kind == "number" or token.text in ("+", "-") for token in plain
        ):
            return self._sum_of_joints(plain)
        return self.nested((*found, Token("end", "", found[-1].end, found[-1].end)))

    def _sum_of_joints(self, found: list[Token]) -> Expr:
        terms, negative = [], False
        for token in found:
            if token.text in ("+", "-"):
                negative = token.text == "-"
                continue
            angle = self.letters.angle(token.text)
            if angle is None:
                raise FormulaError(f"there is no joint angle {token.text}", token.offset)
            terms.append(-angle if negative else angle)
        if not terms:
            raise FormulaError("an index is missing", found[0].offset)
        return Sum(tuple(terms)) if len(terms) > 1 else terms[0]


def _raised(name: Scripted) -> str:
    r"""A name with what stands above it: T_1^0, and q_1^\ast as q_1*."""
    star = next((star for star in STARS if name.upper.endswith(star)), "")
    above = name.upper.removesuffix(star)
    return name.plain + (f"^{above}" if above else "") + name.accent + ("*" if star else "")
