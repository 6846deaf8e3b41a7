"""All the sheets of one command: their faults in the order in which they were given, their pages put in their
place at once."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from derive.errors import InOrder, NotAllWritten, SheetError, SheetErrors
from derive.jobs.wanted import Outcome, Task, Wanted
from derive.known.stamps import Stamps, folder
from derive.placing import aside, namesakes, put_all

if TYPE_CHECKING:
    from derive.auditing import Found

Progress: TypeAlias = Callable[[str], None]
Warn: TypeAlias = Callable[[SheetError], None]
Warnings: TypeAlias = tuple[SheetError, ...]
Work: TypeAlias = Callable[[Sequence[Task]], list[Outcome]]
OTHERS = "the other sheets were written"


@dataclass(frozen=True, slots=True)
class Built:
    """What came of a command: files in the output folder, or texts; what was audited, what is explained; the
    sheets that are as they were."""

    files: tuple[Path, ...] = ()
    texts: tuple[str, ...] = ()
    audited: tuple[Found, ...] = ()
    explained: tuple[str, ...] = ()
    unchanged: tuple[Path, ...] = ()


def built(
    paths: Sequence[Path],
    wanted: Wanted,
    output: Path | None,
    jobs: int,
    progress: Progress,
    warn: Warn,
    cache: bool = False,
) -> Built:
    """Builds the sheets, at most `jobs` at a time, each in a process where there are several. With a `cache`
    those are left as they are of which nothing has changed.

    Raises SheetErrors with the faults of all of them, and nothing is written; NotAllWritten where some page
    could not be made, or an accident of ours befell some sheet.
    """
    if faults := namesakes(paths):
        raise SheetErrors(faults)
    stamps = _stamps(wanted, output) if cache and output else None
    known = _known(paths, stamps) if stamps and not wanted.audit and not wanted.explain else {}
    rest = [path for path in paths if path not in known]
    if not rest:
        _tell(known, paths, warn)
        return Built(unchanged=tuple(paths))
    where: AbstractContextManager[Path | None] = aside(output) if output else nullcontext()
    with where as place, _work(min(jobs, len(rest)), wanted, place, progress) as work:
        if len(rest) > 1:  # a slip of the pen is told at once
            _settle(work([Task("read", path) for path in rest]))
        outcomes = work([Task("build", path) for path in rest])
        _tell(known | {path: each.warnings for path, each in zip(rest, outcomes, strict=True)}, paths, warn)
        _settle(outcomes)
        files = put_all([each.made for each in outcomes], place, output) if place and output else ()
    if stamps and stamps.sure():
        for path, outcome in zip(rest, outcomes, strict=True):
            if outcome.whole and outcome.read:
                stamps.remember(path, outcome.read, outcome.written, outcome.warnings)
    if faults := [fault for each in outcomes for fault in (*_accident(each), *each.made.faults)]:
        raise _missing(faults, files, any(each.accident for each in outcomes))
    return Built(
        files,
        tuple(text for each in outcomes for text in each.texts),
        tuple(found for each in outcomes for found in each.audited),
        tuple(line for each in outcomes for line in each.explained),
        tuple(known),
    )


def _stamps(wanted: Wanted, output: Path) -> Stamps | None:
    """Where what was built is remembered; not where LaTeX makes pages, as what it has installed is not known
    here."""
    if "pdf" in wanted.formats and wanted.pdf_engine == "latex":
        return None
    options = repr(replace(wanted, audit=False, explain=False))
    place = folder()
    return Stamps(place, output, options, wanted.formats, wanted.templates) if place else None


def _known(paths: Sequence[Path], stamps: Stamps) -> dict[Path, Warnings]:
    """The sheets of which nothing has changed, with the warnings about them."""
    found = {path: stamps.known(path) for path in paths}
    return {path: warnings for path, warnings in found.items() if warnings is not None}


def _tell(warnings: Mapping[Path, Warnings], paths: Sequence[Path], warn: Warn) -> None:
    """The warnings about each sheet, in the order in which these were given."""
    for warning in chain.from_iterable(warnings[path] for path in paths):
        warn(warning)


def _settle(outcomes: Sequence[Outcome]) -> None:
    """Raises InOrder where a sheet has faults; the accidents of others are told with them."""
    if any(outcome.faults for outcome in outcomes):
        raise InOrder(fault for outcome in outcomes for fault in (*outcome.faults, *_accident(outcome)))


def _missing(faults: Sequence[SheetError], files: tuple[Path, ...], accident: bool) -> SheetErrors:
    """Why not all pages were written."""
    if not files:
        return InOrder(faults)
    failed = NotAllWritten(faults, files)
    if accident:
        failed.outcome = OTHERS
    return failed


def _accident(outcome: Outcome) -> tuple[SheetError, ...]:
    return (outcome.accident,) if outcome.accident else ()


@contextmanager
def _work(jobs: int, wanted: Wanted, folder: Path | None, progress: Progress) -> Iterator[Work]:
    """Who does the work: this process, or others. What came of each task stands in the order of the tasks."""
    if jobs > 1:
        from derive.jobs.workers import Workers

        with _dressed(wanted), Workers(jobs, wanted, folder) as workers:
            yield lambda tasks: workers.outcomes(tasks, progress)
        return
    from derive.jobs.one import done

    gc.set_threshold(100_000, 50, 50)  # trees are many and hold no cycles
    with _dressed(wanted):
        yield lambda tasks: [done(task, wanted, folder, progress) for task in tasks]


def _dressed(wanted: Wanted) -> AbstractContextManager[None]:
    """The author's templates, whose faults are told once for all sheets."""
    if wanted.templates is None:
        return nullcontext()
    from derive.render.own_templates import dressed

    return dressed(wanted.templates)
