r"""Mathematics in Markdown that every reader of Markdown leaves as it is.

GitHub reads a page as CommonMark before it looks for formulas: of a backslash and a sign only the sign is
left (`\,` becomes a comma), and the `_` of `}_1` may begin emphasis. A row of a matrix ends with its line,
where GitHub keeps the two backslashes. What is written instead is read by MathJax, KaTeX and pandoc alike.
"""

from __future__ import annotations

import re

from derive.errors import NotAsWritten

# A block or span of code, an escaped sign, or a formula between its dollars.
FORMULA = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)|\\.|(?P<mark>\${1,2})(?P<tex>[^$]+)(?P=mark)", re.DOTALL)
COMMANDS = {
    r"\,": r"\hspace{0.17em}", r"\:": r"\hspace{0.22em}", r"\>": r"\hspace{0.22em}",
    r"\;": r"\hspace{0.28em}", r"\!": r"\hspace{-0.17em}",
    r"\{": r"\lbrace ", r"\}": r"\rbrace ", r"\|": r"\Vert ",
}  # fmt: skip
SIGN = re.compile(r"\\[,:>;!{}|]")
AFTER_COMMA = re.compile(r"(?<=,)\\,")  # where every reader leaves that much room by itself
MATRIX = re.compile(r"(?<=\\begin\{bmatrix\})[ \t]+|[ \t]+(?=\\end\{bmatrix\})")
ROW = re.compile(r"[ \t]*(\\\\(?:\[[^\]\n]*\])?)[ \t]*\n?[ \t]*(?=\S)")
ROOM = re.compile(r"(?<=\\\\)\[[\d.]+ex\]")
ACCENT = re.compile(r"(\\d?dot)\{(?:(\\[A-Za-z]+)|([A-Za-z]))\}(?=_)")
ROOMS = frozenset(command for command, written in COMMANDS.items() if written.startswith(r"\hspace"))
WIDTH = re.compile(r"\\hspace\{-?[\d.]+em\}")
SAID = re.compile(r"\\[A-Za-z]+|\\.|[^\s{}]")
EMPHASIS = re.compile(r"(?<![A-Za-z0-9])_(?=\S)")  # the sign before it is no letter: it may begin emphasis


def left_alone(page: str) -> str:
    """A page with its formulas written so. Raises NotAsWritten where anything beside them has changed."""
    written = FORMULA.sub(_written, page)
    if _beside(written) != _beside(page):
        raise NotAsWritten
    return written


def _beside(page: str) -> str:
    """What stands between the formulas."""
    return FORMULA.sub(lambda found: "" if found["mark"] else found[0], page)


def _written(found: re.Match[str]) -> str:
    match found["mark"]:
        case "$":
            return f"${kept(found['tex'])}$"
        case "$$":
            return f"$${rows_apart(kept(found['tex']))}$$"
        case _:
            return found[0]


def kept(tex: str) -> str:
    """A formula of one row that CommonMark does not change. Raises NotAsWritten where it says another."""
    spaced = SIGN.sub(lambda sign: COMMANDS[sign[0]], AFTER_COMMA.sub("", tex))
    accented = ACCENT.sub(lambda of: f"{of[1]}{of[2] or f' {of[3]}'}", spaced)
    written = ROOM.sub("", EMPHASIS.sub("_ ", accented))
    if _said(written) != _said(tex):
        raise NotAsWritten
    return written


def _said(tex: str) -> list[str]:
    """Its commands and signs, without room and braces."""
    bare = WIDTH.sub("", ROOM.sub("", tex))
    return [COMMANDS.get(sign, sign).rstrip() for sign in SAID.findall(bare) if sign not in ROOMS]


def rows_apart(tex: str) -> str:
    """A displayed formula with each row of a matrix in a line of its own."""
    return MATRIX.sub("\n", ROW.sub(r" \1" "\n", tex))
