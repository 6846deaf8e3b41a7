"""What the README says is done: its sheets build, and its commands are those of the gate."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from derive.build import derive_all
from derive.cli import main
from derive.sheet.load import load_sheet
from derive.writing import render
from tests.sheets import ROOT

README = ROOT / "README.md"
TEXT = README.read_text(encoding="utf-8") if README.is_file() else ""
FENCED = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
BLOCKS = [(found[1], found[2]) for found in FENCED.finditer(TEXT)]
SHEETS = [text for language, text in BLOCKS if language == "yaml" and text.startswith("title:")]
COMMANDS = [
    line.removeprefix("$ ")
    for language, text in BLOCKS
    if language in ("console", "sh", "bash", "shell")
    for line in text.splitlines()
    if line.startswith(("$ ", "python3 ", "derive "))
]
GATE = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
THE_TWO = (
    "python3 -m pip install . && derive exercises/week3.yaml",
    "python3 -m pip install -e '.[test]' && pytest",
)


def test_there_is_a_sheet_to_see() -> None:
    assert SHEETS


@pytest.mark.parametrize("text", SHEETS, ids=[text.splitlines()[0] for text in SHEETS])
def test_its_sheets_build(text: str, tmp_path: Path) -> None:
    path = tmp_path / "sheet.yaml"
    path.write_text(text, encoding="utf-8")
    (document,) = derive_all([load_sheet(path)], True, lambda _: None)
    assert all(question.derivation for _, question in document.questions())
    assert render(document, "md")


@pytest.mark.parametrize("command", THE_TWO)
def test_its_two_commands(command: str) -> None:
    assert command in COMMANDS


@pytest.mark.parametrize("command", THE_TWO)
def test_the_gate_runs_them(command: str) -> None:
    parts = command.replace("install ", "install -q ").split(" && ")
    places = [GATE.find(part) for part in parts]
    assert -1 not in places
    assert places == sorted(places)


@pytest.mark.parametrize("command", [c for c in COMMANDS if c.startswith("derive ")])
def test_its_other_commands_exist(command: str) -> None:
    words = command.split("#")[0].split()[1:]
    name = words[0] if words and words[0] in main.commands else "build"
    found = CliRunner().invoke(main, [name, "--help"])
    assert found.exit_code == 0
    for option in (word.partition("=")[0] for word in words if word.startswith("--")):
        assert option in found.output


@pytest.mark.parametrize("target", sorted(set(re.findall(r"\]\((?!https?:|#)([^)#]+)", TEXT))))
def test_its_links_lead_somewhere(target: str) -> None:
    assert (ROOT / target).exists()
