"""Kinds of another package, found by their entry points, with their words beside their modules."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from derive.build import build
from derive.errors import SheetErrors
from derive.kinds import registry

MODULE = '''
"""The trace of the rotation."""
from derive.derivation import Derivation, Step
from derive.expression import Symbol
from derive.kinds.checks import law
from derive.kinds.fields import OptionsModel
from derive.kinds.links import links


class Options(OptionsModel):
    """None."""


def derive(motion, options, problem):
    R = problem.ask("rotation-matrix")
    tree = problem.final(R.results["R"].rows[0][0])
    steps = (Step("trace", (Symbol("trace"), tree)),)
    return Derivation("first-entry", steps, {"trace": tree}, links(steps, {}))
'''
WORDS = (
    "{% block results %}\ntrace: the sum of the diagonal\n{% endblock %}\n"
    "{% block question %}What is the first entry?{% endblock %}\n"
    "{% block phrases %}\nitself: it is itself\n{% endblock %}\nIts first entry is\n{{ show('trace') }}\n"
)
LINKS = "links(steps, {})"
PROVED = {
    "a law": '(law("itself", tree == tree),)',
    "what it rests on": "(), uses=(R,)",
}


@pytest.fixture
def sheet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A sheet that asks a kind of a package beside it, whose claims are links."""
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
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text("title: t\nproblems:\n- motion: [{rotate: z, by: phi}]\n  find: first-entry\n")
    yield sheet
    sys.modules.pop("theirs", None)
    sys.modules.pop("theirs.first_entry", None)


def test_links_alone_prove_nothing(sheet: Path) -> None:
    with pytest.raises(SheetErrors) as refused:
        build([sheet], ["md"], None)
    (fault,) = refused.value.errors
    assert fault.message.startswith("nothing proves the answer of 'first-entry'")
    assert "CONTRIBUTING.md" in fault.hint


@pytest.mark.parametrize("claims", PROVED.values(), ids=PROVED)
def test_a_kind_of_another_package(sheet: Path, claims: str) -> None:
    (sheet.parent / "theirs" / "first_entry.py").write_text(MODULE.replace(LINKS, claims))
    assert registry.kinds_of("motion")["first-entry"] == "theirs.first_entry"
    (page,) = build([sheet], ["md"], None)
    assert "What is the first entry?" in str(page)
    assert r"trace" in str(page) and r"\cos \phi" in str(page)
