"""The tutorial and the how-tos are followed to the letter: their files are written, their commands typed."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from tests.commands import run
from tests.sheets import ROOT

DOCS = ROOT / "docs"
GUIDES = [DOCS / "tutorial.md", *sorted((DOCS / "how-to").glob("*.md"))]
COURSE = ROOT / "examples" / "course"
STEP = re.compile(r"^(?:`([^`\n]+)`\n\n)?```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def steps(page: Path) -> Iterator[tuple[str, str, str]]:
    """Every block of a page: the file that it is, if it is one, its language and its text."""
    for found in STEP.finditer(page.read_text(encoding="utf-8")):
        yield found[1] or "", found[2], found[3]


def commands(block: str) -> Iterator[tuple[str, str]]:
    """Commands, each with what it is shown to print."""
    for typed in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
        command, _, shown = typed.partition("\n")
        yield command, shown


def printed(command: str, environment: dict[str, str]) -> tuple[int, str]:
    """The exit status and all that a command prints; `derive` alone is run without a new process."""
    if command.startswith("derive ") and not set(command) & set("|&;<>'\""):
        done = run(*command.split()[1:])
        return done.exit_code, done.output
    ended = subprocess.run(
        ["bash", "-c", command], capture_output=True, text=True, env=environment, check=False
    )
    return ended.returncode, ended.stdout + ended.stderr


@pytest.fixture
def shell(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """An empty folder to work in, and an environment that has the command."""
    tools = tmp_path / "bin"
    tools.mkdir()
    (tools / "derive").write_text(f'#!/bin/sh\nexec {sys.executable} -m derive "$@"\n', encoding="utf-8")
    (tools / "derive").chmod(0o755)
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    return {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}


@pytest.mark.parametrize("page", GUIDES, ids=[page.stem for page in GUIDES])
def test_a_guide_can_be_followed(page: Path, shell: dict[str, str]) -> None:
    for name, language, text in steps(page):
        if name:
            Path(name).parent.mkdir(parents=True, exist_ok=True)
            Path(name).write_text(text, encoding="utf-8")
        elif language == "console":
            for command, shown in commands(text):
                status, said = printed(command, shell)
                wanted = re.escape(shown.strip()).replace(r"\.\.\.", ".*")
                assert re.fullmatch(wanted, said.strip(), re.DOTALL), f"$ {command}\n{said}"
                assert status == 0 or "fault" in shown or "differs" in shown, command


@pytest.mark.parametrize("page", GUIDES, ids=[page.stem for page in GUIDES])
def test_nothing_on_a_guide_is_left_untried(page: Path) -> None:
    """What is neither a file nor typed is an installation, or waits for Ctrl-C."""
    rest = [text for name, language, text in steps(page) if not name and language != "console"]
    assert all(text.startswith(("python3 -m pip install ", "derive watch ")) for text in rest)


def test_the_course_is_that_of_its_page_and_its_workflow_runs(shell: dict[str, str]) -> None:
    files = {name: text for name, _, text in steps(DOCS / "how-to" / "a-week-with-git.md") if name}
    kept = {path.relative_to(COURSE).as_posix(): path for path in COURSE.rglob("*") if path.is_file()}
    assert {name: path.read_text(encoding="utf-8") for name, path in kept.items()} == files
    for name, text in files.items():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text(text, encoding="utf-8")
    workflow = YAML(typ="safe").load(files[".github/workflows/sheets.yml"])
    typed = [step["run"] for step in workflow["jobs"]["build"]["steps"] if "run" in step]
    assert typed[0].endswith(" install derive-sheets")
    for command in typed[1:]:
        assert printed(command, shell)[0] == 0, command
    assert sorted(path.name for path in Path("output").glob("*.pdf")) == ["week1-problems.pdf", "week1.pdf"]


def test_the_hook_of_the_course_lets_right_sheets_pass(shell: dict[str, str]) -> None:
    (repository,) = YAML(typ="safe").load(COURSE / ".pre-commit-config.yaml")["repos"]
    (hook,) = repository["hooks"]
    sheet = COURSE / "exercises" / "week1.yaml"
    assert re.search(hook["files"], "exercises/week1.yaml")
    assert not re.search(hook["files"], "exercises/robots/arm.yaml")
    assert printed(f"{hook['entry']} {sheet}", shell)[0] == 0
    Path("wrong.yaml").write_text(sheet.read_text(encoding="utf-8").replace("-sa,", "sa,"), encoding="utf-8")
    assert printed(f"{hook['entry']} wrong.yaml", shell)[0] == 1
