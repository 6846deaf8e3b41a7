"""All the sheets of one command: their faults in the order in which they were given, their pages put in their
place at once."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from derive.errors import InOrder, NotAllWritten, SheetError, SheetErrors
from derive.jobs.wanted import Outcome, Task, Wanted
from derive.placing import aside, namesakes, put_all

if TYPE_CHECKING:
    from derive.auditing import Found

Progress: TypeAlias = Callable[[str], None]
Warn: TypeAlias = Callable[[SheetError], None]
Work: TypeAlias = Callable[[Sequence[Task]], list[Outcome]]
OTHERS = "the other sheets were written"


@dataclass(frozen=True, slots=True)
class Built:
    """What came of a command: files in the output folder, or texts; what was audited, what is explained."""

    files: tuple[Path, ...] = ()
    texts: tuple[str, ...] = ()
    audited: tuple[Found, ...] = ()
    explained: tuple[str, ...] = ()


def built(
    paths: Sequence[Path], wanted: Wanted, output: Path | None, jobs: int, progress: Progress, warn: Warn
) -> Built:
    """Builds the sheets, at most `jobs` at a time, each in a process where there are several.

    Raises SheetErrors with the faults of all of them, and nothing is written; NotAllWritten where some page
    could not be made, or an accident of ours befell some sheet.
    """
    if faults := namesakes(paths):
        raise SheetErrors(faults)
    folder: AbstractContextManager[Path | None] = aside(output) if output else nullcontext()
    with folder as place, _work(min(jobs, len(paths)), wanted, place, progress) as work:
        if len(paths) > 1:  # a slip of the pen is told at once
            _settle(work([Task("read", path) for path in paths]))
        outcomes = work([Task("build", path) for path in paths])
        for warning in chain.from_iterable(outcome.warnings for outcome in outcomes):
            warn(warning)
        _settle(outcomes)
        return _placed(outcomes, place, output)


def _settle(outcomes: Sequence[Outcome]) -> None:
    """Raises InOrder where a sheet has faults; the accidents of others are told with them."""
    if any(outcome.faults for outcome in outcomes):
        raise InOrder(fault for outcome in outcomes for fault in (*outcome.faults, *_accident(outcome)))


def _placed(outcomes: Sequence[Outcome], folder: Path | None, output: Path | None) -> Built:
    """Puts the pages in their place. Raises NotAllWritten where some are missing."""
    made = [outcome.made for outcome in outcomes]
    faults = [fault for outcome in outcomes for fault in (*_accident(outcome), *outcome.made.faults)]
    texts = tuple(text for outcome in outcomes for text in outcome.texts)
    if faults and not any(each.pages for each in made):
        raise InOrder(faults)
    files: tuple[Path, ...] = ()
    if folder and output:
        files = put_all(made, folder, output)
    if faults:
        failed = NotAllWritten(faults, files)
        if any(outcome.accident for outcome in outcomes):
            failed.outcome = OTHERS
        raise failed
    return Built(
        files,
        texts,
        tuple(found for outcome in outcomes for found in outcome.audited),
        tuple(line for outcome in outcomes for line in outcome.explained),
    )


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
