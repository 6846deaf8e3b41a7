"""Names under `where` and `symbols` that nothing on the sheet uses: most are misspelt."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from difflib import get_close_matches
from typing import Any

from derive.errors import SheetError
from derive.expression import free_symbols
from derive.kinds.problem import expressions
from derive.sheet.model import Problem
from derive.sheet.source import At, Route

WORD = re.compile(r"[^\W\d_]\w*")
PROSE = frozenset({"title", "text", "hint"})
GAINS = ("K_p", "K_i", "K_d")
SILENT = frozenset(("g", "t", "s", "x", "y", "z", *GAINS))  # in an answer though nobody typed them
DECLARED = ("where", "symbols")


def unused(at: At, problems: Sequence[Problem]) -> Iterator[SheetError]:
    """A warning for each, at its place."""
    used = SILENT.union(*(free_symbols(tree) for each in problems for tree in expressions(each.subject)))
    used = used.union(*(free_symbols(tree) for each in problems for tree in each.where.values()))
    used |= {word for text in _texts(at.value()) for word in WORD.findall(text.replace("{", ""))}
    known = {name.replace("_", ""): name for name in sorted(used)}
    for route in _declared(at.value()):
        name = str(route[-1])
        if name not in used and not re.fullmatch(r"r_?\d\d", name):
            meant = known.get(name.replace("_", "")) or next(iter(get_close_matches(name, used, 1, 0.85)), "")
            if not meant and "symbols" in route:  # an assumption about a name of the answer
                continue
            hint = f"did you mean {meant}?" if meant else "leave it out, if nothing is missing"
            yield SheetError(f"nothing on this sheet uses '{name}'", at.key(route), hint)


def _declared(data: Any) -> Iterator[Route]:
    """Where each name stands: of the sheet, and of its problems."""
    problems = data.get("problems", ())
    for route, holder in (((), data), *((("problems", k), each) for k, each in enumerate(problems))):
        for key in DECLARED:
            names = holder.get(key) if isinstance(holder, dict) else None
            yield from ((*route, key, name) for name in (names if isinstance(names, dict) else ()))


def _texts(value: Any) -> Iterator[str]:
    """Every formula that was typed: no prose, and no name that is only declared."""
    if isinstance(value, dict):
        for key, part in value.items():
            if key not in PROSE and key not in DECLARED:
                yield str(key)
                yield from _texts(part)
    elif isinstance(value, list):
        for part in value:
            yield from _texts(part)
    elif isinstance(value, str):
        yield value
