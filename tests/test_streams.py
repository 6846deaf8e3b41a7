"""The program in odd surroundings: streams that are closed, full or of few letters, and an early Ctrl-C."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path
from time import sleep

import pytest

from tests.commands import LONGEST, started

posix = pytest.mark.skipif(sys.platform == "win32", reason="streams of POSIX")
COMMAND = [sys.executable, "-m", "derive"]
SHEET = """\
title: Übung
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: L, alpha: 0}
  find: dh-table
"""


@pytest.fixture
def sheet(tmp_path: Path) -> Path:
    path = tmp_path / "week1.yaml"
    path.write_text(SHEET, encoding="utf-8")
    return path


def shell(sheet: Path, line: str, **more: str) -> subprocess.CompletedProcess[bytes]:
    command = line.replace("derive", f"{sys.executable} -m derive", 1)
    environment = {**os.environ, **more}
    return subprocess.run(["sh", "-c", command], cwd=sheet.parent, env=environment, capture_output=True)


@posix
@pytest.mark.parametrize("what", ["week1.yaml --format md --output -", "kinds", "schema"])
def test_a_full_output_is_a_sentence(sheet: Path, what: str) -> None:
    done = shell(sheet, f"derive {what} > /dev/full")
    assert done.returncode == 1
    assert done.stderr == b"this could not be written: no space left on device\n"


@pytest.mark.parametrize("letters", ["ascii", "latin-1", "utf-8"])
def test_a_page_is_the_same_bytes_whatever_letters_a_terminal_has(sheet: Path, letters: str) -> None:
    done = shell(sheet, "derive week1.yaml --format json --output -", PYTHONIOENCODING=letters)
    assert (done.returncode, done.stderr) == (0, b"")
    assert "Übung" in done.stdout.decode("utf-8")


@posix
@pytest.mark.parametrize("closed", ["2>&-", ">&-", "<&- >&- 2>&-"])
def test_closed_streams(sheet: Path, closed: str) -> None:
    assert shell(sheet, f"derive week1.yaml --format md {closed}").returncode == 0
    assert (sheet.parent / "output" / "week1.md").is_file()
    assert shell(sheet, f"derive nothing.yaml {closed}").returncode == 2


@posix
@pytest.mark.parametrize("after", [0.05, 0.1, 0.2, 0.3, 0.4])
def test_an_early_interrupt_is_no_traceback(sheet: Path, after: float) -> None:
    build = started(
        [*COMMAND, str(sheet), "--output", str(sheet.parent / "out")], stderr=subprocess.PIPE, text=True
    )
    sleep(after)
    build.send_signal(signal.SIGINT)
    _, said = build.communicate(timeout=LONGEST)
    assert "derive/" not in said  # what Python itself says while it starts is not ours


@posix
@pytest.mark.parametrize("kind", ["fifo", "/dev/zero"])
def test_what_is_no_file_is_refused(sheet: Path, kind: str) -> None:
    if kind == "fifo":
        os.mkfifo(sheet.parent / kind)
    done = shell(sheet, f"derive {kind}")
    assert done.returncode == 1
    assert b"no ordinary file" in done.stderr
