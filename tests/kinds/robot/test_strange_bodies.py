"""Inertias that no body has are built, with a warning that names them."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from derive.cli import main
from derive.sheet.load import load_sheet

SHEET = """\
title: t
problems:
- robot:
    links:
    - {{theta: x*, d: 0, a: a, alpha: 0, mass: {mass}, com: [c, 0, 0], inertia: {inertia}}}
  find: inertia-matrix
"""


def warnings(folder: Path, inertia: str, mass: str = "1") -> list[str]:
    path = folder / "sheet.yaml"
    path.write_text(SHEET.format(inertia=inertia, mass=mass), encoding="utf-8")
    return [warning.message for warning in load_sheet(path).problems[0].warnings]


@pytest.mark.parametrize(
    ("inertia", "mass", "said"),
    [
        ("[0.1, 0.35, 0.2]", "1", "I_yy = 0.35 is greater than I_xx + I_zz = 0.3"),
        ("[0, -0.35, 0]", "1", "I_yy is negative"),
        ("[-1, 2, 2]", "1", "I_xx is negative"),
        ("[1, 1, 1, 0.9, 0, 0]", "1", "principal moments 0.1, 1, 1.9 are not the sides of a triangle"),
        ("[1, 1, 1]", "0", "it has moments of inertia but no mass"),
    ],
)
def test_no_body_has_it(tmp_path: Path, inertia: str, mass: str, said: str) -> None:
    (found,) = warnings(tmp_path, inertia, mass)
    assert "link 1" in found
    assert said in found


@pytest.mark.parametrize(
    "inertia",
    [
        "[1, 1, 2]",
        "[0, 1, 1]",
        "[I_x, I_y, I_z]",
        "[0, 0, I]",
        "[0, 0, 0.02]",
        "point",
        "{rod: L, axis: x}",
        "[1, 1, 1, 0.4, 0, 0]",
    ],
)
def test_a_body_may_have_it(tmp_path: Path, inertia: str) -> None:
    assert warnings(tmp_path, inertia) == []


def test_the_command_says_so_and_builds(tmp_path: Path) -> None:
    warnings(tmp_path, "[0.1, 0.35, 0.1]", "1")
    sheet = tmp_path / "sheet.yaml"
    done = CliRunner().invoke(main, [str(sheet), "--format", "md", "--output", str(tmp_path / "out")])
    assert done.exit_code == 0
    assert (tmp_path / "out" / "sheet.md").is_file()
    assert "sheet.yaml:5:" in done.stderr
    assert "warning: no body has the inertia of link 1" in done.stderr
