"""The data of a robot as a YAML file would hold it, each part with its place in the file it came from."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import TypeAlias

from derive.errors import SheetError
from derive.sheet.exchange.elements import Element
from derive.sheet.source import Route, Source, Spot

Data: TypeAlias = "str | list[Data] | dict[str, Data]"

PLAIN = re.compile(r"[\w(.\-][\w .+*/^()\-]*")  # what needs no quotes inside of brackets
NOT_TEXT = frozenset(("null", "true", "false"))  # without quotes
WIDE = 110


class Told:
    """What is known of a robot so far, the notes that stand beside its rows, and what is strange about it."""

    def __init__(self, root: Element, title: str = "") -> None:
        self.root = root
        self.title = title
        self.data: dict[str, Data] = {}
        self.spots: dict[Route, Spot] = {(): root.spot}
        self.notes: list[str] = []
        self.doubts: list[SheetError] = []

    def put(self, value: Data, element: Element, key: str, index: int | None = None, part: str = "") -> None:
        """A key of the robot, or a part of one of its rows, from this element."""
        spot = element.spot if element.file is self.root.file else self.root.spot
        if index is None:
            self.data[key] = value
            self.spots[key,] = spot
            return
        rows = self.data.setdefault(key, [])
        assert isinstance(rows, list)
        while len(rows) <= index:
            self.spots[key, len(rows)] = spot
            rows.append({})
        row = rows[index]
        assert isinstance(row, dict)
        row[part] = value
        self.spots[key, index, part] = spot
        self.spots.setdefault((key,), spot)

    def source(self) -> Source:
        """As if it had been read from YAML; its places are those of the file that was imported."""
        file = self.root.file
        return Source(file.path, self.data, self.spots, file.lines, list(self.doubts))

    def yaml(self) -> str:
        """The text of a YAML file."""
        return "\n".join(self._lines()) + "\n"

    def _lines(self) -> Iterator[str]:
        comes = f": {self.title}" if self.title else ""
        yield f"# From {_one_line(self.root.file.path.name)}{_one_line(comes)}"
        for key, value in self.data.items():
            if key != "links" or not isinstance(value, list):
                yield f"{key}: {flow(value)}"
                continue
            yield "links:"
            for row, note in zip(value, self.notes, strict=True):
                yield from _row(row, note)


def _row(row: Data, note: str) -> Iterator[str]:
    assert isinstance(row, dict)
    said = f"  # {_one_line(note)}" if note else ""
    whole = f"- {flow(row)}"
    if len(whole) + len(said) <= WIDE:
        yield whole + said
        return
    for k, (key, value) in enumerate(row.items()):
        yield f"{' ' if k else '-'} {key}: {flow(value)}" + ("" if k else said)


def flow(value: Data) -> str:
    """A value on one line."""
    match value:
        case list():
            return f"[{', '.join(map(flow, value))}]"
        case dict():
            return "{" + ", ".join(f"{key}: {flow(each)}" for key, each in value.items()) + "}"
    plain = PLAIN.fullmatch(value) and value == value.strip() and not value.startswith(("- ", "-."))
    return value if plain and value.lower() not in NOT_TEXT else json.dumps(value, ensure_ascii=False)


def _one_line(text: str) -> str:
    return " ".join("".join(char if char.isprintable() else " " for char in text).split())
