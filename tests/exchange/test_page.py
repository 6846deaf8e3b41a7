"""The files and commands of the page on imports do what stands there."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.commands import run
from tests.sheets import ROOT

PAGE = (ROOT / "docs" / "imports.md").read_text(encoding="utf-8")
FILES = re.findall(r"^```(?:xml|csv)\n(?:<!--|#) (\S+).*\n((?:.*\n)*?)```$", PAGE, re.MULTILINE)
COMMANDS = re.findall(r"^```sh\nderive (.*)\n```\n(?:\n```yaml\n((?:.*\n)*?)```$)?", PAGE, re.MULTILINE)


@pytest.mark.parametrize(("command", "printed"), COMMANDS, ids=[command for command, _ in COMMANDS])
def test_command(command: str, printed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name, text in FILES:
        (tmp_path / name).write_text(text, encoding="utf-8")
    found = run(*shlex.split(command))
    assert found.exit_code == 0, found.output
    if printed:
        assert found.stdout == printed
    else:
        assert ElementTree.fromstring(found.stdout).tag == "robot"


def test_there_are_files_and_commands() -> None:
    assert [name for name, _ in FILES] == ["arm.urdf", "arm.csv"] and len(COMMANDS) == 3
