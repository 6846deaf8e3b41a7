"""What could stand at a place of a value, found in the JSON Schema of its type."""

from __future__ import annotations

from functools import cache
from typing import Any

from pydantic import TypeAdapter

from derive.sheet.model_schema import model_schema, told_schema
from derive.sheet.source import Route


def branches(adapter: TypeAdapter[Any], route: Route) -> list[dict[str, Any]]:
    """The forms that the value there could have."""
    return _branches(_schema(adapter), route)


def keys(adapter: TypeAdapter[Any], route: Route) -> list[str]:
    """The keys that the value there could have."""
    forms = branches(adapter, route)
    return list(dict.fromkeys(key for form in forms for key in form.get("properties", {})))


def lengths(adapter: TypeAdapter[Any], route: Route) -> set[int]:
    """How many values a list could have there, where that is fixed."""
    return {len(form.get("prefixItems", ())) for form in branches(adapter, route)} - {0}


def purpose(adapter: TypeAdapter[Any], route: Route) -> str:
    """What the field there is for, in the words of its model; empty where it is none."""
    forms = _branches(_told(adapter), route[:-1]) if route else []
    fields = (form.get("properties", {}).get(route[-1], {}) for form in forms)
    return next((str(field["said"]) for field in fields if "said" in field), "")


def _branches(schema: dict[str, Any], route: Route) -> list[dict[str, Any]]:
    """What the value there could be."""
    branches = [schema]
    for step in route:
        branches = [part for branch in branches for part in _parts(schema, branch, step)]
    return [flat for branch in branches for flat in _flat(schema, branch)]


@cache
def _told(adapter: TypeAdapter[Any]) -> dict[str, Any]:
    return told_schema(adapter)


@cache
def _schema(adapter: TypeAdapter[Any]) -> dict[str, Any]:
    return model_schema(adapter)


def _flat(schema: dict[str, Any], branch: dict[str, Any]) -> list[dict[str, Any]]:
    """The branch with references resolved and alternatives spread out."""
    if "$ref" in branch:
        return _flat(schema, schema["$defs"][branch["$ref"].rsplit("/", 1)[-1]])
    options = [*branch.get("anyOf", ()), *branch.get("oneOf", ())]
    return [flat for option in options for flat in _flat(schema, option)] if options else [branch]


def _parts(schema: dict[str, Any], branch: dict[str, Any], step: str | int) -> list[dict[str, Any]]:
    found = []
    for flat in _flat(schema, branch):
        if isinstance(step, int):
            prefix = flat.get("prefixItems", [])
            found.append(prefix[step] if step < len(prefix) else flat.get("items"))
        else:
            found.append(flat.get("properties", {}).get(step, flat.get("additionalProperties")))
    return [part for part in found if isinstance(part, dict)]
