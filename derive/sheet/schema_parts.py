"""A JSON Schema made small and fit for YAML: no titles made of names, shared forms once, scalars as typed."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

Part: TypeAlias = dict[str, Any]
REFERENCE = "#/$defs/"
LONG = 90  # characters from which a form that stands in several places is written once
BY_NAME = ("properties", "$defs")
LISTS = ("anyOf", "oneOf", "allOf", "prefixItems")
SINGLE = (
    "items",
    "additionalProperties",
    "unevaluatedProperties",
    "if",
    "then",
    "else",
    "not",
    "propertyNames",
)
ANNOTATIONS = ("title", "description", "default")


def trimmed(schema: Part) -> Part:
    """Without the titles that only spell the name of a field, and without defaults that say nothing."""

    def trim(part: Part) -> Part:
        if "properties" in part:
            fields = {
                name: _described(field) if field else field for name, field in part["properties"].items()
            }
            part = {**part, "properties": fields}
        if part.get("default", 0) in ("", None, [], {}):
            part = {key: value for key, value in part.items() if key != "default"}
        return _optional(part)

    return _mapped(schema, trim)


def _described(field: Part) -> Part:
    """What a field is for, and which sort of value it takes."""
    said, form = (str(field.get(key, "")) for key in ("said", "description"))
    rest = {key: value for key, value in field.items() if key not in ("title", "said")}
    if said and form:
        form = f"{said} [{form}]"
    return {**rest, **({"description": form or said} if form or said else {})}


def _optional(part: Part) -> Part:
    """Leaving a key out is how nothing is said: no `null` among the forms of a value."""
    forms = [form for form in part.get("anyOf", ()) if form.get("type") != "null"]
    if len(forms) == len(part.get("anyOf", ())):
        return part
    rest = {key: value for key, value in part.items() if key != "anyOf"}
    return {**rest, "anyOf": forms} if len(forms) > 1 else {**forms[0], **rest}


def of_yaml(schema: Part) -> Part:
    """Where text is wanted YAML may see a number or a truth: `date: 2023`, `evaluate: true`."""

    def widen(part: Part) -> Part:
        if part.get("type") == "string" and "pattern" not in part and "enum" not in part:
            part = {**part, "type": ["string", "number", "boolean"] if "const" not in part else "string"}
        if part.get("const") in ("true", "false"):
            part = {key: value for key, value in part.items() if key not in ("const", "type")}
            part["enum"] = [True]
        return part

    return _mapped(schema, widen)


def reached(schema: Part) -> Part:
    """Without definitions that nothing leads to."""
    waiting, seen = [{**schema, "$defs": {}}], set[str]()
    while waiting:
        named = {part["$ref"].removeprefix(REFERENCE) for part in _parts(waiting.pop()) if "$ref" in part}
        waiting += [schema["$defs"][name] for name in named - seen]
        seen |= named
    return {**schema, "$defs": {name: part for name, part in schema["$defs"].items() if name in seen}}


def named(schema: Part) -> Part:
    """Definitions of models under short names: those of the classes, numbered where two share one."""
    short: dict[str, str] = {}
    for name in schema["$defs"]:
        plain = name.rpartition("__")[2]
        taken = set(short.values()) | schema["$defs"].keys() - {name}
        tries = (plain, *(f"{plain}{index}" for index in range(2, 100)))
        short[name] = next(each for each in tries if each == name or each not in taken)
    moved = {f"{REFERENCE}{old}": f"{REFERENCE}{new}" for old, new in short.items()}

    def rename(part: Part) -> Part:
        return {**part, "$ref": moved[part["$ref"]]} if "$ref" in part else part

    definitions = {short[name]: _mapped(part, rename) for name, part in schema["$defs"].items()}
    return {**_mapped({**schema, "$defs": {}}, rename), "$defs": definitions}


def hoisted(schema: Part) -> Part:
    """Forms that stand in several places, each written once among the definitions."""
    roots = {id(part) for part in (schema, *schema["$defs"].values())}
    counted = Counter(_form(part) for part in _parts(schema) if id(part) not in roots)
    shared = [form for form, times in counted.items() if times > 1 and len(form) > LONG]
    names = {form: f"form-{index}" for index, form in enumerate(shared, 1)}

    def refer(part: Part, top: bool = False) -> Part:
        if not top and (name := names.get(_form(part))):
            return {"$ref": f"{REFERENCE}{name}", **_annotations(part)}
        return _each(part, refer)

    written = {name: refer(json.loads(form), True) for form, name in names.items()}
    definitions = {name: refer(part, True) for name, part in schema["$defs"].items()}
    return _without_detours({**refer({**schema, "$defs": {}}, True), "$defs": {**definitions, **written}})


def _without_detours(schema: Part) -> Part:
    """What was written once and is wanted in one place after all stands there again."""
    used = Counter(part["$ref"].removeprefix(REFERENCE) for part in _parts(schema) if "$ref" in part)
    once = {name for name in schema["$defs"] if name.startswith("form-") and used[name] == 1}

    def back(part: Part) -> Part:
        name = part.get("$ref", "").removeprefix(REFERENCE)
        if name in once:
            return _each({**schema["$defs"][name], **_annotations(part)}, back)
        return _each(part, back)

    definitions = {name: back(part) for name, part in schema["$defs"].items() if name not in once}
    return {**back({**schema, "$defs": {}}), "$defs": definitions}


def _mapped(part: Part, change: Callable[[Part], Part]) -> Part:
    """The schema with every schema in it changed, the inner ones first."""
    return change(_each(part, lambda inner: _mapped(inner, change)))


def _each(part: Part, change: Callable[[Part], Part]) -> Part:
    """The schema with each schema that stands directly in it changed."""

    def changed(key: str, value: Any) -> Any:
        if key in BY_NAME:
            return {
                name: change(inner) if isinstance(inner, dict) else inner for name, inner in value.items()
            }
        if key in LISTS:
            return [change(inner) for inner in value]
        return change(value) if key in SINGLE and isinstance(value, dict) else value

    return {key: changed(key, value) for key, value in part.items()}


def _parts(part: Part) -> Iterator[Part]:
    """The schema and every schema in it."""
    found: list[Part] = []

    def keep(inner: Part) -> Part:
        found.append(inner)
        return _each(inner, keep)

    keep(part)
    return iter(found)


def _form(part: Part) -> str:
    """What the schema demands, whatever is said of it."""
    return json.dumps({key: value for key, value in part.items() if key not in ANNOTATIONS}, sort_keys=True)


def _annotations(part: Part) -> Part:
    return {key: value for key, value in part.items() if key in ANNOTATIONS}
