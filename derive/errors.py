"""The only errors a user meets: each says what is wrong, where, and what to write instead."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

LONGEST = 120  # columns of a line that is quoted whole


def how_many(count: int, one: str, more: str = "") -> str:
    """1 entry, 2 entries."""
    return f"{count} {one if count == 1 else more or one + 's'}"


@dataclass(frozen=True, slots=True)
class Place:
    """A spot in a sheet. Lines and columns count from 1; `text` is the whole line."""

    file: str
    line: int
    column: int
    text: str = ""

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


class SheetError(Exception):
    """One fault of a sheet: what is wrong, where (if known), and a hint what to write."""

    def __init__(self, message: str, place: Place | None = None, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.place = place
        self.hint = hint

    def at(self, place: Place) -> SheetError:
        """The same fault with its place, unless it already knows a closer one."""
        return self if self.place else SheetError(self.message, place, self.hint)


class SheetErrors(Exception):
    """Every fault of a sheet at once, in the order of the file; there is at least one. `outcome` is what came
    of them."""

    outcome = "nothing was written"

    def __init__(self, errors: Iterable[SheetError]) -> None:
        self.errors = tuple(sorted(errors, key=position))
        if not self.errors:  # what is without faults must not be left out as if it had some
            raise ValueError("no fault was given")
        super().__init__(f"{len(self.errors)} fault(s)")

    def __str__(self) -> str:
        return "\n".join(map(written, self.errors))


class InOrder(SheetErrors):
    """Those of several sheets, one sheet after the other, each once."""

    def __init__(self, errors: Iterable[SheetError]) -> None:
        each = list({(error.place, error.message): error for error in errors}.values())
        super().__init__(each)
        self.errors = tuple(each)


class NotAllWritten(InOrder):
    """The faults of pages that could not be made, and the files that were written all the same."""

    outcome = "the other pages were written"

    def __init__(self, errors: Iterable[SheetError], files: tuple[Path, ...]) -> None:
        super().__init__(errors)
        self.files = files


def written(error: SheetError) -> str:
    """A fault as plain text: place and message, the line, a caret, what to write instead."""
    place = error.place
    if place is None:
        lines = [error.message]
    else:
        lines = [f"{place}: {error.message}"]
        if place.text:
            text, column = _window(shown(place.text), place.column)
            lines += [f"    {text}", f"    {' ' * _column(text, column)}^"]
    if error.hint:
        lines.append(f"    hint: {error.hint}")
    return "\n".join(lines)


def _window(text: str, column: int) -> tuple[str, int]:
    """The part of a long line around a column, and the column in it."""
    if len(text) <= LONGEST:
        return text, column
    start = max(0, min(column - 1 - LONGEST // 2, len(text) - LONGEST))
    end = start + LONGEST
    before, after = "..." * (start > 0), "..." * (end < len(text))
    return before + text[start:end] + after, column - start + len(before)


def shown(text: str) -> str:
    """A line as one prints it: a tab is one blank wide, control characters are dots."""
    return "".join(char if char.isprintable() else " " if char == "\t" else "." for char in text)


def _column(text: str, column: int) -> int:
    """How far to the right the caret stands: wide characters take two columns."""
    from unicodedata import combining, east_asian_width

    before = text[: column - 1]
    wide = sum(east_asian_width(char) in "WF" for char in before)
    return column - 1 + wide - sum(combining(char) > 0 for char in before)


@contextmanager
def met_at(place: Place | None) -> Iterator[None]:
    """An accident of ours within, which is told with this place unless it knows a closer one."""
    try:
        yield
    except Exception as error:
        if place and not hasattr(error, "__notes__"):
            error.add_note(f"{place}: ")
        raise


class FormulaError(ValueError):
    """A formula that cannot be read. `offset` is where in its text, from 0."""

    def __init__(self, message: str, offset: int = 0, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.offset = offset
        self.hint = hint


class Unfit(FormulaError):
    """A formula that is well written, and too large to be read or without a value."""


class NotDerivable(Exception):
    """What was asked has no answer this program can derive; the message says why. `about` is the option, or
    the key of the subject, that it is about, where there is one; point/link is a key within it."""

    def __init__(self, message: str = "", about: str = "") -> None:
        super().__init__(message)
        self.about = about


class TooManyTerms(NotDerivable):
    """An answer with more terms than anyone reads; in numbers there may be one."""


class NotAsWritten(Exception):
    """A check that failed: the tree that was made of a value is not equal to it."""


class NotReal(NotDerivable, ValueError):
    """A number that is not real: the square root of -4."""


class TooLarge(NotDerivable, OverflowError):
    """A number that no floating-point number can stand for: exp(1000)."""


class DivisionByZero(NotDerivable, ZeroDivisionError):
    """A division by an expression that is zero whatever its symbols are."""


def position(error: SheetError) -> tuple[str, int, int]:
    """The order of the files and of the places in them."""
    place = error.place
    return (place.file, place.line, place.column) if place else ("", 0, 0)
