"""XML as elements that know their place. A file that declares a document type, and so might hold entities, is
refused before anything is expanded, and so is one that is too large."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from derive.errors import SheetError, SheetErrors
from derive.sheet.source import Source, Spot

MAX_ELEMENTS = 50_000
MAX_DEPTH = 100


@dataclass(frozen=True, slots=True)
class Element:
    """A tag, its attributes and what stands in it; `line` and `column`, in its `file`, count from 0."""

    tag: str
    attributes: dict[str, str]
    file: Source = field(repr=False)
    line: int = 0
    column: int = 0
    children: list[Element] = field(default_factory=list)

    def all(self, tag: str) -> list[Element]:
        """The children of this tag."""
        return [child for child in self.children if child.tag == tag]

    def one(self, tag: str) -> Element | None:
        """The child of this tag, None where there is none. Raises SheetErrors where there are more."""
        found = self.all(tag)
        if len(found) > 1:
            raise found[1].error(f"a <{self.tag}> has one <{tag}>")
        return found[0] if found else None

    def need(self, tag: str) -> Element:
        """The child of this tag. Raises SheetErrors."""
        if (found := self.one(tag)) is None:
            raise self.error(f"this <{self.tag}> has no <{tag}>")
        return found

    def text(self, name: str) -> str:
        """An attribute that must be there. Raises SheetErrors."""
        if not (found := self.attributes.get(name, "").strip()):
            raise self.error(f"this <{self.tag}> has no '{name}'")
        return found

    def fault(self, message: str, hint: str = "", attribute: str = "") -> SheetError:
        """A fault of the element, or of one of its attributes."""
        line, column = self.line, self.column
        if attribute and (found := self._attribute(attribute)):
            line, column = found
        return SheetError(message, self.file.place(line, column), hint)

    def error(self, message: str, hint: str = "", attribute: str = "") -> SheetErrors:
        """One fault that ends the reading of the element."""
        return SheetErrors([self.fault(message, hint, attribute)])

    @property
    def spot(self) -> Spot:
        """Where it begins."""
        return Spot(self.line, self.column, style="-")

    def _attribute(self, name: str) -> tuple[int, int] | None:
        """Where an attribute stands, on the first lines of the element."""
        for line in range(self.line, min(self.line + 10, len(self.file.lines))):
            start = self.column if line == self.line else 0
            if (column := self.file.lines[line].find(f"{name}=", start)) >= 0:
                return line, column
        return None


class _Growing:
    """The elements met so far, the open ones last."""

    def __init__(self, source: Source, parser: expat.XMLParserType) -> None:
        self.source, self.parser = source, parser
        self.open: list[Element] = []
        self.root: Element | None = None
        self.count = 0

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        line, column = self.parser.CurrentLineNumber - 1, self.parser.CurrentColumnNumber
        element = Element(tag, attributes, self.source, line, column)
        self.count += 1
        if self.count > MAX_ELEMENTS or len(self.open) >= MAX_DEPTH:
            raise element.error("too much is nested or repeated here")
        if self.open:
            self.open[-1].children.append(element)
        else:
            self.root = element
        self.open.append(element)

    def end(self, tag: str) -> None:
        self.open.pop()

    def doctype(self, *_: object) -> None:
        line, column = self.parser.CurrentLineNumber - 1, self.parser.CurrentColumnNumber
        message = "a file with a document type is not read: it might hold entities"
        hint = "leave <!DOCTYPE ...> out"
        raise SheetErrors([SheetError(message, self.source.place(line, column), hint)])


def elements(text: str, path: Path) -> Element:
    """The root of an XML text that is said to stand in `path`. Raises SheetErrors."""
    source = Source(path, None, {(): Spot(0, 0)}, tuple(text.split("\n")))
    parser = expat.ParserCreate()
    growing = _Growing(source, parser)
    parser.StartElementHandler = growing.start
    parser.EndElementHandler = growing.end
    parser.StartDoctypeDeclHandler = growing.doctype
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        place = source.place(error.lineno - 1, error.offset)
        message = f"this is no XML: {expat.ErrorString(error.code)}"
        raise SheetErrors([SheetError(message, place)]) from error
    if growing.root is None:
        raise SheetErrors([SheetError(f"{path}: the file is empty")])
    return growing.root
