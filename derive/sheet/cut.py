"""Texts that YAML cut at a comma: in `{text: Find J (linear, then angular)}` the last words are a key."""

from __future__ import annotations

import re

from derive.errors import SheetError
from derive.sheet.source import At, Route

DIGITS = re.compile(r"[+-]?\d+")


def cut_off(at: At, route: Route) -> Route | None:
    """The way to the outermost key on this way that is the rest of a text cut at a comma."""
    ways = (route[:length] for length in range(1, len(route) + 1))
    return next((way for way in ways if _is_rest(at, way)), None)


def before(at: At, rest: Route) -> Route:
    """The way to the value in front of such a key, to which it belongs."""
    keys = list(at.value(rest[:-1]))
    return (*rest[:-1], keys[max(keys.index(rest[-1]) - 1, 0)])


def cut_fault(at: At, rest: Route) -> SheetError:
    """The fault of such a key."""
    first, last = at.value(before(at, rest)), str(rest[-1])
    hint = "put quotes around a text with a comma in it"
    if isinstance(first, str) and DIGITS.fullmatch(first) and last.isdigit():
        hint = f"write a decimal with a point: {first}.{last}"
    return at.fault(f"'{last}' was cut off at the comma before it", rest, hint, key=True)


def _is_rest(at: At, route: Route) -> bool:
    """Whether this key follows a comma and has no value, or closes a bracket that it does not open."""
    key = route[-1]
    if not isinstance(key, str) or not isinstance(at.value(route[:-1]), dict):
        return False
    place = at.key(route)
    if not place.text[: place.column - 1].rstrip().endswith(","):
        return False
    behind = place.text[place.column - 1 + len(key) :].lstrip()
    bare = at.value(route) is None and not behind.startswith((":", '"', "'"))
    return bare or (")" in key and "(" not in key)
