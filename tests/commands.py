"""The command as it is typed, and the sheet `week1.yaml` of the folder it is typed in (fixture `folder`)."""

from __future__ import annotations

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


def run(*arguments: str) -> Result:
    return CliRunner().invoke(main, list(arguments))
