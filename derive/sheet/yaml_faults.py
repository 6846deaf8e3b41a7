"""What a YAML parser complains of, said to someone who has never heard of scalars."""

from __future__ import annotations

import re
from pathlib import Path

from derive.errors import Place, SheetError
from derive.sheet.characters import QUOTES

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
        return SheetError(
            f"{path}: a character that cannot stand in a text file", None, "save it as plain text"
        )
    line, column = mark.line, mark.column
    text = lines[line] if line < len(lines) else ""
    place = Place(str(path), line + 1, column + 1, text)
    if re.search(r"\\[A-Za-z]", text[:column]) and "expected ',' or" in said:
        return SheetError("TeX in braces needs quotes around it", place, TEX)
    for sign, message, hint in MEANINGS:
        if sign in said:
            return SheetError(message, place, hint)
    return SheetError(f"this is not YAML: {said.strip()}", place)
