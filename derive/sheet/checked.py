"""Plain data brought into a pydantic type, its faults retold in terms of the file."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Any

from pydantic import TypeAdapter, ValidationError

from derive.errors import SheetErrors
from derive.sheet.faults import retell
from derive.sheet.source import At


def checked(
    kind: Any, at: At, data: Any, names: frozenset[str] = frozenset(), more: Iterable[str] = ()
) -> Any:
    """`data`, which stands at `at`, as a value of the type. Raises SheetErrors.

    `names` are the declared symbols; `more` are further keys that are allowed beside.
    """
    adapter = _adapter(kind)
    try:
        return adapter.validate_python(data, context={"names": names})
    except ValidationError as error:
        raise SheetErrors(retell(error, at, adapter, more)) from error


@cache
def _adapter(kind: Any) -> TypeAdapter[Any]:
    return TypeAdapter(kind)
