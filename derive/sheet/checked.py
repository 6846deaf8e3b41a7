"""Plain data brought into a pydantic type, its faults retold in terms of the file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from typing import Any

from pydantic import BaseModel, TypeAdapter, ValidationError

from derive.errors import SheetError, SheetErrors
from derive.sheet.faults import retell
from derive.sheet.source import At, Route


def checked(
    kind: Any, at: At, data: Any, names: frozenset[str] = frozenset(), more: Iterable[str] = ()
) -> Any:
    """`data`, which stands at `at`, as a value of the type. Raises SheetErrors.

    `names` are the declared symbols; `more` are further keys that are allowed beside.
    """
    adapter = _adapter(kind)
    doubts: list[str] = []
    context = {"names": names, "doubts": doubts, "lonely": at.source.lonely}
    try:
        found = adapter.validate_python(data, context=context)
    except ValidationError as error:
        raise SheetErrors(retell(error, at, adapter, more)) from error
    if doubts:
        at.source.doubts.extend(_doubts(adapter, at, data, context))
    return found


def values_in(given: Any) -> Iterator[tuple[Route, Any]]:
    """Every value of a model that was checked, with its way from here; models, lists and mappings are gone
    through, and what was left out is none."""
    match given:
        case BaseModel():
            fields = type(given).model_fields.items()
            pairs: Iterable[tuple[str | int, Any]] = [(f.alias or n, getattr(given, n)) for n, f in fields]
        case list():
            pairs = enumerate(given)
        case dict():
            pairs = given.items()
        case _:
            pairs = ()
            if given is not None:
                yield (), given
    for step, part in pairs:
        for route, value in values_in(part):
            yield (step, *route), value


def _doubts(adapter: TypeAdapter[Any], at: At, data: Any, context: Mapping[str, Any]) -> Iterator[SheetError]:
    """What is strange about data that fit. Its place is known to errors alone, so it is read once more with
    the doubts raised."""
    try:
        adapter.validate_python(data, context={**context, "telling": True})
    except ValidationError as error:
        yield from (told for told in retell(error, at, adapter) if told.message in context["doubts"])


@cache
def _adapter(kind: Any) -> TypeAdapter[Any]:
    return TypeAdapter(kind)
