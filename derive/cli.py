"""The command line: thin, and the one place where errors become text and exit codes."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from derive import __version__
from derive.errors import NotAllWritten, SheetErrors
from derive.messages import guarded, page, progress, report, say, warn

if TYPE_CHECKING:
    from derive.sheet.model import Steps

STEPS = ("full", "key", "answers")
MOST_JOBS = 8  # unless more are asked for
FORMATS = ("md", "tex", "pdf", "html", "docx", "json")


def _with_ending(typed: str) -> str:
    """The sheet that is meant by its name without .yaml, "" where there is none."""
    return next((name for end in (".yaml", ".yml") if os.path.isfile(name := typed + end)), "")


class _SheetPath(click.Path):
    """The path of a sheet that is there."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if not os.path.exists(value) and (meant := _with_ending(str(value))):
            self.fail(f"there is no file '{value}'; did you mean {meant}?", param, ctx)
        return super().convert(value, param, ctx)


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
        meant = _with_ending(typed) or (close[0] if close else "")
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
    return tuple({path.resolve(): path for path in found}.values())


SHEETS = click.argument(
    "sheets", nargs=-1, required=True, callback=_sheets, type=_SheetPath(exists=True, path_type=Path)
)


def _build_options(command: Callable[..., Any]) -> Callable[..., Any]:
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
    for option in reversed(options):
        command = option(command)
    return command


@main.command()
@SHEETS
@_build_options
@click.option(
    "--jobs",
    type=click.IntRange(min=1),
    metavar="N",
    help="Build at most N sheets at a time; left out, as many as there are processors, up to 8.",
)
@click.option("--no-cache", is_flag=True, help="Derive sheets again of which nothing has changed.")
def build(
    sheets: tuple[Path, ...],
    formats: tuple[str, ...],
    output: str,
    problems: bool,
    space: bool,
    steps: Steps | None,
    audit: bool,
    explain: bool,
    no_figures: bool,
    templates: Path | None,
    pdf_engine: str,
    jobs: int | None,
    no_cache: bool,
) -> None:
    """Build solution sheets (the default command). A directory stands for the sheets in it.

    A sheet is left as it is where neither it and its files nor its pages, the options, the templates or the
    program have changed since it was built. What is known of that lies in the cache folder of the user, or in
    the one that DERIVE_CACHE names.
    """
    target = None if output == "-" else Path(output)
    if target is None and (len(formats) > 1 or formats[0] not in ("md", "tex", "json")):
        raise click.UsageError("--output - prints one format: choose it with --format md, tex or json")
    if target is None and len(sheets) > 1:
        raise click.UsageError("--output - prints one sheet")
    with guarded():
        _build(
            sheets, formats, target, problems, space, steps, audit, explain, no_figures, templates,
            pdf_engine, jobs, not no_cache,
        )  # fmt: skip


def _build(
    sheets: tuple[Path, ...],
    formats: tuple[str, ...],
    target: Path | None,
    problems: bool,
    space: bool,
    steps: Steps | None,
    audit: bool,
    explain: bool,
    no_figures: bool,
    templates: Path | None,
    pdf_engine: str,
    jobs: int | None = 1,
    cache: bool = False,
) -> None:
    if space and not problems:
        raise click.UsageError("--space leaves room on problem sheets: add --problems")
    if audit and problems:
        raise click.UsageError("--problems leaves out the answers that --audit is about")
    if explain and problems:
        raise click.UsageError("--problems leaves out the answers that --explain is about")
    from derive.jobs.run import built
    from derive.jobs.wanted import Wanted

    figures = not no_figures
    wanted = Wanted(
        formats, problems, space, steps, figures, templates, pdf_engine, audit=audit, explain=explain
    )
    try:
        with progress() as step:
            found = built(sheets, wanted, target, jobs or _processors(), step, warn, cache)
    except NotAllWritten as failed:
        _say_pages(failed.files, target)
        raise
    for text in found.texts:
        page(text)
    if audit:
        from derive.auditing import report

        for line in report(found.audited):
            say(line)
    _say_pages(found.files, target)
    if found.unchanged:
        say(_unchanged(found.unchanged))
    for line in found.explained:
        say(line)


def _collect_seldom() -> None:
    """Trees are many and hold no cycles."""
    import gc

    gc.set_threshold(100_000, 50, 50)


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


@main.command()
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


@main.command(short_help="Say what can be asked, or all about one subject or kind.")
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


@main.command()
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


def _packages(ctx: click.Context, option: click.Parameter, value: tuple[str, ...]) -> dict[str, Path]:
    """ROS packages and their folders."""
    found = {}
    for pair in value:
        name, sign, folder = pair.partition("=")
        if not sign or not os.path.isdir(folder):
            raise click.BadParameter(f"'{pair}' is not NAME=DIR with a directory that is there")
        found[name] = Path(folder)
    return found


@main.command("import")
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--base", default="", metavar="LINK", help="Where the arm begins; else the root.")
@click.option("--tip", default="", metavar="LINK", help="Where it ends; else after the most joints.")
@click.option(
    "--within",
    default=1e-9,
    type=click.FloatRange(0, 1e-2),
    show_default=True,
    help="Angles (rad) this near to a simple one are that one.",
)
@click.option(
    "--package",
    "packages",
    multiple=True,
    callback=_packages,
    metavar="NAME=DIR",
    help="Where a ROS package is.",
)
def import_(file: Path, base: str, tip: str, within: float, packages: dict[str, Path]) -> None:
    """Print a robot of URDF or xacro, or a table of CSV, as YAML."""
    from derive.sheet.exchange.files import Wish, as_yaml
    from derive.sheet.exchange.library import Library

    with guarded():
        text, strange = as_yaml(file, Wish(base, tip, within, Library(packages)))
        for each in strange:
            warn(each)
        page(text)


def _values(ctx: click.Context, option: click.Parameter, value: tuple[str, ...]) -> dict[str, float]:
    """Names and their values, units included, in SI units."""
    from derive.algebra.formulas.grammar import parse
    from derive.algebra.numbers.floats import number

    found = {}
    for pair in value:
        name, _, typed = pair.partition("=")
        try:
            found[name.strip()] = number(parse(typed, dimension="any"), {})
        except (ValueError, KeyError, ArithmeticError) as error:
            raise click.BadParameter(f"'{pair}' is not NAME=VALUE: {error}") from error
    return found


@main.command()
@click.argument("robot", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--to", "form", type=click.Choice(["urdf"]), required=True)
@click.option("--value", "values", multiple=True, callback=_values, metavar="NAME=VALUE", help="Of a symbol.")
def export(robot: Path, form: str, values: dict[str, float]) -> None:
    """Print a robot's file as URDF."""
    from derive.sheet.exchange.files import as_urdf

    with guarded():
        text, strange = as_urdf(robot, values)
        for each in strange:
            warn(each)
        page(text)


@main.command()
def schema() -> None:
    """Print the JSON Schema of the sheet language, for editors."""
    from derive.sheet.schema import schema_text

    with guarded():
        page(schema_text())


@main.command(short_help="Rebuild a sheet at every save, or show it in the browser (--serve).")
@click.argument("sheet", type=_SheetPath(exists=True, dir_okay=False, path_type=Path))
@click.option("--serve", is_flag=True, help="Show it in the browser and write nothing.")
@click.option(
    "--port", type=click.IntRange(0, 65535), default=0, help="Where to serve; left out, any free one."
)
@click.option("--open", "opened", is_flag=True, help="Open the browser there.")
@_build_options
@click.pass_context
def watch(
    ctx: click.Context,
    sheet: Path,
    serve: bool,
    port: int,
    opened: bool,
    formats: tuple[str, ...],
    output: str,
    problems: bool,
    space: bool,
    steps: Steps | None,
    audit: bool,
    explain: bool,
    no_figures: bool,
    templates: Path | None,
    pdf_engine: str,
) -> None:
    """Rebuild a sheet whenever it, a file beside it or a template is saved. Ctrl-C ends it.

    With --serve a page in the browser follows it: it shows the faults while the sheet is wrong, and keeps the
    last good page and the place where it is read.
    """
    given = [name for name in ctx.params if ctx.get_parameter_source(name) is ParameterSource.COMMANDLINE]
    _refuse_together(serve, given)
    if serve:
        from derive.live.following import Wanted, follow

        _collect_seldom()
        wanted = Wanted(problems, space, steps, not no_figures, templates)
        with suppress(KeyboardInterrupt), guarded():
            follow(sheet, wanted, port, click.launch if opened else lambda _: None)
        return
    from derive.live.saves import saves

    if output == "-":
        raise click.UsageError("a watched sheet is written to a directory, not printed")
    target = Path(output)

    def again() -> None:
        with suppress(SystemExit), guarded():  # the faults are printed already
            _build(
                (sheet,), formats, target, problems, space, steps, audit, explain, no_figures, templates,
                pdf_engine,
            )  # fmt: skip
        say(f"watching {sheet}; Ctrl-C ends it")

    with suppress(KeyboardInterrupt):
        for _ in saves(sheet, templates, target):
            again()


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
