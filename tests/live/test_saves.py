"""A watched sheet: what rebuilds it, and how it ends."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from derive.live.saves import is_source
from tests.commands import LONGEST, SHEET, started, until


@pytest.mark.parametrize(
    ("path", "made_of"),
    [
        ("week1.yaml", True), ("robots/arm.urdf", True), ("arm.PNG", True), ("look/words/x.j2", True),
        ("output/week1/figure.svg", False), ("output/week1.md", False), ("week1.txt", False), ("x.j2", False),
        ("output/again.yaml", True),
    ],
)  # fmt: skip
def test_a_page_is_made_of(path: str, made_of: bool) -> None:
    assert is_source(Path(path), Path("look"), Path("output")) is made_of


@pytest.mark.parametrize("output", ["output", "."])
def test_it_is_built_at_each_save_until_ctrl_c(output: str, tmp_path: Path) -> None:
    sheet, page = tmp_path / "week1.yaml", tmp_path / output / "week1.md"
    sheet.write_text(SHEET, encoding="utf-8")
    options = ["--format", "md", "--output", output]
    command = [sys.executable, "-m", "derive", "watch", "week1.yaml", *options]
    with started(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as process:
        try:
            until(page.exists, process)
            sheet.write_text(SHEET.replace("A planar arm", "Another arm"), encoding="utf-8")
            until(lambda: "Another arm" in page.read_text(encoding="utf-8"), process)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=LONGEST)[1]
            assert process.returncode == 0
            assert "watching week1.yaml" in said
            assert "KeyboardInterrupt" not in said
        finally:
            process.kill()
