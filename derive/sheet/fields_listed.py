"""What may stand in a description, listed for people: the fields of a model and of the models inside it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from pydantic import TypeAdapter

from derive.sheet.model_schema import Part, told_schema

TYPES = {"string": "text", "integer": "a whole number", "number": "a number", "boolean": "true or false"}


@dataclass(frozen=True, slots=True)
class Field:
    """A key, what may stand behind it (with what does where it is left out), and what it is for."""

    name: str
    form: str
    said: str


@dataclass(frozen=True, slots=True)
class Fields:
    """The fields of one form: how it is written, what it is, its keys."""

    form: str
    about: str
    fields: tuple[Field, ...]


def listed(model: Any) -> tuple[Fields, ...]:
    """The forms that a model could have, then those that stand inside them, each once."""
    schema = told_schema(TypeAdapter(model))
    return tuple(_forms(schema, schema))


def _forms(schema: Part, whole: Part) -> Iterator[Fields]:
    waiting, seen = [*_objects(schema, whole)], set[Fields]()
    while waiting:
        part = waiting.pop(0)
        fields = part["properties"]
        form = Fields(
            _keys(part),
            " ".join(str(part.get("description", "")).split()),
            tuple(_field(name, each, whole) for name, each in fields.items()),
        )
        if form in seen:
            continue
        seen.add(form)
        yield form
        waiting += [inner for each in fields.values() for inner in _objects(each, whole)]


def _objects(part: Part, whole: Part) -> Iterator[Part]:
    """The descriptions by keys that may stand there."""
    if "$ref" in part:
        yield from _objects(whole["$defs"][part["$ref"].rpartition("/")[2]], whole)
    elif "properties" in part:
        yield part
    for key in ("anyOf", "oneOf", "prefixItems"):
        for form in part.get(key, ()):
            yield from _objects(form, whole)
    for key in ("items", "additionalProperties"):
        if isinstance(part.get(key), dict):
            yield from _objects(part[key], whole)


def _keys(part: Part) -> str:
    """A form by the keys that it must have, or by all where none must stand."""
    wanted = part.get("required", [])
    more = ["..."] if wanted and len(wanted) < len(part["properties"]) else []
    return "{" + ", ".join([*(wanted or part["properties"]), *more]) + "}"


def _field(name: str, part: Part, whole: Part) -> Field:
    default = part.get("default")
    shown = str(default).lower() if isinstance(default, bool) else default
    said = f" (default {shown})" if default not in (None, "", [], {}) and _plain(default) else ""
    return Field(name, _form(part, whole) + said, str(part.get("said", "")))


def _plain(default: Any) -> bool:
    """Whether it can be told in a word."""
    inner = default if isinstance(default, list) else [default]
    return not any(isinstance(each, dict | list) for each in inner)


def _form(part: Part, whole: Part) -> str:
    if "$ref" in part:
        return _form(whole["$defs"][part["$ref"].rpartition("/")[2]], whole)
    forms = [*part.get("anyOf", ()), *part.get("oneOf", ())]
    if forms:
        several = (_form(form, whole) for form in forms if form.get("type") != "null")
        return " or ".join(dict.fromkeys(several))
    if "enum" in part:
        return " or ".join(map(str, part["enum"]))
    if "const" in part:
        return str(part["const"])
    if "prefixItems" in part:
        forms = [_form(item, whole) for item in part["prefixItems"]]
        return f"{len(forms)} of: {forms[0]}" if len({*forms}) == 1 else f"[{', '.join(forms)}]"
    if "items" in part:
        inner = _form(part["items"], whole)
        return f"a list of: {inner}" if inner else "a list"
    if isinstance(part.get("additionalProperties"), dict):
        return f"names, each with: {_form(part['additionalProperties'], whole)}"
    if "properties" in part:
        return _keys(part)
    return str(part.get("description", "")).replace("\n", " ") or TYPES.get(str(part.get("type")), "")
