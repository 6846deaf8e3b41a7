"""`derive` itself: which command is meant."""

from __future__ import annotations

import os
from pathlib import Path

import click

from derive import __version__
from derive.cli.sheets import with_ending


class _Commands(click.Group):
    """`derive SHEET` is `derive build SHEET`."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        if args and args[0] not in self.commands and args[0] not in ("--help", "-h", "--version"):
            self._refuse_misspelt(ctx, args[0])
            args = ["build", *args]
        return super().parse_args(ctx, args)

    def _refuse_misspelt(self, ctx: click.Context, typed: str) -> None:
        """Raises UsageError for what is neither a command nor anything like a file."""
        if typed.startswith("-") or Path(typed).suffix or os.path.exists(typed):
            return
        from difflib import get_close_matches

        close = get_close_matches(typed, self.commands, n=1)
        meant = with_ending(typed) or (close[0] if close else "")
        hint = f"; did you mean {meant}?" if meant else ""
        raise click.UsageError(f"there is no command and no sheet '{typed}'{hint}", ctx)


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="derive")
def main() -> None:
    """Turn exercise sheets in YAML into worked, verified solution sheets.

    \b
    derive week3.yaml               builds output/week3.md, .tex and .pdf
    derive exercises                builds every sheet of a folder
    derive new mine                 writes a sheet to start from
    derive watch mine.yaml --serve  shows its page in the browser

    'derive SHEET...' is short for 'derive build SHEET...'.
    """
