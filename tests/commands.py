"""The command as it is typed, and the sheet `week1.yaml` of the folder it is typed in (fixture `folder`)."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable, Sequence
from time import monotonic, sleep
from typing import Any

from click.testing import CliRunner, Result

from derive.cli import main

SHEET = """\
title: A planar arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: L, alpha: 0}
  find: dh-table
"""


LONGEST = 60.0  # seconds for what takes one or two where nothing else is done


def run(*arguments: str) -> Result:
    return CliRunner().invoke(main, list(arguments))


def started(command: Sequence[object], **more: Any) -> subprocess.Popen[Any]:
    """A program that Ctrl-C reaches, also where these tests run in the background: what a shell starts there
    ignores it, and so would all that is started from there."""
    hears = None if sys.platform == "win32" else _hear_ctrl_c
    return subprocess.Popen([str(part) for part in command], preexec_fn=hears, **more)


def _hear_ctrl_c() -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def until(true: Callable[[], object], process: subprocess.Popen[Any] | None = None) -> None:
    """Waits until something is true, for as long as a process that it hangs on is there."""
    began = monotonic()
    while not true():
        assert monotonic() - began < LONGEST
        assert process is None or process.poll() is None, "it has ended"
        sleep(0.02)
