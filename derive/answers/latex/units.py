r"""Units on our own pages, read back.

`8.67\ \mathrm{N}\ \mathrm{m}` is 8.67 and "N m", `45^\circ/\mathrm{s}^2` is 45° and "/s^2".
"""

from __future__ import annotations

import re

from derive.answers.latex.scripts import Tokens
from derive.errors import FormulaError

ONE = r"mathrm { \w+ }(?: \^ \d+)?"
UNIT = re.compile(rf"(?:/ )?{ONE}(?: (?:/ )?{ONE})*$")
NAME = re.compile(r"(/ )?mathrm { (\w+) }(?: \^ (\d+))?")
SPELLED = {"Omega": "ohm"}


def without_unit(part: Tokens) -> tuple[Tokens, str]:
    """What stands before the unit at the end of an expression (an end token last in both), and the unit as it
    is spelled in a sheet. Raises FormulaError where there is none."""
    *tokens, end = part
    written = " ".join(token.text for token in tokens)
    found = UNIT.search(written)
    if found is None:
        raise FormulaError("the unit is missing", end.offset)
    return (*tokens[: written[: found.start()].count(" ")], end), _spelled(found[0])


def _spelled(written: str) -> str:
    """Names with their powers; a blank between two that nothing divides."""
    spelled = ""
    for below, name, power in NAME.findall(written):
        between = "/" if below else " " if spelled else ""
        spelled += between + SPELLED.get(name, name) + (f"^{power}" if power else "")
    return spelled
