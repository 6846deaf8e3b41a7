"""What a YAML parser complains of, said to someone who has never heard of scalars."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from unicodedata import category

from derive.errors import Place, SheetError
from derive.sheet.tex import COMMANDS

QUOTES = "use single quotes around TeX: '\\theta'"
ESCAPE = re.compile(r"\\(?:([0abtvfreNLP_])|(n)([A-Za-z]*)|x..|u.{4}|U.{8}|.)", re.DOTALL)
FIRST_KEY = re.compile(r"\s*(?:- +)?(?P<key>[\w-]+)")  # of a line
ALIGN = "line it up with them; a text that goes on stands in quotes, or after '|'"
SEPARATORS = "\u0085\u2028\u2029"

# What the parser says -> what is wrong, what to write instead. The first that fits is taken.
TEX = "a formula is written a/2, sqrt(2), theta1; a text in single quotes: 'of $\\theta_1$'"
MEANINGS = (
    ("mapping values are not allowed", "a second colon in one line", "put the text in quotes, or after '|'"),
    ("'\\t'", "a tab is used to indent", "indent with blanks"),
    ("undefined alias", "a value cannot begin with a star", "the star goes behind the name: theta1*"),
    ("alphabetic or numeric", "a value cannot begin with a star", "the star goes behind the name: theta1*"),
    ("but found another document", "a sheet is one document", "leave out the line ---"),
    ("end of stream", "a quotation mark is never closed", "write the missing quotation mark"),
    ("got '<stream end>'", "a bracket is never closed", "write the missing bracket"),
    ("cannot start any token", "a value cannot begin with this character", "put the value in quotes"),
    (
        "expected <block end>",
        "this does not line up with what stands above",
        "check the indentation and brackets",
    ),
    ("could not find expected ':'", "a colon is missing behind the key", "write it as key: value"),
    ("expected ',' or", "a comma or a closing bracket is missing", "check the brackets, and quote odd texts"),
    ("expected the node content", "a value is missing here", "check the commas"),
    ("unknown escape", "a backslash in double quotes", QUOTES),
    ("expected escape sequence", "a backslash in double quotes", QUOTES),
    ("too many values", "too much is nested or repeated here", "make it several sheets"),
)


def explain(error: Exception, path: Path, lines: tuple[str, ...]) -> SheetError:
    """The fault for an exception of the YAML parser, with its place."""
    said = f"{getattr(error, 'problem', '')} {getattr(error, 'context', '')}"
    mark = getattr(error, "problem_mark", None)
    if mark is None:
        found = ((k, char) for k, line in enumerate(lines) for char in line if unprintable(char))
        number, char = next(found, (0, ""))
        if not char:
            said = f"{path}: a character that cannot stand in a text file"
            return SheetError(said, None, "save it as plain text")
        column = lines[number].index(char)
        place = Place(str(path), number + 1, column + 1, lines[number])
        return SheetError(f"the character U+{ord(char):04X} cannot be printed", place, "leave it out")
    line, column = mark.line, mark.column
    text = lines[line] if line < len(lines) else ""
    place = Place(str(path), line + 1, column + 1, text)
    if re.search(r"\\[A-Za-z]", text[:column]) and "expected ',' or" in said:
        return SheetError("TeX in braces needs quotes around it", place, TEX)
    if "mapping values" in said and (key := FIRST_KEY.fullmatch(text[:column])):
        further_in = Place(str(path), line + 1, key.start("key") + 1, text)
        return SheetError("this line is further in than the keys above it", further_in, ALIGN)
    opened = getattr(error, "context_mark", None)
    if opened is not None and "a flow" in said and opened.line < line and FIRST_KEY.match(text):
        at_bracket = Place(str(path), opened.line + 1, opened.column + 1, lines[opened.line])
        return SheetError("this bracket is never closed", at_bracket, "write the missing bracket")
    for sign, message, hint in MEANINGS:
        if sign in said:
            return SheetError(message, place, hint)
    return SheetError(f"this is not YAML: {said.strip()}", place)


def taken_by_quotes(raw: str) -> Iterator[tuple[int, str]]:
    """Where in a double-quoted text, as it stands in the file, an escape is no letter of anyone's; and what
    it says. A line break `\\n` is one, unless a command of TeX would begin with it."""
    for found in ESCAPE.finditer(raw):
        escape, line_break, rest = found.groups()
        if escape or (line_break and f"n{rest}" in COMMANDS):
            yield found.start(), f"\\{escape or line_break}"


def unprintable(text: str) -> str | None:
    """The first character of a value that no page can hold: a control, half a pair, no character at all."""
    for char in text:
        if char not in "\n\t" and (category(char) in ("Cc", "Cs") or char in SEPARATORS or _is_none(char)):
            return char
    return None


def _is_none(char: str) -> bool:
    """Whether Unicode promises never to use it."""
    return ord(char) & 0xFFFE == 0xFFFE or 0xFDD0 <= ord(char) <= 0xFDEF
