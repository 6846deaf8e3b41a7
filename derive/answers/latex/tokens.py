"""The words of published LaTeX: numbers, letters, commands and signs, each with its place in the text."""

from __future__ import annotations

import re

from derive.algebra.formulas.tokens import GREEK, MAX_DIGITS, Kind, Token
from derive.errors import FormulaError, Unfit

MAX_TEXT = 100_000

# What says only how something looks or is called. A `.` after \left or \right stands for no delimiter.
_BLANK = re.compile(
    r"\s+|~|\$|\\[,;:!> ]|\\[()\[\]](?=\s*$)|^\\[(\[]"
    r"|\\(?:tag|label|eqlabel|phantom|hphantom|vphantom|hspace|vspace|color|textcolor)\*?\s*\{[^{}]*\}"
    r"|\\(?:left|right)(?![A-Za-z])\s*\.?"
    r"|\\(?:displaystyle|textstyle|scriptstyle|limits|nolimits|hline|nonumber|notag|bigl|bigr|Bigl|Bigr|biggl"
    r"|biggr|big|Big|bigg|Bigg|Biggl|Biggr|hfill|hfil|mathstrut|strut|allowbreak|nobreak|centering|noindent)"
    r"(?![A-Za-z])"
)
_GAP = re.compile(r"\\(?:quad|qquad)(?![A-Za-z])")
_COMMENT = re.compile(r"%[^\n]*")
_MATHEMATICS = re.compile(r"[\\&=+^_{}]|%")
_LENGTH = r"\[\s*(?:-?[\d.]+\s*[a-z]{2}|\\[a-z]+skip)\s*\]"  # any other bracket begins an entry
_ROW = re.compile(rf"\\\\\*?(?:\s*{_LENGTH})?|\\(?:cr|newline)(?![A-Za-z])")
_NUMBER = re.compile(r"\d+(?:\.\d+)?|\.\d+", re.ASCII)
_WORD = re.compile(r"[A-Za-z][A-Za-z0-9]*", re.ASCII)
_COMMAND = re.compile(r"\\([A-Za-z]+|[{}|])")
_SIGNS = {sign: sign for sign in "+-*/^_()[]{},&=<>|'.;:"} | {
    "\N{MULTIPLICATION SIGN}": "*",
    "\N{MIDDLE DOT}": "*",
    "\N{DOT OPERATOR}": "*",
    "\N{MINUS SIGN}": "-",
    "\N{EN DASH}": "-",
}
_COMMANDS = GREEK | {
    "\N{DEGREE SIGN}": "degree",
    "\N{PLUS-MINUS SIGN}": "pm",
    "\N{MINUS-OR-PLUS SIGN}": "mp",
    "\N{IDENTICAL TO}": "equiv",
    "\N{ALMOST EQUAL TO}": "approx",
}


def tokens(text: str) -> tuple[Token, ...]:
    """The tokens of a LaTeX text, an end token last. Raises FormulaError."""
    if len(text) > MAX_TEXT:
        raise Unfit(f"an answer of {len(text)} characters is too long (at most {MAX_TEXT})", 0)
    found = []
    at = 0
    while at < len(text):
        if blank := _BLANK.match(text, at):
            at = blank.end()
        elif comment := _COMMENT.match(text, at):
            at = _after(comment, text)
        else:
            found.append(token := _read(text, at))
            at = token.end
    return (*found, Token("end", "", len(text), len(text)))


def _after(comment: re.Match[str], text: str) -> int:
    """The place after a comment. Raises FormulaError where it may have swallowed a part of the answer: lines
    that YAML has joined into one."""
    if comment.end() == len(text) and _MATHEMATICS.search(comment[0], 1):
        hint = "leave the comment out, or write the answer under | with its lines as they are"
        raise FormulaError("this comment takes in all that follows it", comment.start(), hint)
    return comment.end()


def _read(text: str, at: int) -> Token:
    if row := _ROW.match(text, at):
        return Token("row", row[0], at, row.end())
    if gap := _GAP.match(text, at):
        return Token("gap", gap[0], at, gap.end())
    if command := _COMMAND.match(text, at):
        name = command[1]
        kind: Kind = "command" if name.isalpha() else "sign"
        return Token(kind, {"{": "(", "}": ")"}.get(name, name), at, command.end())
    if number := _NUMBER.match(text, at):
        if len(number[0]) > MAX_DIGITS:
            raise Unfit(f"a number of more than {MAX_DIGITS} digits", at, "shorten it")
        return Token("number", number[0], at, number.end())
    if word := _WORD.match(text, at):
        return Token("name", word[0], at, word.end())
    char = text[at]
    if char in _COMMANDS:
        return Token("command", _COMMANDS[char], at, at + 1)
    if char in _SIGNS:
        return Token("sign", _SIGNS[char], at, at + 1)
    raise FormulaError(f"{char!r} cannot stand in an answer", at, "write it in LaTeX or as a formula")
