"""The words of published LaTeX: numbers, letters, commands and signs, each with its place in the text."""

from __future__ import annotations

import re

from derive.algebra.formulas.tokens import GREEK, MAX_DIGITS, Token
from derive.errors import FormulaError, Unfit

MAX_TEXT = 100_000

# What says only how something looks or is called. A `.` after \left or \right stands for no delimiter.
_BLANK = (
    r"\s+|~|\$|\\[,;:!> ]|\\[()\[\]](?=\s*$)|^\\[(\[]"
    r"|\\(?:tag|label|eqlabel|phantom|hphantom|vphantom|hspace|vspace|color|textcolor)\*?\s*\{[^{}]*\}"
    r"|\\(?:left|right)(?![A-Za-z])\s*\.?"
    r"|\\(?:displaystyle|textstyle|scriptstyle|limits|nolimits|hline|nonumber|notag|bigl|bigr|Bigl|Bigr|biggl"
    r"|biggr|big|Big|bigg|Bigg|Biggl|Biggr|hfill|hfil|mathstrut|strut|allowbreak|nobreak|centering|noindent)"
    r"(?![A-Za-z])"
)
_GAP = r"\\(?:quad|qquad)(?![A-Za-z])"
_MATHEMATICS = re.compile(r"[\\&=+^_{}]|%")
_LENGTH = r"\[\s*(?:-?[\d.]+\s*[a-z]{2}|\\[a-z]+skip)\s*\]"  # any other bracket begins an entry
_ROW = rf"\\\\\*?(?:\s*{_LENGTH})?|\\(?:cr|newline)(?![A-Za-z])"
_PIECE = re.compile(
    rf"(?P<blank>{_BLANK})|(?P<comment>%[^\n]*)|(?P<row>{_ROW})|(?P<gap>{_GAP})|(?P<command>\\(?:[A-Za-z]+|[{{}}|]))"
    r"|(?P<number>[0-9]+(?:\.[0-9]+)?|\.[0-9]+)|(?P<name>[A-Za-z][A-Za-z0-9]*)|(?P<char>.)",
    re.DOTALL,
)
_BRACES = {"{": "(", "}": ")"}
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
    for match in _PIECE.finditer(text):
        if match.lastgroup == "comment":
            _require_end(match, text)
        elif match.lastgroup != "blank":
            found.append(_read(match))
    return (*found, Token("end", "", len(text), len(text)))


def _require_end(comment: re.Match[str], text: str) -> None:
    """Raises FormulaError where a comment may have swallowed a part of the answer: lines that YAML has joined
    into one."""
    if comment.end() == len(text) and _MATHEMATICS.search(comment[0], 1):
        hint = "leave the comment out, or write the answer under | with its lines as they are"
        raise FormulaError("this comment takes in all that follows it", comment.start(), hint)


def _read(found: re.Match[str]) -> Token:
    text, at, end = found[0], found.start(), found.end()
    match found.lastgroup:
        case "row" | "gap" as kind:
            return Token(kind, text, at, end)
        case "command":
            name = text[1:]
            return Token("command" if name.isalpha() else "sign", _BRACES.get(name, name), at, end)
        case "number":
            if len(text) > MAX_DIGITS:
                raise Unfit(f"a number of more than {MAX_DIGITS} digits", at, "shorten it")
            return Token("number", text, at, end)
        case "name":
            return Token("name", text, at, end)
    if text in _COMMANDS:
        return Token("command", _COMMANDS[text], at, end)
    if text in _SIGNS:
        return Token("sign", _SIGNS[text], at, end)
    raise FormulaError(f"{text!r} cannot stand in an answer", at, "write it in LaTeX or as a formula")
