"""Letters with what hangs on them: \\dot{\\theta}_1, L_c, T_1^0, I_{xx}."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from derive.algebra.formulas.cursor import Cursor
from derive.algebra.formulas.tokens import Token
from derive.answers.latex.letters import LETTERS
from derive.errors import FormulaError

Tokens: TypeAlias = tuple[Token, ...]

ACCENTS = {"dot": "_dot", "ddot": "_ddot"}
FONTS = frozenset(
    {"mathrm", "mathbf", "mathit", "mathsf", "mathcal", "boldsymbol", "bm", "text", "textrm", "operatorname"}
)


@dataclass(frozen=True, slots=True)
class Scripted:
    """A letter in plain text with its scripts; the superscript, from `power` to `end`, may be an exponent."""

    stem: str
    offset: int
    power: int
    end: int
    lower: str = ""
    lower_tokens: Tokens = ()
    upper: str = ""
    accent: str = ""

    @property
    def plain(self) -> str:
        """The name without accent and superscript, as one would type it."""
        return f"{self.stem}_{self.lower}" if self.lower else self.stem


def group(found: Sequence[Token], at: int) -> tuple[Tokens, int]:
    """The tokens of a group in braces (or one token) without its braces, and the place after it. Raises
    FormulaError for braces that are never closed."""
    if found[at].text != "{":
        return (found[at],), min(at + 1, len(found) - 1)
    depth, end = 0, at
    while True:
        depth += (found[end].text == "{") - (found[end].text == "}")
        if depth == 0:
            return tuple(found[at + 1 : end]), end + 1
        if found[end].kind == "end":
            raise FormulaError("this { is never closed", found[at].offset, "write the missing }")
        end += 1


def group_text(found: Sequence[Token], at: int) -> str:
    """The plain text of a group in braces, or of one token."""
    return _plain(group(found, at)[0])


def skip_group(cursor: Cursor) -> None:
    """Moves past a group in braces, or one token."""
    _, cursor.at = group(cursor.tokens, cursor.at)


def subscripts_first(found: Sequence[Token]) -> Tokens:
    """The same with T^0_1, and {}^0_1 T, as T_1^0."""
    at, done = 0, _behind(found)
    while at < len(done):
        if done[at].text == "^" and done[at + 1].kind != "end":
            _, middle = group(done, at + 1)
            if done[middle].text == "_" and done[middle + 1].kind != "end":
                _, end = group(done, middle + 1)
                done[at:end] = [*done[middle:end], *done[at:middle]]
        at += 1
    return tuple(done)


def _behind(found: Sequence[Token]) -> list[Token]:
    """The same with the scripts that stand before a letter behind it, as in {}^0_1 T or {}^0 o_1."""
    at, done = 0, list(found)
    while at < len(done) - 2:
        if (done[at].text, done[at + 1].text) == ("{", "}") and done[at + 2].text in ("^", "_"):
            middle = _after_scripts(done, at + 2)
            end = _after_letter(done, middle)
            lower = _after_scripts(done, end, "_")
            name = [*done[middle:lower], *done[at + 2 : middle]]
            raised = done[lower].text == "^"
            done[at:lower] = [_sign("(", done[at]), *name, _sign(")", done[lower])] if raised else name
        at += 1
    return done


def _sign(text: str, at: Token) -> Token:
    return Token("sign", text, at.offset, at.offset)


def _after_scripts(found: Sequence[Token], at: int, marks: str = "^_") -> int:
    """The place after the scripts that begin here, if any do."""
    while found[at].kind != "end" and found[at].text in marks:
        at = group(found, at + 1)[1]
    return at


def _after_letter(found: Sequence[Token], at: int) -> int:
    """The place after a letter, with the font or the accent that it has."""
    if found[at].kind == "command" and found[at].text in (*ACCENTS, *FONTS):
        return group(found, at + 1)[1]
    return min(at + 1, len(found) - 1)


def scripted(found: Sequence[Token], at: int, tex: bool = False) -> Scripted:
    """The letter that begins here with its scripts; for `tex` a command must be one that TeX knows. Raises
    FormulaError."""
    first = found[at]
    stem, accent, at = _stem(found, at, tex)
    digits = found[at]
    if digits.kind == "number" and digits.offset == found[at - 1].end and first.kind == "command":
        return Scripted(stem, first.offset, at + 1, at + 1, digits.text, (digits,), accent=accent)  # \theta1
    lower: Tokens = ()
    if found[at].text == "_":
        lower, at = _script(found, at)
    power = at
    upper, at = _script(found, at) if found[at].text == "^" else ((), at)
    return Scripted(stem, first.offset, power, at, _plain(lower), lower, _plain(upper), accent)


def _script(found: Sequence[Token], at: int) -> tuple[Tokens, int]:
    inner, after = group(found, at + 1)
    if not inner or inner[0].kind == "end":
        raise FormulaError("a script is missing", found[at].offset)
    return inner, after


def _stem(found: Sequence[Token], at: int, tex: bool) -> tuple[str, str, int]:
    """The letter itself in plain text, its accent, and the place after it."""
    token = found[at]
    if token.kind == "name":
        return token.text, "", at + 1
    if token.kind == "command" and token.text in ACCENTS:
        inner, after = group(found, at + 1)
        if not inner or inner[0].kind not in ("name", "command"):
            raise FormulaError("a dot stands over a name", token.offset)
        end = Token("end", "", inner[-1].end, inner[-1].end)
        return scripted((*inner, end), 0, tex).plain, ACCENTS[token.text], after
    if token.kind == "command" and token.text in FONTS:
        inner, after = group(found, at + 1)
        return _plain(inner), "", after
    if token.kind == "command" and (token.text in LETTERS or not tex):
        return token.text, "", at + 1
    if token.kind == "command":
        raise FormulaError(f"\\{token.text} is no command that is known here", token.offset)
    raise FormulaError(f"'{token.text}' cannot stand here", token.offset)


def _plain(inner: Sequence[Token]) -> str:
    kept = (t for t in inner if t.text not in ("{", "}", "_") and t.text not in FONTS)
    return "".join("x" if t.text == "times" and t.kind == "command" else t.text for t in kept)
