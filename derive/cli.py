"""The command line: thin, and the one place where errors become text and exit codes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from derive.messages import guarded, progress, say

FORMATS = ("md", "tex", "pdf", "html", "docx", "json")


class _Commands(click.Group):
    """`derive SHEET` is `derive build SHEET`."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        if args and args[0] not in self.commands and args[0] not in ("--help", "-h", "--version"):
            args = ["build", *args]
        return super().parse_args(ctx, args)


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="derive-sheets", prog_name="derive")
def main() -> None:
    """Exercise sheets in YAML to worked, verified solution sheets.

    derive SHEET... is short for derive build SHEET...
    """


def _formats(ctx: click.Context, option: click.Parameter, value: str) -> tuple[str, ...]:
    chosen = tuple(dict.fromkeys(part.strip().lower() for part in value.split(",") if part.strip()))
    for name in chosen:
        if name not in FORMATS:
            raise click.BadParameter(f"'{name}' is not one of {', '.join(FORMATS)}")
    if not chosen:
        raise click.BadParameter("give at least one format")
    return chosen


def _sheets(ctx: click.Context, option: click.Parameter, value: tuple[Path, ...]) -> tuple[Path, ...]:
    """The sheets named; a directory stands for those in it."""
    found = []
    for path in value:
        inside = sorted([*path.glob("*.yaml"), *path.glob("*.yml")]) if path.is_dir() else [path]
        if not inside:
            raise click.BadParameter(f"there is no sheet in {path}")
        found.extend(inside)
    return tuple(dict.fromkeys(found))


def _build_options(command: Callable[..., Any]) -> Callable[..., Any]:
    engines = click.Choice(["typst", "latex"])
    said = f"Comma-separated: {', '.join(FORMATS)}."
    options = (
        click.option(
            "--format", "formats", default="md,tex,pdf", callback=_formats, show_default=True, help=said
        ),
        click.option("--output", default="output", show_default=True, help="Directory to write to, or -"),
        click.option("--problems", is_flag=True, help="Leave the solutions out."),
        click.option("--pdf-engine", type=engines, default="typst", show_default=True),
    )
    for option in reversed(options):
        command = option(command)
    return command


@main.command()
@click.argument(
    "sheets", nargs=-1, required=True, callback=_sheets, type=click.Path(exists=True, path_type=Path)
)
@_build_options
def build(
    sheets: tuple[Path, ...], formats: tuple[str, ...], output: str, problems: bool, pdf_engine: str
) -> None:
    """Build solution sheets (the default command)."""
    target = None if output == "-" else Path(output)
    if target is None and (len(formats) > 1 or formats[0] not in ("md", "tex", "json")):
        raise click.UsageError("--output - prints one format: choose it with --format md, tex or json")
    with guarded():
        _build(sheets, formats, target, problems, pdf_engine)


def _build(
    sheets: tuple[Path, ...], formats: tuple[str, ...], target: Path | None, problems: bool, pdf_engine: str
) -> None:
    from derive.build import build as build_sheets

    with progress() as step:
        made = build_sheets(sheets, formats, target, problems, pdf_engine, step)
    for page in made:
        if isinstance(page, str):
            click.echo(page, nl=False)
        elif page.suffix.lstrip(".") in formats:
            say(str(page))


@main.command()
@click.argument("kind", required=False)
def kinds(kind: str | None) -> None:
    """What can be asked; one kind's options, results and a runnable example."""
    from derive.catalogue import describe, overview

    with guarded():
        click.echo(overview() if kind is None else describe(kind), nl=False)


@main.command()
@click.argument("name")
@click.option("--kind", help="Start from the example of this kind.")
def new(name: str, kind: str | None) -> None:
    """Write a commented sheet to start from: NAME.yaml."""
    from derive.catalogue import starter

    target = Path(name if name.endswith((".yaml", ".yml")) else f"{name}.yaml")
    if target.exists():
        raise click.UsageError(f"{target} exists already")
    with guarded():
        target.write_text(starter(target.stem, kind), encoding="utf-8")
        say(str(target))


@main.command()
def schema() -> None:
    """Print the JSON Schema of the sheet language, for editors."""
    import json

    from derive.sheet.schema import sheet_schema

    with guarded():
        click.echo(json.dumps(sheet_schema(), indent=2, ensure_ascii=False))


@main.command()
@click.argument("sheet", type=click.Path(exists=True, path_type=Path))
@_build_options
def watch(sheet: Path, formats: tuple[str, ...], output: str, problems: bool, pdf_engine: str) -> None:
    """Rebuild a sheet whenever it, or a file beside it, is saved."""
    from watchfiles import watch as changes

    def again() -> None:
        try:
            with guarded():
                _build((sheet,), formats, Path(output), problems, pdf_engine)
        except SystemExit:
            say("waiting for the next save")

    again()
    for changed in changes(sheet.parent):
        if any(Path(path).suffix in (".yaml", ".yml") for _, path in changed):
            again()
