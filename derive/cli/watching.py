"""`derive watch`."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from derive.cli.building import build_pages
from derive.cli.options import build_options
from derive.cli.sheets import SheetPath
from derive.messages import guarded, say

if TYPE_CHECKING:
    from derive.jobs.wanted import Wanted


@click.command(short_help="Rebuild a sheet at every save, or show it in the browser (--serve).")
@click.argument("sheet", type=SheetPath(exists=True, dir_okay=False, path_type=Path))
@click.option("--serve", is_flag=True, help="Show it in the browser and write nothing.")
@click.option(
    "--port", type=click.IntRange(0, 65535), default=0, help="Where to serve; left out, any free one."
)
@click.option("--open", "opened", is_flag=True, help="Open the browser there.")
@build_options
@click.pass_context
def watch(
    ctx: click.Context, sheet: Path, serve: bool, port: int, opened: bool, output: str, wanted: Wanted
) -> None:
    """Rebuild a sheet whenever it, a file beside it or a template is saved. Ctrl-C ends it.

    With --serve a page in the browser follows it: it shows the faults while the sheet is wrong, and keeps the
    last good page and the place where it is read.
    """
    given = [name for name in ctx.params if ctx.get_parameter_source(name) is ParameterSource.COMMANDLINE]
    _refuse_together(serve, given)
    if serve:
        _serve(sheet, wanted, port, opened)
        return
    from derive.live.saves import saves

    if output == "-":
        raise click.UsageError("a watched sheet is written to a directory, not printed")
    target = Path(output)

    def again() -> None:
        with suppress(SystemExit), guarded():  # the faults are printed already
            build_pages((sheet,), wanted, target)
        say(f"watching {sheet}; Ctrl-C ends it")

    with suppress(KeyboardInterrupt):
        for _ in saves(sheet, wanted.templates, target):
            again()


def _serve(sheet: Path, wanted: Wanted, port: int, opened: bool) -> None:
    from derive.live.following import Wanted as Shown
    from derive.live.following import follow

    _collect_seldom()
    shown = Shown(wanted.problems, wanted.space, wanted.steps, wanted.figures, wanted.templates)
    with suppress(KeyboardInterrupt), guarded():
        follow(sheet, shown, port, click.launch if opened else lambda _: None)


def _collect_seldom() -> None:
    """Trees are many and hold no cycles."""
    import gc

    gc.set_threshold(100_000, 50, 50)


def _refuse_together(serve: bool, given: Sequence[str]) -> None:
    """Raises UsageError for options that say nothing about what is watched."""
    names = {"formats": "--format", "opened": "--open", "pdf_engine": "--pdf-engine"}
    idle = ("formats", "output", "pdf_engine", "audit", "explain") if serve else ("port", "opened")
    for each in given:
        if each in idle:
            name = names.get(each, f"--{each}")
            if serve:
                raise click.UsageError(
                    f"{name} does not go with --serve, which shows a page and writes nothing"
                )
            raise click.UsageError(f"{name} is about the page in the browser: add --serve")
