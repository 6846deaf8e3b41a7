"""JSON Schema of the sheet language, for editors, made from the models."""

from __future__ import annotations

from typing import Any

from pydantic import TypeAdapter

from derive.kinds import registry as kinds
from derive.kinds.fields import described
from derive.sheet.faults import model_schema
from derive.sheet.given import GivenAsked, GivenProblem, GivenQuestion, GivenSheet
from derive.sheet.subjects import registry as subjects

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def sheet_schema() -> dict[str, Any]:
    """The schema of a whole sheet, every subject and every kind with its options included."""
    definitions: dict[str, Any] = {}
    sheet = _schema(GivenSheet, definitions)
    problems = [_problem(subject, definitions) for subject in subjects.subjects()]
    sheet["properties"]["problems"]["items"] = {"anyOf": problems}
    return {"$schema": DIALECT, **sheet, "title": "Exercise sheet", "$defs": definitions}


def _problem(subject: str, definitions: dict[str, Any]) -> dict[str, Any]:
    """A problem with this subject: a list of questions, or one question on the problem itself."""
    problem = _schema(GivenProblem, definitions)["properties"]
    given = _schema(subjects.load(subject).Given, definitions)
    file = {"type": "string", "pattern": r"\.ya?ml$", "description": "a file below the folder of the sheet"}
    shared = {**problem, subject: {"anyOf": [given, file]}}
    asked = _asked(subject, GivenQuestion, {}, definitions)
    several = _closed(
        {**shared, "questions": {"type": "array", "items": {"anyOf": asked}}}, [subject, "questions"]
    )
    return {"anyOf": [several, *_asked(subject, GivenAsked, shared, definitions)]}


def _asked(
    subject: str, model: type[GivenAsked], shared: dict[str, Any], definitions: dict[str, Any]
) -> list[dict[str, Any]]:
    """A question of each kind, with its options beside `find`."""
    found = []
    for kind in kinds.kinds_of(subject):
        options = _schema(kinds.load(subject, kind).Options, definitions)
        common = _schema(model, definitions)["properties"]
        own = options.get("properties", {})
        for name in described(kinds.load(subject, kind).Options):
            own[name] = _schema(subjects.load(name).Given, definitions)
        both = {key: {"anyOf": [shared[key], own[key]]} for key in shared.keys() & own.keys()}
        properties = {**shared, **common, **own, **both, "find": {"const": kind}}
        required = ["find", *([subject] if shared else ()), *options.get("required", ())]
        found.append(_closed(properties, required))
    return found


def _closed(properties: dict[str, Any], required: list[str]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "required": required, "additionalProperties": False}


def _schema(model: Any, definitions: dict[str, Any]) -> dict[str, Any]:
    """The schema of a model; what it refers to goes to the definitions of the whole."""
    schema = model_schema(TypeAdapter(model))
    definitions.update(schema.pop("$defs", {}))
    return schema
