"""The recipe of CONTRIBUTING.md, followed to the letter in a copy of the repository.

Its kinds are begun, filled in and ended; nothing else is touched, and a wrong sign in them is refused.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.scaffold.__main__ import main as begin
from tests.sheets import ROOT

COPIED = ("derive", "templates", "exercises", "output", "tests")
KEPT = ("README.md", "CONTRIBUTING.md", "pyproject.toml", "docs/language.md")
FILES = re.compile(r"^`([\w/.-]+)`\n\n```\w+\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
FILLED = dict(FILES.findall(TEXT))
KINDS = [("robot", "pseudo-inverse"), ("motor", "torque-speed-curve")]
SIGNS = {  # what is turned in each module
    "pseudo-inverse": ("J_T * G**-1", "-J_T * G**-1"),
    "torque-speed-curve": ("V_A - K_B * OMEGA", "K_B * OMEGA - V_A"),
}
every_kind = pytest.mark.parametrize(("subject", "kind"), KINDS)


def run(where: Path, *command: str) -> str:
    """What a command says in the copy."""
    python = [sys.executable, "-m", *command]
    environment = {**os.environ, "PYTHONPATH": str(where)}
    done = subprocess.run(python, cwd=where, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    return done.stdout + done.stderr


def state(where: Path) -> dict[Path, bytes]:
    """Every file of the copy."""
    paths = (path for path in where.rglob("*") if path.is_file() and "cache" not in str(path))
    return {path.relative_to(where): path.read_bytes() for path in paths}


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The repository with both kinds, made as the page says."""
    where = tmp_path_factory.mktemp("repository")
    for name in COPIED:
        shutil.copytree(ROOT / name, where / name, ignore=shutil.ignore_patterns("__pycache__"))
    (where / "docs").mkdir()
    for name in KEPT:
        shutil.copyfile(ROOT / name, where / name)
    before = state(where)
    for subject, kind in KINDS:
        assert "written: " in run(where, "tests.scaffold", subject, kind)
        page = run(where, "derive", f"exercises/{kind}.yaml", "--format", "md", "--output", "-")
        assert "Verified by computer: " in page, "it builds as it stands"
        assert "FILL IN" in run(where, "tests.scaffold", subject, kind)
    for path, text in FILLED.items():
        assert (where / path).is_file()
        (where / path).write_text(text, encoding="utf-8")
    for subject, kind in KINDS:
        assert "look at them" in run(where, "tests.scaffold", subject, kind)
    after = state(where)
    touched = {str(path) for path in after if after[path] != before.get(path)}
    pages = {f"output/{kind}.{suffix}" for _, kind in KINDS for suffix in ("md", "tex")}
    drawn = {
        f"output/{kind}/problem-1-figure.{suffix}"
        for subject, kind in KINDS
        if subject == "robot"  # an arm is drawn where its sheet says nothing of a figure
        for suffix in ("pdf", "svg")
    }
    assert touched == {*FILLED, *pages, *drawn, "README.md"}  # no new fields for docs/language.md
    return where


@pytest.mark.xdist_group("recipe")
@every_kind
def test_a_kind_of_the_recipe_is_listed_and_answers(copy: Path, subject: str, kind: str) -> None:
    rows = [line for line in (copy / "README.md").read_text().splitlines() if f"`{kind}`" in line]
    assert [row.split("`")[1] for row in rows] == [subject]
    assert "Verified by computer: " in (copy / "output" / f"{kind}.md").read_text()
    assert run(copy, "ruff", "check", "derive/kinds").strip() == "All checks passed!"


@pytest.mark.xdist_group("recipe")
@every_kind
def test_a_wrong_sign_in_a_kind_of_the_recipe_is_refused(copy: Path, subject: str, kind: str) -> None:
    stem = kind.replace("-", "_")
    planted = run(copy, "tests.kinds.planting", stem)
    assert [line.rpartition(" [")[2] for line in planted.splitlines()] == ["]"] * 3
    module = copy / "derive" / "kinds" / subject / f"{stem}.py"
    right, (sign, wrong) = module.read_text(), SIGNS[kind]
    assert sign in right
    module.write_text(right.replace(sign, wrong))
    said = run(copy, "derive", f"exercises/{kind}.yaml", "--format", "md", "--output", "-")
    module.write_text(right)
    assert "the answer failed its own check" in said
    assert "Verified by computer: " not in said


@pytest.mark.parametrize(
    ("subject", "kind", "said"),
    [
        ("robot", "quaternion", "has a kind 'quaternion' already"),
        ("robt", "reach", "there is no subject 'robt'"),
        ("robot", "../reach", "is no name of a kind"),
    ],
)
def test_what_no_new_kind_can_be_called(subject: str, kind: str, said: str) -> None:
    with pytest.raises(SystemExit, match=said):
        begin(subject, kind)
