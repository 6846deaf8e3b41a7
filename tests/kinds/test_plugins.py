"""A kind of another package, found by its entry point, with its words beside its module."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from derive.build import build
from derive.kinds import registry

MODULE = '''
"""The trace of the rotation."""
from derive.derivation import Derivation, Step
from derive.expression import Symbol
from derive.kinds.fields import OptionsModel

RESULTS = {"trace": "the sum of the diagonal"}
EXAMPLE = ""


class Options(OptionsModel):
    """None."""


def derive(motion, options, problem):
    R = problem.ask("rotation-matrix")
    rows = R.results["R"].rows
    tree = problem.final(rows[0][0])
    return Derivation("first-entry", (Step("trace", (Symbol("trace"), tree)),), {"trace": tree}, uses=(R,))
'''
WORDS = (
    "{% block question %}What is the first entry?{% endblock %}\nIts first entry is\n{{ show('trace') }}\n"
)
SHEET = "title: t\nproblems:\n- motion: [{rotate: z, by: phi}]\n  find: first-entry\n"


@pytest.fixture
def plugged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    package = tmp_path / "theirs"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "first_entry.py").write_text(MODULE)
    (package / "first_entry.j2").write_text(WORDS)
    info = tmp_path / "theirs-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: theirs\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[derive.kinds]\nmotion/first-entry = theirs.first_entry\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    yield tmp_path
    sys.modules.pop("theirs", None)
    sys.modules.pop("theirs.first_entry", None)


def test_a_kind_of_another_package(plugged: Path) -> None:
    assert registry.kinds_of("motion")["first-entry"] == "theirs.first_entry"
    sheet = plugged / "sheet.yaml"
    sheet.write_text(SHEET)
    (page,) = build([sheet], ["md"], None)
    assert "What is the first entry?" in str(page)
    assert r"trace" in str(page) and r"\cos \phi" in str(page)
