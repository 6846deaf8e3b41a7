"""The JSON Schema for editors: small, chosen by keys, true to every sheet that builds, strict on others."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from click.testing import CliRunner
from jsonschema import Draft202012Validator
from ruamel.yaml import YAML

from derive.catalogue import starter
from derive.cli import main
from derive.kinds import registry as kinds
from derive.render.questions import example_of
from derive.sheet.subjects import registry as subjects
from tests.sheets import ROOT
from tests.test_docs import EXAMPLES

MOST = 250_000  # characters: what an editor reads at every start
SHEETS = {path.stem: path.read_text(encoding="utf-8") for path in sorted((ROOT / "exercises").glob("*.yaml"))}
SHEETS |= {text.splitlines()[0]: text for text in EXAMPLES}
SHEETS |= {
    f"{subject} {kind}": example_of(module)
    for subject in subjects.subjects()
    for kind, module in kinds.kinds_of(subject).items()
}
SHEETS |= {"tour": starter("tour", None)}
ARM = "robot: {links: [{theta: theta1*, d: 0, a: l, alpha: 0}]}"


@pytest.fixture(scope="module")
def printed() -> str:
    return CliRunner().invoke(main, ["schema"]).output


@pytest.fixture(scope="module")
def schema(printed: str) -> Draft202012Validator:
    whole = json.loads(printed)
    Draft202012Validator.check_schema(whole)
    return Draft202012Validator(whole)


def read(text: str) -> Any:
    """As an editor reads it: YAML, whose dates are text."""
    return json.loads(json.dumps(YAML(typ="safe", pure=True).load(text), default=str))


def test_it_is_small(printed: str) -> None:
    assert len(printed) < MOST


def test_subjects_and_kinds_are_chosen_and_not_tried(schema: Draft202012Validator) -> None:
    problem = schema.schema["$defs"]["problem"]
    assert "anyOf" not in problem and "oneOf" not in problem
    chosen = [branch["if"]["required"] for branch in problem["allOf"] if "then" in branch]
    assert chosen == [[subject] for subject in subjects.subjects()]


@pytest.mark.parametrize("text", SHEETS.values(), ids=SHEETS)
def test_every_sheet_is_valid(text: str, schema: Draft202012Validator) -> None:
    assert [error.message for error in schema.iter_errors(read(text))] == []


def test_every_robot_in_a_file_of_its_own_is_valid(schema: Draft202012Validator) -> None:
    robot = Draft202012Validator({"$ref": "#/$defs/robot", "$defs": schema.schema["$defs"]})
    for path in (ROOT / "exercises" / "robots").glob("*.yaml"):
        assert [error.message for error in robot.iter_errors(read(path.read_text(encoding="utf-8")))] == []


@pytest.mark.parametrize(
    ("problem", "said"),
    [
        (f"{ARM}\n  find: jacobiam", "'jacobiam' is not one of"),
        (f"{ARM}\n  find: jacobian\n  row: [vx]", "'row' was unexpected"),
        (f"{ARM}\n  find: jacobian\n  rows: [vq]", "'vq' is not one of"),
        (f"{ARM}\n  find: jacobian\n  controller: {{P: K}}", "'controller' was unexpected"),
        (f"{ARM}\n  questions: [{{find: jacobian, in: world}}]", "'world' is not one of"),
        (f"{ARM}\n  questions: [{{find: jacobian, marsk: 3}}]", "'marsk' was unexpected"),
        (f"{ARM}\n  questions: [{{text: a}}]", "'find' is a required property"),
        (f"{ARM}\n  questions: [{{find: velocity}}]\n  marks: 3", "'marks' was unexpected"),
        (f"{ARM}\n  motor: {{control: armature}}\n  find: jacobian", "False schema does not allow"),
        (f"{ARM}", "'find' is a required property"),
        ("robot: {links: []}\n  find: jacobian", "is not valid under any"),
        ("text: only words\n  find: jacobian", "is not of type"),
        ("motor: {control: armature, output: angel}\n  find: transfer-function", "is not valid under any"),
    ],
)
def test_what_is_wrong_is_marked(problem: str, said: str, schema: Draft202012Validator) -> None:
    found = [error.message for error in schema.iter_errors(read(f"title: a\nproblems:\n- {problem}\n"))]
    assert any(said in message for message in found), found


def test_every_value_of_find_is_described(schema: Draft202012Validator) -> None:
    definitions = schema.schema["$defs"]
    for subject in subjects.subjects():
        find = definitions[f"{subject}-question"]["properties"]["find"]
        find = definitions[find["$ref"].rpartition("/")[2]] if "$ref" in find else find
        assert find["enum"] == list(kinds.kinds_of(subject))
        assert all(find["enumDescriptions"])
        assert definitions[subject]["description"]


def test_every_reference_leads_somewhere(printed: str, schema: Draft202012Validator) -> None:
    named = {text.split('"')[0] for text in printed.split('"$ref": "#/$defs/')[1:]}
    assert named == schema.schema["$defs"].keys()


def test_every_field_is_described(schema: Draft202012Validator) -> None:
    """By the text below it in its model."""
    definitions = {"sheet": schema.schema, **schema.schema["$defs"]}
    fields = [(f"{name}.{key}", field) for name, part in definitions.items() for key, field in _fields(part)]
    assert len(fields) > 300
    subject = {f"#/$defs/{name}" for name in subjects.subjects()}
    silent = [
        name
        for name, field in fields
        if len(field.get("description", "")) < 8 and field.get("$ref") not in subject
    ]
    assert silent == []


def _fields(part: Any) -> Iterator[tuple[str, Any]]:
    """The fields of a schema and of all that stands in it, but for the tests of a choice."""
    if isinstance(part, list):
        for inner in part:
            yield from _fields(inner)
    if isinstance(part, dict):
        fields = part.get("properties", {})
        yield from (
            (key, field) for key, field in fields.items() if field and key not in ("questions", "find")
        )
        for key, inner in part.items():
            if key not in ("if", "$defs"):
                yield from _fields(list(inner.values()) if key == "properties" else inner)
