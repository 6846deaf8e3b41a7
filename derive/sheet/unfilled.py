"""Keys and entries behind which nothing stands: no field takes them, and none may be passed over."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from derive.errors import Place, SheetError
from derive.sheet.cut import before, cut_fault, cut_off
from derive.sheet.source import At, Route, Source

HINT = "write a value, or leave it out"


def unfilled(source: Source, told: Iterable[SheetError] = ()) -> list[SheetError]:
    """A fault for each of them in a file, but where one is told already."""
    at, known = At(source), [fault.place for fault in told if fault.place]
    return [_fault(at, route) for route in _empty(source.data, ()) if not _told(at, route, known)]


def _fault(at: At, route: Route) -> SheetError:
    rest = cut_off(at, route)
    return at.fault("nothing stands here", route, HINT, key=True) if rest is None else cut_fault(at, rest)


def _told(at: At, route: Route, known: list[Place]) -> bool:
    """Whether a fault is known here, or in the text that this was cut off from."""
    here, rest = at.key(route), cut_off(at, route)
    if here in known or at.place(route) in known:
        return True
    first = None if rest is None else at.place(before(at, rest))
    return first is not None and any(
        first.line == place.line == here.line and first.column <= place.column < here.column
        for place in known
    )


def _empty(data: Any, route: Route) -> Iterator[Route]:
    if _is_set(data):
        return
    if isinstance(data, dict | list):
        for step, value in data.items() if isinstance(data, dict) else enumerate(data):
            yield from _empty(value, (*route, step))
    elif data is None:
        yield route


def _is_set(data: Any) -> bool:
    """Names alone, as in `{K_p, K_i}`: their model judges them."""
    return isinstance(data, dict) and all(value is None for value in data.values())
