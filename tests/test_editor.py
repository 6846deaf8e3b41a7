"""What an author sees in an editor: words offered, words explained, faults underlined."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path
from shutil import which

import pytest

from derive.catalogue import SCHEMA, starter
from derive.kinds import registry as kinds
from derive.sheet.schema import schema_text
from derive.sheet.subjects import registry as subjects
from tests.language_server import LanguageServer, language_server

PACKAGE = "yaml-language-server@1.25.0"
HEAD = f"# yaml-language-server: $schema={SCHEMA}\ntitle: A sheet\nproblems:\n"
ARM = f"{HEAD}- robot:\n    links:\n    - {{theta: theta1*, d: 0, a: l, alpha: 0}}\n"
OF_A_QUESTION = {"marks", "hint", "evaluate", "answer", "steps", "text"}

pytestmark = pytest.mark.skipif(which("npm") is None, reason="npm is not installed")


@pytest.fixture(scope="module")
def editor(pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> Iterator[LanguageServer]:
    folder = tmp_path_factory.mktemp("sheets")
    (folder / SCHEMA).write_text(schema_text(), encoding="utf-8")
    with language_server(_installed(pytestconfig, tmp_path_factory), folder) as server:
        yield server


def _installed(config: pytest.Config, temporary: pytest.TempPathFactory) -> Path:
    """The server, fetched by npm once and kept in pytest's cache."""
    assert config.cache is not None
    kept = config.cache.mkdir("npm") / PACKAGE
    if not kept.exists():
        fetched = temporary.mktemp("npm")
        quiet = ("--no-audit", "--no-fund", "--silent")
        subprocess.run(["npm", "install", *quiet, "--prefix", fetched, PACKAGE], check=True, timeout=300)
        try:
            fetched.rename(kept)
        except OSError:  # another worker was faster, or the cache is on another disk
            kept = kept if kept.exists() else fetched
    return kept / "node_modules" / "yaml-language-server" / "bin" / "yaml-language-server"


@pytest.mark.parametrize("subject", subjects.subjects())
def test_the_kinds_of_the_subject_are_offered_and_no_others(editor: LanguageServer, subject: str) -> None:
    offered = editor.offered(f"{HEAD}- {subject}: a.yaml\n  questions:\n  - find: |\n")
    assert offered.keys() == kinds.kinds_of(subject).keys()
    assert all(offered.values())


@pytest.mark.parametrize(
    ("sheet", "wanted"),
    [
        (f"{HEAD}- |", {*subjects.subjects(), "title", "text"}),
        (f"{ARM}  questions:\n  - find: velocity\n    |\n", {*OF_A_QUESTION, "point"}),
        (f"{ARM}  questions:\n  - find: rank\n    |\n", {*OF_A_QUESTION, "rows", "point", "task", "wrench"}),
        (f"{ARM}  find: jacobian\n  r|\n", {"rows", "in", "kind"}),
        (f"{ARM}  find: jacobian\n  rows: [|]\n", {"vx", "vy", "vz", "wx", "wy", "wz"}),
        (
            f"{HEAD}- robot:\n    links:\n    - theta: theta1*\n      |\n",
            {"d", "a", "alpha", "mass", "inertia"},
        ),
        (f"{HEAD}- motor:\n    control: |\n", {"armature", "field"}),
    ],
)
def test_what_is_offered(editor: LanguageServer, sheet: str, wanted: set[str]) -> None:
    assert wanted <= editor.offered(sheet).keys()


def test_one_subject_is_enough(editor: LanguageServer) -> None:
    offered = editor.offered(f"{ARM}  |\n").keys()
    assert {"find", "questions", "text"} <= offered
    assert not {"motor", "frames", "system"} & offered


@pytest.mark.parametrize(
    ("sheet", "wanted"),
    [
        (ARM.replace("robot", "rob|ot") + "  find: jacobian\n", "an open chain given by"),
        (f"{ARM}  find: jac|obian\n", "The geometric Jacobian of any point of an arm"),
        (f"{ARM}  find: jacobian\n  ro|ws: [vx]\n", "Some rows only, in this order"),
        (f"{ARM}  questions:\n  - find: jacobian\n    ki|nd: analytic\n", "the rates of three Euler angles"),
        (
            ARM.replace("alpha", "al|pha") + "  find: jacobian\n",
            "the twist of the link.",
        ),
        (
            f"{HEAD}- motor: {{con|trol: field, output: angle}}\n  find: model\n",
            "Which terminals the voltage",
        ),
    ],
)
def test_what_is_said_of_a_word(editor: LanguageServer, sheet: str, wanted: str) -> None:
    assert wanted in editor.said(sheet)


@pytest.mark.parametrize(
    ("sheet", "line", "wanted"),
    [
        (f"{ARM}  find: jacobiam\n", 7, 'Valid values: "acceleration"'),
        (f"{ARM}  find: jacobian\n  rows: [vx,\n    vq]\n", 9, 'Valid values: "vx", "vy"'),
        (f"{ARM}  find: jacobian\n  row: [vx]\n", 8, "Property row is not allowed."),
        (f"{ARM}  questions:\n  - find: velocity\n    marsk: 2\n", 9, "Property marsk is not allowed."),
        (f"{ARM}  questions:\n  - text: What?\n", 8, 'Missing property "find".'),
        (
            f"{ARM}  motor: {{control: field, output: angle}}\n  find: model\n",
            7,
            "Property motor is not allowed.",
        ),
        (ARM.replace("alpha: 0", "alfa: 0"), 6, 'Missing property "alpha".'),
        (f"{HEAD}- text: What?\n  find: jacobian\n", 4, "A problem has a subject: drive, frames"),
        (f"{HEAD}- motor: {{control: field, output: angel}}\n  find: model\n", 4, '"angle", "speed"'),
    ],
)
def test_what_is_underlined(editor: LanguageServer, sheet: str, line: int, wanted: str) -> None:
    marked = editor.marked(sheet)
    assert [each for each in marked if each[0] == line and wanted in each[1]], marked


def test_nothing_of_the_tour_is_underlined(editor: LanguageServer) -> None:
    assert editor.marked(starter("tour", None)) == []
