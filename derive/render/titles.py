"""What a sheet is called without its solutions."""

from __future__ import annotations

import re

from derive.render.skin import english

ANSWERED = r"(?:worked |model )?(?:answer key|key|solutions?|answers?)"
WITHOUT: tuple[tuple[str, str], ...] = (
    (rf"\b(exercise|problem|question)s?(?:'s)? {ANSWERED}\b", r"\1s"),  # Exercise solutions for week 3
    (rf"^{ANSWERED} (?:to|of|for) (?:the )?", ""),  # Solutions to sheet 2
    (rf"[\s:,(\u2013\u2014-]*(?:\b(?:with|and) )?\b{ANSWERED}\)?$", ""),  # Sheet 2: solutions
)


def without_solutions(title: str) -> str:
    """The title of the problems: that of the sheet, but for what it says of solutions. Where it says nothing
    else, a word of ours."""
    for pattern, instead in WITHOUT:
        found = re.sub(pattern, instead, title.strip(), count=1, flags=re.IGNORECASE)
        if found != title.strip():
            return found[:1].upper() + found[1:] or english("problems")
    return title
