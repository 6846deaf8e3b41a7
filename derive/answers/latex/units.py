r"""Units on our own pages, read back.

`8.67\ \mathrm{N\ m}` is 8.67 and "N m", `45^\circ/\mathrm{s}^2` is 45° and "/s^2".
"""

from __future__ import annotations

import re

from derive.answers.latex.scripts import Tokens
from derive.errors import FormulaError

UNIT = re.compile(r"(?:/ )?(?:mathrm { [^{}]* }(?: \^ \d+)?(?: |$))+$")
UPRIGHT = re.compile(r"mathrm { ([^{}]*) }(?: (\^) (\d+))? ?")
SPELLED = {" / ": "/", "/ ": "/", " ^ ": "^", "Omega": "ohm"}


def without_unit(part: Tokens) -> tuple[Tokens, str]:
    """What stands before the unit at the end of an expression (an end token last in both), and the unit as it
    is spelled in a sheet. Raises FormulaError where there is none."""
    *tokens, end = part
    written = " ".join(token.text for token in tokens)
    found = UNIT.search(written)
    if found is None:
        raise FormulaError("the unit is missing", end.offset)
    spelled = UPRIGHT.sub(r"\1\2\3", found[0])
    for spaced, plain in SPELLED.items():
        spelled = spelled.replace(spaced, plain)
    return (*tokens[: written[: found.start()].count(" ")], end), spelled
