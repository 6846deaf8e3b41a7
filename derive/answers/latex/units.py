r"""Units on our own pages, read back.

`8.67\ \mathrm{N}\ \mathrm{m}` is 8.67 and "N m", `45^\circ/\mathrm{s}^2` is 45° and "/s^2"; so they are
inside of a formula, `\frac{30^\circ}{0.5\ \mathrm{s}}`.
"""

from __future__ import annotations

import re

from derive.algebra.formulas.tokens import Token
from derive.answers.latex.scripts import Tokens

ONE = r"mathrm { \w+ }(?! \()(?: \^ \d+)?"  # before parentheses it is a function
UNIT = re.compile(rf"(?:/ )?{ONE}(?: (?:/ )?{ONE})*")
NAME = re.compile(r"(/ )?mathrm { (\w+) }(?: \^ (\d+))?")
SPELLED = {"Omega": "ohm"}


def without_units(part: Tokens) -> tuple[Tokens, tuple[str, ...]]:
    """What stands in an expression (an end token last in both) beside its units, and these in their order, as
    they are spelled in a sheet."""
    *tokens, end = part
    written = " ".join(token.text for token in tokens)
    kept, units, place = list[Token](), list[str](), 0
    for found in UNIT.finditer(written):
        first = written[: found.start()].count(" ")
        kept += tokens[place:first]
        place = first + found[0].count(" ") + 1
        units.append(_spelled(found[0]))
    return (*kept, *tokens[place:], end), tuple(units)


def _spelled(written: str) -> str:
    """Names with their powers; a blank between two that nothing divides."""
    spelled = ""
    for below, name, power in NAME.findall(written):
        between = "/" if below else " " if spelled else ""
        spelled += between + SPELLED.get(name, name) + (f"^{power}" if power else "")
    return spelled
