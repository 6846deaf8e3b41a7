"""The wheel, in an environment of its own and an empty folder, builds a sheet to every format."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.sheets import ROOT

SHEET = """\
title: A planar arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: L, alpha: 0}
    - {theta: theta2*, d: 0, a: L, alpha: 0}
  find: jacobian
- motor: {control: armature, output: speed}
  find: step-response
  controller: {P: {K_p: 1}}
  evaluate: {J: 1, K_m: 1, R_a: 1, L_a: 1, b: 1, K_b: 1}
"""
FORMATS = ("md", "tex", "pdf", "html", "docx", "json")


def run(*command: str | Path, cwd: Path) -> str:
    outside = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "VIRTUAL_ENV")}
    done = subprocess.run(
        [str(part) for part in command], cwd=cwd, env=outside, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", folder, ROOT, cwd=folder)
    (found,) = folder.glob("*.whl")
    return found


@pytest.mark.xdist_group("wheel")
def test_the_wheel_holds_the_templates_and_no_tests(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    templates = {
        path.relative_to(ROOT).as_posix() for path in (ROOT / "templates").rglob("*") if path.is_file()
    }
    assert {f"derive/{name}" for name in templates} <= set(names)
    modules = {path.relative_to(ROOT).as_posix() for path in (ROOT / "derive").rglob("*.py")}
    assert modules <= set(names)
    assert not [name for name in names if name.startswith(("tests/", "exercises/"))]


@pytest.mark.xdist_group("wheel")
def test_it_builds_a_sheet_to_every_format_in_an_empty_folder(wheel: Path, tmp_path: Path) -> None:
    run(sys.executable, "-m", "venv", tmp_path / "venv", cwd=tmp_path)
    binaries = tmp_path / "venv" / "bin"
    run(binaries / "python", "-m", "pip", "install", "--quiet", wheel, cwd=tmp_path)
    folder = tmp_path / "empty"
    folder.mkdir()
    (folder / "sheet.yaml").write_text(SHEET, encoding="utf-8")
    run(binaries / "derive", "sheet.yaml", "--format", ",".join(FORMATS), cwd=folder)
    made = {path.name for path in (folder / "output").iterdir() if path.is_file()}
    assert made == {f"sheet.{kind}" for kind in FORMATS}
    assert all((folder / "output" / name).stat().st_size > 500 for name in made)
    assert "jacobian" in run(binaries / "derive", "kinds", cwd=folder)
