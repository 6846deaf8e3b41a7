"""What a value holds: the parts of records and options, of mappings and of lists. A tree is whole."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any, get_args

from derive.expression.nodes import Expr

WHOLE = (*get_args(Expr), str, bytes, int, float, type)


def held(value: Any) -> tuple[Any, ...]:
    """The values directly inside, in order, those of a mapping with their keys before them."""
    if isinstance(value, tuple):  # what most are, first: the others take long to tell
        return () if value and isinstance(value[0], float) else value  # nothing is in the places of a curve
    if isinstance(value, WHOLE):
        return ()
    if isinstance(value, Mapping):
        return tuple(part for pair in value.items() for part in pair)
    if isinstance(value, Iterable):  # the options of a question are pairs of a name and a value
        return tuple(value)
    return tuple(getattr(value, each.name) for each in fields(value)) if is_dataclass(value) else ()


def every(value: Any) -> Iterator[Any]:
    """A value and all that is inside, parents first."""
    pending = [value]
    while pending:
        part = pending.pop()
        yield part
        pending.extend(held(part)[::-1])
