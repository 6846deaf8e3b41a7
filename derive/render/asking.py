"""Whether a text asks anything: a text that only describes is followed by the question of its kind."""

from __future__ import annotations

import re

VERBS = (
    "analyse analyze answer apply assign build calculate check choose close combine compare "
    "complete compute count decide derive describe design determine discuss draw estimate "
    "evaluate examine explain express fill find fit follow give identify linearise linearize list "
    "make name obtain plot prove read reduce say show simulate sketch solve state test use verify "
    "work write"
)
BEGINS = r"(?:^|[.!?:;,]\s+|\band\s+|^\s*[-*\d.]+\s+)(?:then |now |also |please )?"
CLAUSE = re.compile(rf"{BEGINS}(?:{VERBS.replace(' ', '|')})\b", re.IGNORECASE | re.MULTILINE)


def asks(text: str) -> bool:
    """Whether a question mark stands in it, or a clause begins with a verb that asks for something."""
    return "?" in text or CLAUSE.search(text) is not None
