"""Characters that cannot stand in a sheet, and TeX whose letters double quotes took away: `"\\theta"` begins
with a tab."""

from __future__ import annotations

import re
from collections.abc import Iterator
from unicodedata import category

from derive.sheet.tex import COMMANDS

QUOTES = "use single quotes around TeX: '\\theta'"
ESCAPE = re.compile(r"\\(?:([0abtvfreNLP_])|(n)([A-Za-z]*)|x..|u.{4}|U.{8}|.)", re.DOTALL)
SEPARATORS = "\u0085\u2028\u2029"


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
