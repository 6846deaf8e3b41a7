"""What a sheet is called without its solutions."""

from __future__ import annotations

import re

ANSWERED = r"(?:worked |model )?(?:solutions?|answers?|answer key|key)"
WITHOUT: tuple[
    tuple[str, str], ...
] = (  # "Exercise solutions for week 3", "Solutions to sheet 2", "Sheet 2: solutions"
    (rf"\b(exercise|problem|question)s?(?:'s)? {ANSWERED}\b", r"\1s"),
    (rf"^{ANSWERED} (?:to|of|for) (?:the )?", ""),
    (rf"\s*(?:[:,(\u2013\u2014-]\s*)?(?:with |and )?\b{ANSWERED}\b\)?", ""),
)
TELLING = re.compile(r"\b(?:solutions?|answers?|answer key)\b", re.IGNORECASE)


def without_solutions(title: str) -> str:
    """The title of the problems: that of the sheet, but for what it says of solutions."""
    if not TELLING.search(title):
        return title
    for pattern, instead in WITHOUT:
        found = re.sub(pattern, instead, title, count=1, flags=re.IGNORECASE).strip(" :,-")
        if found and found != title and not TELLING.search(found):
            return found[0].upper() + found[1:]
    return title
