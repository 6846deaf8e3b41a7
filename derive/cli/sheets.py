"""The sheets that a command is given: files, or folders of them, named without their ending too."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import click


def with_ending(typed: str) -> str:
    """The sheet that is meant by its name without .yaml, "" where there is none."""
    return next((name for end in (".yaml", ".yml") if os.path.isfile(name := typed + end)), "")


class SheetPath(click.Path):
    """The path of a sheet that is there."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if not os.path.exists(value) and (meant := with_ending(str(value))):
            self.fail(f"there is no file '{value}'; did you mean {meant}?", param, ctx)
        return super().convert(value, param, ctx)


def _sheets(ctx: click.Context, option: click.Parameter, value: tuple[Path, ...]) -> tuple[Path, ...]:
    """The sheets named; a directory stands for those in it."""
    found = []
    for path in value:
        inside = sorted([*path.glob("*.yaml"), *path.glob("*.yml")]) if path.is_dir() else [path]
        if not inside:
            raise click.BadParameter(f"there is no sheet in {path}")
        found.extend(inside)
    return tuple({path.resolve(): path for path in found}.values())


SHEETS = click.argument(
    "sheets", nargs=-1, required=True, callback=_sheets, type=SheetPath(exists=True, path_type=Path)
)
