"""`derive check`."""

from __future__ import annotations

from pathlib import Path

import click

from derive.cli.sheets import SHEETS
from derive.errors import SheetErrors
from derive.messages import guarded, page, progress, report, warn


@click.command()
@SHEETS
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", show_default=True)
def check(sheets: tuple[Path, ...], style: str) -> None:
    """Compare published answers (answer: in a sheet) with derived ones. A directory stands for its sheets.

    The exit status is 1 where an answer differs or cannot be decided.
    """
    from derive.answers.findings import as_json, as_text
    from derive.check import check as check_sheets

    with guarded():
        with progress() as step:
            found = check_sheets(sheets, step, warn)
        if found.faults:
            report(SheetErrors(found.faults), "what they concern is undecided")
        page((as_json(found.checks) if style == "json" else as_text(found.checks)) + "\n")
    if found.faults or any(each.verdict != "equal" for each in found.checks):
        raise click.exceptions.Exit(1)
