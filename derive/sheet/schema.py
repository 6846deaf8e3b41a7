"""JSON Schema of the sheet language, for editors, made from the models.

What may stand in a problem is decided by the key of its subject, and beside `find` by the kind that is
asked for (`if`, `then`): an editor offers and marks what belongs there, and does not try all forms in turn.
"""

from __future__ import annotations

import inspect
import json
from collections.abc import Iterable
from functools import cache
from typing import Any, TypeAlias

from pydantic import TypeAdapter

from derive.kinds import registry as kinds
from derive.kinds.fields import described
from derive.sheet.exchange.files import ENDINGS
from derive.sheet.given import ASKED_KEYS, GivenAsked, GivenProblem, GivenQuestion, GivenSheet
from derive.sheet.model_schema import models_schema
from derive.sheet.schema_parts import Part, hoisted, named, of_yaml, reached, trimmed
from derive.sheet.subjects import registry as subjects

DIALECT = "https://json-schema.org/draft/2020-12/schema"
Described: TypeAlias = tuple[str, str]  # a subject, and one that may stand beside it as an option of a kind


def schema_text() -> str:
    """The schema as the text of a file."""
    return json.dumps(sheet_schema(), indent=2, ensure_ascii=False) + "\n"


def sheet_schema() -> Part:
    """The schema of a whole sheet, every subject and every kind with its options included."""
    every = {module: kinds.load(subject, kind) for subject, kind, module in _kinds()}
    models: dict[str, Any] = {"sheet": GivenSheet, "problem": GivenProblem, "asked": GivenAsked}
    models |= {"question": GivenQuestion}
    models |= {subject: subjects.load(subject).Given for subject in subjects.subjects()}
    models |= {_name(module): loaded.Options for module, loaded in every.items()}
    found, shared = models_schema({name: TypeAdapter(model) for name, model in models.items()})
    definitions = {name: _resolved(part, shared) for name, part in found.items()}
    for module, loaded in every.items():
        definitions[_name(module)] = _kind(definitions[_name(module)], loaded.Options, inspect.getdoc(loaded))
    for subject in subjects.subjects():
        about = {"title": subject, "description": _meaning(subject)}
        definitions[subject] = {**about, "anyOf": [_untitled(definitions[subject]), _file(subject)]}
        definitions[f"{subject}-question"] = _asked(subject)
    definitions |= {name: _open(definitions[name]) for name in ("problem", "asked", "question")}
    for name in ("asked", "question"):
        definitions[name]["properties"]["find"].pop("type")  # one of the kinds of the subject
    sheet = definitions.pop("sheet")
    sheet["properties"]["problems"]["items"] = _to("problem")
    definitions["problem"] = _problem(definitions["problem"], definitions)
    whole = {**sheet, "title": "Exercise sheet", "$defs": {**definitions, **shared}}
    return {"$schema": DIALECT, **hoisted(named(reached(of_yaml(trimmed(whole)))))}


def _file(subject: str) -> Part:
    """The path of a file that describes it."""
    endings = (".ya?ml", *(ENDINGS if subject == "robot" else ()))
    pattern = rf"({'|'.join(endings)})$".replace(".", r"\.")
    return {"type": "string", "pattern": pattern, "description": "a file below the folder of the sheet"}


def _problem(own: Part, definitions: dict[str, Part]) -> Part:
    """Its subject decides what may be asked; one question may stand on the problem itself."""
    every = subjects.subjects()
    options = {kind: definitions[kind]["properties"] for kind in map(_name, {kind for *_, kind in _kinds()})}
    properties: Part = dict(own["properties"])
    for name in properties:  # `given` is an option of a kind too, and kinds may stand on the problem
        forms = [properties[name], *(option[name] for option in options.values() if name in option)]
        said = {"said": properties[name]["said"]}
        properties[name] = {"anyOf": list(map(_unsaid, forms)), **said} if len(forms) > 1 else forms[0]
    properties["questions"] = {"type": "array", "minItems": 1, "description": "The questions, in order."}
    return {
        **own,
        "title": "Problem",
        "properties": properties,
        "required": [],
        "allOf": [_some_subject(every), *({"if": _subject_is(each), "then": _about(each)} for each in every)],
        "if": {"required": ["questions"]},
        "else": _to("asked"),
        "unevaluatedProperties": False,
    }


def _some_subject(every: Iterable[str]) -> Part:
    """Where none is given all are offered, and no form is right; editors print the message."""
    said = f"A problem has a subject: {', '.join(every)}."
    given = {"anyOf": [{"required": [subject]} for subject in every]}
    offered = {subject: _to(subject) for subject in every}
    return {"if": given, "else": {"type": "null", "errorMessage": said, "properties": offered}}


def _subject_is(subject: str) -> Part:
    """Whether this is what a problem is about, and no option of a kind that is described like a subject."""
    beside = [{"required": [other]} for other, option in _described() if option == subject]
    return {"required": [subject], **({"not": {"anyOf": beside}} if beside else {})}


def _about(subject: str) -> Part:
    """What a subject brings into a problem: no other subject, and questions, or the options of one beside
    `find`."""
    own = [subject, *(option for owner, option in sorted(_described()) if owner == subject)]
    known: Part = dict.fromkeys(subjects.subjects(), False) | {name: _to(name) for name in own}
    asked = {"allOf": [_to("question"), _to(f"{subject}-question")], "unevaluatedProperties": False}
    listed = {"properties": {**known, "questions": {"items": asked}}}
    return {**listed, "if": {"required": ["questions"]}, "else": _to(f"{subject}-question")}


def _asked(subject: str) -> Part:
    """A question about a subject: which kinds there are, and the options of each."""
    every = kinds.kinds_of(subject)
    find = {"enum": list(every), "enumDescriptions": [_first_line(subject, kind) for kind in every]}
    chosen = [
        {"if": {"properties": {"find": {"const": kind}}, "required": ["find"]}, "then": _to(_name(module))}
        for kind, module in every.items()
        if _has_options(subject, kind)
    ]
    return {"properties": {"find": find}, **({"allOf": chosen} if chosen else {})}


def _kind(options: Part, model: Any, doc: str | None) -> Part:
    """The options of one kind, but for those that stand beside `find` whatever the kind."""
    own = {name: part for name, part in options.get("properties", {}).items() if name not in ASKED_KEYS}
    own |= {name: {**_to(name), "said": own[name]["said"]} for name in described(model)}
    wanted = {"required": options["required"]} if options.get("required") else {}
    return {"title": (doc or "").partition("\n")[0], "description": doc or "", "properties": own, **wanted}


@cache
def _kinds() -> tuple[tuple[str, str, str], ...]:
    """Every subject with each of its kinds and the module of that."""
    every = subjects.subjects()
    return tuple((subject, *each) for subject in every for each in kinds.kinds_of(subject).items())


@cache
def _described() -> frozenset[Described]:
    found = ((subject, described(kinds.load(subject, kind).Options)) for subject, kind, _ in _kinds())
    return frozenset((subject, option) for subject, options in found for option in options)


def _has_options(subject: str, kind: str) -> bool:
    return bool(kinds.load(subject, kind).Options.model_fields.keys() - ASKED_KEYS)


def _resolved(part: Part, shared: dict[str, Part]) -> Part:
    """The definition itself, where all that a model gave is a reference to it."""
    return dict(shared[part["$ref"].rpartition("/")[2]]) if part.keys() == {"$ref"} else part


def _open(part: Part) -> Part:
    """A part of what may stand somewhere; what is in none of the parts is refused by the whole."""
    return {key: value for key, value in part.items() if key != "additionalProperties"}


def _untitled(part: Part) -> Part:
    return {key: value for key, value in part.items() if key not in ("title", "description")}


def _unsaid(part: Part) -> Part:
    return {key: value for key, value in part.items() if key not in ("title", "said", "default")}


def _to(name: str) -> Part:
    return {"$ref": f"#/$defs/{name}"}


def _name(module: str) -> str:
    return module.removeprefix("derive.kinds.").replace("_", "-")


def _meaning(subject: str) -> str:
    return (inspect.getdoc(subjects.load(subject)) or "").partition("\n")[0].partition(": ")[2]


def _first_line(subject: str, kind: str) -> str:
    return (inspect.getdoc(kinds.load(subject, kind)) or "").partition("\n")[0]
