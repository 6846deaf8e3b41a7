"""The work on one sheet, from its file to its pages in a folder aside."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from derive import build
from derive.errors import NotAsWritten, SheetError, SheetErrors
from derive.jobs.wanted import Outcome, Task, Wanted
from derive.known.files import Digests, as_read, digest, noting
from derive.messages import REPORT, apology, disk_behind
from derive.placing import Made
from derive.render.own_templates import fault_of
from derive.verify import AS_WRITTEN
from derive.writing import Progress, make, render

if TYPE_CHECKING:
    from derive.auditing import Found


def done(task: Task, wanted: Wanted, folder: Path | None, progress: Progress) -> Outcome:
    """What came of it. An accident of ours is told of its sheet, but raised where DERIVE_DEBUG is set.
    Raises OSError."""
    warnings: list[SheetError] = []
    try:
        if task.step == "read":
            build.load_all([task.sheet], progress)
            return Outcome()
        with noting() as notes:
            outcome = _built(task.sheet, wanted, folder, progress, warnings)
        return replace(outcome, read=as_read(notes), written=_written(outcome.made, folder))
    except SheetErrors as errors:
        return Outcome(tuple(warnings), errors.errors)
    except OSError:
        raise
    except Exception as error:
        if wanted.templates and (fault := fault_of(error, wanted.templates)):
            return Outcome(tuple(warnings), (fault,))
        if behind := disk_behind(error):
            raise behind from error
        if os.environ.get("DERIVE_DEBUG"):
            raise
        return Outcome(tuple(warnings), accident=accident(error, task.sheet))


def _written(made: Made, folder: Path | None) -> Digests:
    """What was made, by its place in the output folder."""
    if folder is None:
        return ()
    return tuple((path.relative_to(folder).as_posix(), digest(path)) for path in (*made.beside, *made.pages))


def accident(error: Exception, sheet: Path) -> SheetError:
    """A fault of ours, told of the sheet that met it."""
    if isinstance(error, NotAsWritten):
        where = getattr(error, "__notes__", [f"{sheet}: "])[0]
        return SheetError(f"{where}{AS_WRITTEN}", None, REPORT)
    if not hasattr(error, "__notes__"):
        error.add_note(f"{sheet}: ")
    said, _, report = apology(error).partition("\n")
    return SheetError(said, None, report)


def _built(
    path: Path, wanted: Wanted, folder: Path | None, progress: Progress, warnings: list[SheetError]
) -> Outcome:
    (read,) = build.load_all([path], progress)
    sheet = build.as_asked(read, wanted.figures, wanted.steps)
    warnings.extend(sheet.warnings)
    progress(f"deriving {path.stem}")
    document = replace(build.assemble(sheet, not wanted.problems, warnings.append), space=wanted.space)
    found: tuple[Found, ...] = ()
    told: tuple[str, ...] = ()
    made, texts = Made(), tuple[str, ...]()
    if wanted.audit:
        from derive.auditing import audited

        found = audited([sheet], [document], progress)
    progress(f"writing {path.stem}")
    if folder:
        made = make(sheet, document, wanted.formats, folder, wanted.pdf_engine)
    else:
        texts = tuple(render(document, kind) for kind in wanted.formats)
    if wanted.explain:
        from derive.explaining import explained

        told = tuple(explained([document]))
    return Outcome(tuple(warnings), made=made, texts=texts, audited=found, explained=told)
