"""The JSON Schema of one model, without a word where a default value has no JSON of its own."""

from __future__ import annotations

from typing import Any

from pydantic import TypeAdapter
from pydantic.json_schema import GenerateJsonSchema


class _Quiet(GenerateJsonSchema):
    def emit_warning(self, kind: Any, detail: str) -> None:
        """Formulas as defaults are left out of a schema; older releases of pydantic would say so."""


def model_schema(adapter: TypeAdapter[Any]) -> dict[str, Any]:
    """What pydantic makes of a type."""
    return adapter.json_schema(schema_generator=_Quiet)
