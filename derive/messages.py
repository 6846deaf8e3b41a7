"""What the command says on the standard error: faults with their place, progress, an apology."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from errno import EDQUOT, EFBIG, ENOSPC, EPIPE
from time import monotonic
from typing import TYPE_CHECKING, NoReturn

import click

from derive.errors import SheetError, SheetErrors, written

if TYPE_CHECKING:
    from rich.console import Console
    from rich.status import Status

PATIENCE = 1.0  # seconds before progress is shown
FULL = (ENOSPC, EDQUOT, EFBIG)  # no room on the disk
REPORT = "please report it at the project's issue page, with the sheet"


@contextmanager
def guarded() -> Iterator[None]:
    """Runs a command: faults are printed, then exit 1; the unexpected becomes one line and exit 1.

    With DERIVE_DEBUG set in the environment the unexpected keeps its traceback.
    """
    try:
        yield
    except SheetErrors as errors:
        report(errors)
        sys.exit(1)
    except (click.ClickException, click.exceptions.Exit, click.Abort):
        raise
    except OSError as error:
        if os.environ.get("DERIVE_DEBUG") or error.errno == EPIPE:  # nobody reads on: click ends quietly
            raise
        _refused(error)
    except Exception as error:
        if os.environ.get("DERIVE_DEBUG"):
            raise
        if (behind := disk_behind(error)) is not None:
            _refused(behind)
        click.echo(apology(error), err=True)
        sys.exit(1)


def apology(error: Exception) -> str:
    """Two lines on what should not have happened."""
    summary = (str(error).splitlines() or [""])[0]
    where = getattr(error, "__notes__", [""])[0]
    failed = f"{where}derive failed, and should not have: {type(error).__name__}: {summary}"
    return f"{failed}\n{REPORT}; DERIVE_DEBUG=1 shows where"


def _refused(error: OSError) -> NoReturn:
    """What the system did not do, in a sentence; then exit 1."""
    said = "this is no directory" if isinstance(error, FileExistsError) else error.strerror or str(error)
    where = error.filename or "this could not be written"
    click.echo(f"{where}: {said[:1].lower()}{said[1:]}", err=True)
    sys.exit(1)


def disk_behind(error: BaseException | None) -> OSError | None:
    """A full disk behind an accident: who was writing may stumble over it while clearing up."""
    while error is not None:
        if isinstance(error, OSError) and error.errno in FULL:
            return error
        error = error.__cause__ or error.__context__
    return None


def report(errors: SheetErrors, outcome: str = "") -> None:
    """Every fault on the standard error, in colour on a terminal; then how many, and what came of it."""
    if sys.stderr.isatty():
        console = _console()
        for error in errors.errors:
            _coloured(console, error)
    else:
        click.echo("\n".join(written(error) for error in errors.errors), err=True)
    count = len(errors.errors)
    click.echo(f"{count} fault{'s' * (count != 1)}; {outcome or errors.outcome}", err=True)


def warn(warning: SheetError) -> None:
    """Something strange on the standard error, which stops nothing."""
    click.echo(written(SheetError(f"warning: {warning.message}", warning.place, warning.hint)), err=True)


def _coloured(console: Console, error: SheetError) -> None:
    from rich.text import Text

    rest = written(error).splitlines()[1:]
    line = Text()
    if error.place:
        line.append(f"{error.place}: ", "bold")
    line.append(error.message, "bold red")
    console.print(line, soft_wrap=True)
    for text in rest:
        style = "green" if text.startswith("    hint") else "red" if text.strip() == "^" else "default"
        console.print(Text(text, style), soft_wrap=True)


def page(text: str) -> None:
    """A text on the standard output: the bytes that a file would hold, or what a terminal can show of it.

    Raises OSError where it cannot be written.
    """
    out = sys.stdout
    out.flush()
    encoding = out.encoding if out.isatty() else "utf-8"
    out.buffer.write(text.encode(encoding, errors="backslashreplace"))
    out.buffer.flush()


def say(text: str) -> None:
    """A line on the standard error: what was written."""
    click.echo(text, err=True)


@contextmanager
def progress() -> Iterator[Callable[[str], None]]:
    """A spinner with the present step, once a command takes longer than a moment, on a terminal only."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    started = monotonic()
    status: Status | None = None

    def step(text: str) -> None:
        nonlocal status
        if status is not None:
            status.update(text)
        elif monotonic() - started > PATIENCE:
            status = _console().status(text)
            status.start()

    try:
        yield step
    finally:
        if status is not None:
            status.stop()


def _console() -> Console:
    from rich.console import Console

    return Console(stderr=True)
