"""`derive build`."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

from derive.cli.options import build_options
from derive.cli.sheets import SHEETS
from derive.errors import NotAllWritten
from derive.messages import guarded, page, progress, say, warn

if TYPE_CHECKING:
    from derive.jobs.wanted import Wanted

MOST_JOBS = 8  # unless more are asked for


@click.command()
@SHEETS
@build_options
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="Build at most N sheets at a time; left out, as many as there are processors, up to 8.",
)
@click.option("--no-cache", is_flag=True, help="Derive sheets again of which nothing has changed.")
def build(sheets: tuple[Path, ...], output: str, wanted: Wanted, jobs: int | None, no_cache: bool) -> None:
    """Build solution sheets (the default command). A directory stands for the sheets in it.

    A sheet is left as it is where neither it and its files nor its pages, the options, the templates or the
    program have changed since it was built. What is known of that lies in the cache folder of the user, or in
    the one that DERIVE_CACHE names.
    """
    target = None if output == "-" else Path(output)
    if target is None and (len(wanted.formats) > 1 or wanted.formats[0] not in ("md", "tex", "json")):
        raise click.UsageError("--output - prints one format: choose it with --format md, tex or json")
    if target is None and len(sheets) > 1:
        raise click.UsageError("--output - prints one sheet")
    with guarded():
        build_pages(sheets, wanted, target, jobs or _processors(), not no_cache)


def build_pages(
    sheets: tuple[Path, ...], wanted: Wanted, target: Path | None, jobs: int = 1, cache: bool = False
) -> None:
    """Builds and says what was written. Raises UsageError for options that do not go together."""
    if wanted.space and not wanted.problems:
        raise click.UsageError("--space leaves room on problem sheets: add --problems")
    if wanted.audit and wanted.problems:
        raise click.UsageError("--problems leaves out the answers that --audit is about")
    if wanted.explain and wanted.problems:
        raise click.UsageError("--problems leaves out the answers that --explain is about")
    from derive.jobs.run import built

    try:
        with progress() as step:
            found = built(sheets, wanted, target, jobs, step, warn, cache)
    except NotAllWritten as failed:
        _say_pages(failed.files, target)
        raise
    for text in found.texts:
        page(text)
    if wanted.audit:
        from derive.auditing import report

        for line in report(found.audited):
            say(line)
    _say_pages(found.files, target)
    if found.unchanged:
        say(_unchanged(found.unchanged))
    for line in found.explained:
        say(line)


def _unchanged(sheets: tuple[Path, ...]) -> str:
    first, *others = sheets
    return f"{len(sheets)} sheets are unchanged" if others else f"{first} is unchanged"


def _processors() -> int:
    """How many this process may use; of many a few, as each needs memory."""
    found = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(found, MOST_JOBS)


def _say_pages(files: tuple[Path, ...], folder: Path | None) -> None:
    """The pages among the files, and no picture of a page."""
    for file in files:
        if file.parent == folder:
            say(str(file))
