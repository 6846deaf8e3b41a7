"""The options of what is built, wherever it is built: `derive build`, `derive watch`."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Any

import click

FORMATS = ("md", "tex", "pdf", "html", "docx", "json")
STEPS = ("full", "key", "answers")


def _formats(ctx: click.Context, option: click.Parameter, value: str) -> tuple[str, ...]:
    chosen = tuple(dict.fromkeys(part.strip().lower() for part in value.split(",") if part.strip()))
    for name in chosen:
        if name not in FORMATS:
            raise click.BadParameter(f"'{name}' is not one of {', '.join(FORMATS)}")
    if not chosen:
        raise click.BadParameter("give at least one format")
    return chosen


def build_options(command: Callable[..., Any]) -> Callable[..., Any]:
    engines = click.Choice(["typst", "latex"])
    told = "All the working, formula and result, or the result alone."
    said = f"Comma-separated: {', '.join(FORMATS)}."
    where = "Directory to write to; - prints one page of md, tex or json."
    look = "Directory of templates of your own, which change how pages look and what they say."
    engine = "latex needs a TeX installation, typst nothing."
    options = (
        click.option(
            "--format", "formats", default="md,tex,pdf", callback=_formats, show_default=True, help=said
        ),
        click.option("--output", default="output", show_default=True, help=where),
        click.option("--problems", is_flag=True, help="Leave the solutions out: SHEET-problems.md, ..."),
        click.option("--space", is_flag=True, help="Leave room for answers on problem sheets."),
        click.option("--steps", type=click.Choice(STEPS), help=told),
        click.option(
            "--audit", is_flag=True, help="Have SymPy derive every answer again, from the sheet alone."
        ),
        click.option(
            "--explain", is_flag=True, help="Say of every answer what was proved how, and what was not."
        ),
        click.option(
            "--no-figures", is_flag=True, help="Draw no subject whose sheet does not say figure: true."
        ),
        click.option("--templates", type=click.Path(exists=True, file_okay=False, path_type=Path), help=look),
        click.option("--pdf-engine", type=engines, default="typst", show_default=True, help=engine),
    )
    collected = _collected(command)
    for option in reversed(options):
        collected = option(collected)
    return collected


def _collected(command: Callable[..., Any]) -> Callable[..., Any]:
    """A command that is given them as one value, `wanted`."""

    @wraps(command)
    def run(*args: Any, **given: Any) -> Any:
        from derive.jobs.wanted import Wanted

        figures = not given.pop("no_figures")
        names = ("formats", "problems", "space", "steps", "templates", "pdf_engine", "audit", "explain")
        wanted = Wanted(figures=figures, **{name: given.pop(name) for name in names})
        return command(*args, wanted=wanted, **given)

    return run
