"""The words of published LaTeX: numbers, letters, commands and signs, each with its place in the text."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.algebra.tokens import GREEK, MAX_DIGITS
from derive.errors import FormulaError

MAX_TEXT = 20_000
Kind: TypeAlias = Literal["number", "word", "command", "sign", "row", "end"]

# What says only how something looks. A `.` after \left or \right stands for no delimiter.
_BLANK = re.compile(
    r"\s+|~|\$|\\[,;:!> ]|\\[()\[\]](?=\s*$)|^\\[(\[]|\\(?:quad|qquad|displaystyle|textstyle|limits|hline"
    r"|nonumber|bigl|bigr|Bigl|Bigr|biggl|biggr|big|Big|bigg|Bigg)(?![A-Za-z])|\\(?:left|right)(?![A-Za-z])\s*\.?"
)
_ROW = re.compile(r"\\\\(?:\s*\[[^\]]*\])?|\\cr(?![A-Za-z])")
_NUMBER = re.compile(r"\d+(?:\.\d+)?|\.\d+", re.ASCII)
_WORD = re.compile(r"[A-Za-z][A-Za-z0-9]*", re.ASCII)
_COMMAND = re.compile(r"\\([A-Za-z]+|[{}|])")
_SIGNS = {sign: sign for sign in "+-*/^_()[]{},&=|'"} | {
    "\N{MULTIPLICATION SIGN}": "*",
    "\N{MIDDLE DOT}": "*",
    "\N{DOT OPERATOR}": "*",
    "\N{MINUS SIGN}": "-",
    "\N{EN DASH}": "-",
}


@dataclass(frozen=True, slots=True)
class Token:
    """`text` of a command is without its backslash; a Greek letter is the command of its name."""

    kind: Kind
    text: str
    offset: int
    end: int


def tokens(text: str) -> tuple[Token, ...]:
    """The tokens of a LaTeX text, an end token last. Raises FormulaError."""
    if len(text) > MAX_TEXT:
        raise FormulaError(f"an answer of {len(text)} characters is too long (at most {MAX_TEXT})", 0)
    found = []
    at = 0
    while at < len(text):
        if blank := _BLANK.match(text, at):
            at = blank.end()
            continue
        found.append(token := _read(text, at))
        at = token.end
    return (*found, Token("end", "", len(text), len(text)))


def _read(text: str, at: int) -> Token:
    if row := _ROW.match(text, at):
        return Token("row", row[0], at, row.end())
    if command := _COMMAND.match(text, at):
        name = command[1]
        kind: Kind = "command" if name.isalpha() else "sign"
        return Token(kind, {"{": "(", "}": ")"}.get(name, name), at, command.end())
    if number := _NUMBER.match(text, at):
        if len(number[0]) > MAX_DIGITS:
            raise FormulaError(f"a number of more than {MAX_DIGITS} digits", at, "shorten it")
        return Token("number", number[0], at, number.end())
    if word := _WORD.match(text, at):
        return Token("word", word[0], at, word.end())
    char = text[at]
    if char in GREEK:
        return Token("command", GREEK[char], at, at + 1)
    if char == "°":
        return Token("command", "degree", at, at + 1)
    if char in _SIGNS:
        return Token("sign", _SIGNS[char], at, at + 1)
    raise FormulaError(f"{char!r} cannot stand in an answer", at, "write it in LaTeX or as a formula")
