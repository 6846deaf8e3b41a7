"""A file of the sheet language as plain data, with the place of every key and value."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from derive.errors import Place, SheetError, SheetErrors

Route: TypeAlias = tuple[str | int, ...]  # keys and indices from the top of a file


@dataclass(frozen=True, slots=True)
class Spot:
    """Where a value begins (line and column from 0), its key if it has one, and how it is quoted."""

    line: int
    column: int
    key: tuple[int, int] | None = None
    style: str = ""  # of a scalar: "" plain, ' or " quoted, | or > block, "-" over several lines


@dataclass(frozen=True, slots=True)
class Source:
    """What a file holds: mappings, lists and the text of scalars exactly as typed (None if empty)."""

    path: Path
    data: Any
    spots: Mapping[Route, Spot]
    lines: tuple[str, ...]
    doubts: list[SheetError] = field(default_factory=list, compare=False)  # met while it was understood

    def lonely(self, word: str) -> bool:
        """Whether a word stands only directly behind numbers in this file, as a unit does."""
        if not word:
            return True
        text = "\n".join(self.lines)
        everywhere = re.findall(rf"(?<!\w){re.escape(word)}(?!\w)|\d{re.escape(word)}(?!\w)", text)
        return len(everywhere) == len(re.findall(rf"[\d.]\s*{re.escape(word)}(?!\w)", text))

    def place(self, line: int, column: int) -> Place:
        """A place by line and column from 0."""
        text = self.lines[line] if line < len(self.lines) else ""
        return Place(str(self.path), line + 1, column + 1, text)


class Faults(list[SheetError]):
    """The faults met so far: reading goes on, so that all of them are told at once."""

    @contextmanager
    def gathered(self) -> Iterator[None]:
        """Adds those that are raised within."""
        try:
            yield
        except SheetErrors as errors:
            self.extend(errors.errors)

    def settle(self) -> None:
        """Raises SheetErrors where there are any."""
        if self:
            raise SheetErrors(self)


@dataclass(frozen=True, slots=True)
class At:
    """A value in a file; faults are reported by their way from here."""

    source: Source
    route: Route = ()

    def __truediv__(self, step: str | int) -> At:
        return At(self.source, (*self.route, step))

    def place(self, route: Route = (), offset: int = 0) -> Place:
        """Where a value stands, `offset` characters into it; the nearest that exists above it."""
        spot, found = self._nearest(route)
        if len(found) < len(self.route) + len(route):
            offset = 0
        return self._inside(spot, found, offset)

    def key(self, route: Route) -> Place:
        """Where the key of a value stands; the value itself where it has none."""
        spot, found = self._nearest(route)
        if spot.key is None or len(found) < len(self.route) + len(route):
            return self.place(route)
        return self.source.place(*spot.key)

    def fault(self, message: str, route: Route = (), hint: str = "", key: bool = False) -> SheetError:
        """A fault of the value there, or of its key."""
        return SheetError(message, self.key(route) if key else self.place(route), hint)

    def error(self, message: str, route: Route = (), hint: str = "", key: bool = False) -> SheetErrors:
        """One fault that ends the reading of what it stands in."""
        return SheetErrors([self.fault(message, route, hint, key)])

    def value(self, route: Route = ()) -> Any:
        """The data there, None where there is none."""
        data = self.source.data
        for step in (*self.route, *route):
            try:
                data = data[step]
            except (KeyError, IndexError, TypeError):
                return None
        return data

    def _nearest(self, route: Route) -> tuple[Spot, Route]:
        whole = (*self.route, *route)
        while whole not in self.source.spots:
            whole = whole[:-1]
        return self.source.spots[whole], whole

    def _inside(self, spot: Spot, whole: Route, offset: int) -> Place:
        source = self.source
        if spot.style in ("", "'", '"'):
            return source.place(spot.line, spot.column + offset + len(spot.style))
        text = At(source, whole).value()
        if spot.style != "|" or not isinstance(text, str):
            return source.place(spot.line, spot.column)
        line = spot.line + 1 + text[:offset].count("\n")
        within = text.split("\n")[text[:offset].count("\n")]
        raw = source.lines[line] if line < len(source.lines) else ""
        start = text[:offset].rfind("\n") + 1
        return source.place(line, len(raw.rstrip()) - len(within.rstrip()) + offset - start)
