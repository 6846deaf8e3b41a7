r"""Units on our own pages, read back.

`8.67\ \mathrm{N\ m}` is 8.67 and "N m", `45^\circ/\mathrm{s}` is 45° and "/s".
"""

from __future__ import annotations

from derive.answers.latex.scripts import Tokens
from derive.errors import FormulaError

SPELLED = {"Omega": "ohm"}


def without_unit(part: Tokens) -> tuple[Tokens, str]:
    """What stands before the unit at the end of an expression (an end token last in both), and the unit as it
    is spelled in a sheet. Raises FormulaError where there is none."""
    *tokens, end = part
    texts = [token.text for token in tokens]
    if "mathrm" not in texts or texts[-1] != "}":
        raise FormulaError("the unit is missing", end.offset)
    at = len(texts) - 1 - texts[::-1].index("mathrm")
    divided = at > 0 and texts[at - 1] == "/"
    spelled = ("/" if divided else "") + _spelled(texts[at + 2 : -1])
    return (*tokens[: at - divided], end), spelled


def _spelled(texts: list[str]) -> str:
    """Names with a blank between two that stand side by side."""
    written = ""
    for text in texts:
        word = SPELLED.get(text, text)
        written += f" {word}" if word.isalpha() and written and written[-1] not in "/^" else word
    return written
