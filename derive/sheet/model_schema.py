"""JSON Schemas of the models, with what their authors say of each field: the text that stands below it."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from itertools import pairwise
from typing import Any, Literal, TypeAlias

from pydantic import BaseModel, TypeAdapter
from pydantic.json_schema import GenerateJsonSchema

Part: TypeAlias = dict[str, Any]


class _Quiet(GenerateJsonSchema):
    def emit_warning(self, kind: Any, detail: str) -> None:
        """Formulas as defaults are left out of a schema; older releases of pydantic would say so."""


class _Told(_Quiet):
    """With the first sentence on a model as its title, and what is said of every field under `said`: its
    description is that of what may stand there."""

    def model_schema(self, schema: Any) -> Part:
        found = super().model_schema(schema)
        found["title"] = _sentence(inspect.getdoc(schema["cls"]) or "")
        said = told(schema["cls"])
        for name, field in schema["cls"].model_fields.items():
            part = found.get("properties", {}).get(field.alias or name)
            if part is not None and name in said:
                part["said"] = said[name]
        return found


def _sentence(text: str) -> str:
    return " ".join(text.split()).partition(". ")[0].rstrip(".").replace("`", "")


def model_schema(adapter: TypeAdapter[Any]) -> Part:
    """The JSON Schema of a type, without a word where a default value has no JSON of its own."""
    return adapter.json_schema(schema_generator=_Quiet)


def told_schema(adapter: TypeAdapter[Any]) -> Part:
    """The same with what is said of every field."""
    return adapter.json_schema(schema_generator=_Told)


def models_schema(adapters: Mapping[str, TypeAdapter[Any]]) -> tuple[dict[str, Part], dict[str, Part]]:
    """The JSON Schemas of several types, each by its name, and the definitions that they share."""
    mode: Literal["validation"] = "validation"
    inputs = [(name, mode, adapter) for name, adapter in adapters.items()]
    found, shared = TypeAdapter.json_schemas(inputs, schema_generator=_Told)
    return {name: part for (name, _), part in found.items()}, shared.get("$defs", {})


@cache
def told(model: type[BaseModel]) -> Mapping[str, str]:
    """What stands below each field of a model and of those that it extends."""
    return {name: text for each in reversed(model.__mro__) for name, text in _below_fields(each)}


def _below_fields(model: type[Any]) -> Iterator[tuple[str, str]]:
    if not issubclass(model, BaseModel) or model is BaseModel:
        return
    written = _classes(model.__module__).get(model.__name__)
    for field, text in pairwise(written.body if written else ()):
        match field, text:
            case ast.AnnAssign(target=ast.Name(name)), ast.Expr(value=ast.Constant(str(said))):
                yield name, " ".join(said.split())


@cache
def _classes(module: str) -> Mapping[str, ast.ClassDef]:
    """The classes of a module as they are written, by name."""
    tree = ast.parse(inspect.getsource(import_module(module)))
    return {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
