"""The examples of the language page build; the page on inverse kinematics shows what the code does."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

from derive.build import derive_all
from derive.sheet.load import load_sheet
from derive.writing import render
from tests.kinds.test_recipe import FILLED
from tests.sheets import ROOT

PAGE = (ROOT / "docs" / "language.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"^```yaml\n(title:.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("text", EXAMPLES, ids=[text.splitlines()[0] for text in EXAMPLES])
def test_example_builds(text: str, tmp_path: Path) -> None:
    path = tmp_path / "sheet.yaml"
    path.write_text(text, encoding="utf-8")
    (document,) = derive_all([load_sheet(path)], True, lambda _: None)
    assert render(document, "md")
    assert render(document, "tex")


INVERSE = (ROOT / "docs" / "inverse-kinematics.md").read_text(encoding="utf-8")
ROOMS = [
    *(ROOT / "derive" / "mechanics" / "inverse").glob("*.py"),
    *(ROOT / "derive" / "kinds" / "robot" / "_inverse").glob("*.py"),
    *(ROOT / "derive" / "mechanics").glob("[bi]*.py"),
    *(ROOT / "templates" / "words" / "robot").glob("*inverse*"),
]


def test_the_session_on_inverse_kinematics(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    blocks = re.findall(r"^```python\n(.*?)^```$", INVERSE, re.MULTILINE | re.DOTALL)
    session = doctest.DocTestParser().get_doctest("".join(blocks), {}, "inverse-kinematics.md", None, 0)
    told: list[str] = []
    result = doctest.DocTestRunner().run(session, out=told.append)
    assert result.attempted > 40 and not result.failed, "".join(told)


@pytest.mark.parametrize("name", sorted({*re.findall(r"`([\w./]+)`", INVERSE)}))
def test_the_names_on_inverse_kinematics(name: str) -> None:
    """Files and folders that are named exist, and so does each class, function and field."""
    if "/" in name or name.endswith((".py", ".j2")):
        assert [*ROOT.glob(name), *ROOT.glob(f"**/{name}")]
        return
    texts = [path.read_text(encoding="utf-8") for path in ROOMS]
    assert any(re.search(rf"\b{name.rpartition('.')[2]}\b", text) for text in texts)


@pytest.mark.parametrize("page", ["docs/design.md", "README.md", "CONTRIBUTING.md"])
def test_every_file_that_a_page_names_is_there(page: str) -> None:
    named = re.findall(r"`((?:derive|templates|tests|docs|exercises)/[\w./-]+)`", (ROOT / page).read_text())
    made = {path for path in FILLED if not (ROOT / path).exists()}
    assert [path for path in named if path not in made and not (ROOT / path).exists()] == []


def test_the_code_on_the_python_page_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    scope: dict[str, object] = {}
    for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL):
        exec(block, scope)
    assert str(scope["J"].det().simplify()) == "l1*l2*sin(theta2)"  # type: ignore[attr-defined]
    assert scope["elbow"]["when"] == "elbow down, theta2 > 0"  # type: ignore[index]
    assert "first" in scope
