"""What a browser shows of a sheet at one moment, and who waits for the next."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from threading import Condition
from typing import Any

from derive.errors import SheetError, written
from derive.sheet.model import Steps
from derive.sheet.source import At, Route, Source


@dataclass(frozen=True, slots=True)
class Said:
    """A fault or a warning, as the terminal has it. Where it stands in the sheet itself it has a line and a
    column, which count from 1."""

    text: str
    message: str
    hint: str = ""
    line: int = 0
    column: int = 0


@dataclass(frozen=True, slots=True)
class Section:
    """A problem or a question: its name in the page, and the lines of the sheet in which it stands."""

    id: str
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class View:
    """All that is shown. `page` is the last good one, the `pages`-th that was made; while the sheet is wrong
    there are `faults`, and the page is that of an earlier text. `proved` is what is known of its answers."""

    number: int = 0
    building: bool = True
    name: str = ""
    source: tuple[str, ...] = ()
    sections: tuple[Section, ...] = ()
    faults: tuple[Said, ...] = ()
    warnings: tuple[Said, ...] = ()
    page: str = ""
    pages: int = 0
    made: str = ""  # when
    seconds: float = 0.0  # that it took
    steps: Steps | None = None  # None: as the sheet says
    proved: tuple[str, ...] = ()

    def told(self) -> dict[str, Any]:
        """The view as data, without the page, which is fetched apart."""
        return {name: value for name, value in asdict(self).items() if name != "page"}


class Shown:
    """The view of the moment. Whoever looks may wait for the next one."""

    def __init__(self, view: View) -> None:
        self.view = view
        self.ended = False
        self._changed = Condition()

    def show(self, **changes: Any) -> None:
        """Shows the view with these changes."""
        with self._changed:
            self.view = replace(self.view, number=self.view.number + 1, **changes)
            self._changed.notify_all()

    def end(self) -> None:
        """Lets all go who wait."""
        with self._changed:
            self.ended = True
            self._changed.notify_all()

    def after(self, number: int, patience: float) -> View | None:
        """The view, once it is another than the one of this number; None where nothing happened for so many
        seconds, or nothing will."""
        with self._changed:
            self._changed.wait_for(lambda: self.ended or self.view.number != number, patience)
            return None if self.ended or self.view.number == number else self.view


def said(error: SheetError, sheet: str) -> Said:
    """A fault as a browser shows it; only in the sheet itself has it a line to jump to."""
    place = error.place
    if place is None or place.file != sheet:
        return Said(written(error), error.message, error.hint)
    return Said(written(error), error.message, error.hint, place.line, place.column)


def sections(source: Source) -> Iterator[Section]:
    """Problems and questions in the order of the sheet, with the names that their headings have."""
    for k, (first, last) in enumerate(_ranges(source, ("problems",), len(source.lines)), 1):
        yield Section(f"problem-{k}", first, last)
        for j, lines in enumerate(_ranges(source, ("problems", k - 1, "questions"), last), 1):
            yield Section(f"question-{k}-{j}", *lines)


def _ranges(source: Source, route: Route, end: int) -> Iterator[tuple[int, int]]:
    """The first and the last line of each entry of a list."""
    entries = At(source, route).value()
    count = len(entries) if isinstance(entries, list) else 0
    starts = [source.spots[*route, index].line + 1 for index in range(count)]
    return zip(starts, [*(start - 1 for start in starts[1:]), end], strict=bool(starts))
