"""Nothing that is given is passed over: a field that would change the answer of a kind that does not use it
is a fault at its place.

A subject says which of its optional fields no kind gets wrong that leaves them out (`HARMLESS`: the masses of
an arm whose pose is asked), and which belong to one question of several (`SHARED`: one use is enough).
Every other optional field must stand in `USES` of each kind that is asked; a new one stands nowhere, so that
it cannot be forgotten. Fields of parts are named with a dot, `links.mass`. In the options of a kind,
`ONLY_WITH` says to which value of which option another belongs.
"""

from __future__ import annotations

from collections.abc import Iterator
from types import ModuleType
from typing import Any

from pydantic import BaseModel

from derive.errors import SheetError
from derive.kinds import registry
from derive.sheet.model import Question
from derive.sheet.source import At, Route
from derive.sheet.subjects.registry import load

NONE: frozenset[str] = frozenset()


def ignored(asked: tuple[Question, ...], name: str, given: Any, at: At) -> Iterator[SheetError]:
    """The fields of a subject, as `given` at a place, that a question cannot honour."""
    subject = load(name)
    harmless, shared = getattr(subject, "HARMLESS", NONE), getattr(subject, "SHARED", NONE)
    for route, field in optional(given):
        kinds = [question for question in asked if field not in uses(question.kind)]
        if field in harmless or not kinds or (field in shared and len(kinds) < len(asked)):
            continue
        message = f"'{field}' is not used by {kinds[0].find}"
        yield at.fault(message, route, _remedy(name, field), key=True)


def uses(kind: ModuleType) -> frozenset[str]:
    """The fields of its subject that a kind honours, beyond those that every kind needs."""
    return getattr(kind, "USES", NONE)


def optional(given: Any, route: Route = (), parts: tuple[str, ...] = ()) -> Iterator[tuple[Route, str]]:
    """Every field typed that could have been left out: its way from here, and its name. What is inside of one
    belongs to it."""
    if isinstance(given, list | tuple):
        for index, entry in enumerate(given):
            yield from optional(entry, (*route, index), parts)
    elif isinstance(given, BaseModel):
        for key in type(given).model_fields:
            if key in given.model_fields_set:
                field = type(given).model_fields[key]
                typed = field.alias or key
                if field.is_required():
                    yield from optional(getattr(given, key), (*route, typed), (*parts, typed))
                else:
                    yield (*route, typed), ".".join((*parts, typed))


def idle_options(options: Any, at: At) -> Iterator[SheetError]:
    """The options that belong to another one that was not chosen."""
    only_with: dict[str, tuple[str, Any]] = getattr(options, "ONLY_WITH", {})
    for key, (other, value) in only_with.items():
        if key in options.model_fields_set and getattr(options, other) != value:
            fields = type(options).model_fields
            typed, chosen = fields[key].alias or key, fields[other].alias or other
            hint = f"leave it out, or write {chosen}: {value}"
            yield at.fault(f"'{typed}' is only used with {chosen}: {value}", (typed,), hint, key=True)


def _remedy(name: str, field: str) -> str:
    """Who does use it."""
    kinds = [kind for kind in registry.kinds_of(name) if field in uses(registry.load(name, kind))]
    return f"leave it out, or ask {' or '.join(kinds)}" if kinds else "leave it out"
