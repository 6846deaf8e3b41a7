"""What tells and begins: `derive kinds`, `derive new`, `derive schema`."""

from __future__ import annotations

import os
from pathlib import Path

import click

from derive.messages import guarded, page, say


def _known(ctx: click.Context, option: click.Parameter, typed: str) -> list[str]:
    """Subjects and kinds that begin like this, for a shell; those of a subject where one stands before."""
    from derive.kinds import registry
    from derive.sheet.subjects.registry import subjects

    subject = ctx.params.get("name") if option.name == "kind" else None
    chosen = (subject,) if subject in subjects() else subjects()
    names = {kind for each in chosen for kind in registry.kinds_of(each)}
    if option.name == "name":
        names |= {*subjects()}
    return sorted(name for name in names if name.startswith(typed))


@click.command(short_help="Say what can be asked, or all about one subject or kind.")
@click.argument("name", metavar="[SUBJECT | KIND]", required=False, shell_complete=_known)
@click.argument("kind", required=False, shell_complete=_known)
@click.option(
    "--format",
    "style",
    type=click.Choice(["text", "markdown", "reference"]),
    default="text",
    show_default=True,
    help="markdown: a table of all kinds; reference: tables of all fields.",
)
def kinds(name: str | None, kind: str | None, style: str) -> None:
    """Say what can be asked. Of a SUBJECT how it is described and what can be asked of it; of a KIND its
    options, its results and a runnable example."""
    from derive import catalogue
    from derive.sheet.reference import reference

    if name is not None and style != "text":
        raise click.UsageError(f"--format {style} is about all kinds: leave '{name}' out")
    whole = {"text": catalogue.overview, "markdown": catalogue.table, "reference": reference}
    with guarded():
        page(whole[style]() if name is None else catalogue.describe(name, kind))


@click.command()
@click.argument("name")
@click.option("--kind", help="Start from the example of this kind.", shell_complete=_known)
def new(name: str, kind: str | None) -> None:
    """Write a commented sheet to start from, NAME.yaml. It builds as it stands.

    The schema for editors is written beside it, derive-schema.json.
    """
    from derive.catalogue import SCHEMA, starter
    from derive.sheet.schema import schema_text

    target = Path(name if name.endswith((".yaml", ".yml")) else f"{name}.yaml")
    if not target.stem or target.name.startswith("."):
        raise click.UsageError("the sheet has no name: derive new week1 writes week1.yaml")
    if os.path.exists(target):
        raise click.UsageError(f"{target} exists already; choose another name")
    with guarded():
        target.write_text(starter(target.stem, kind), encoding="utf-8")
        (target.parent / SCHEMA).write_text(schema_text(), encoding="utf-8")
        say(str(target))


@click.command()
def schema() -> None:
    """Print the JSON Schema of the sheet language, for editors."""
    from derive.sheet.schema import schema_text

    with guarded():
        page(schema_text())
