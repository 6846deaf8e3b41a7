"""YAML files read into sources: composed to nodes and no further, so that nothing typed is changed."""

from __future__ import annotations

import re
from pathlib import Path
from stat import S_ISREG
from typing import TYPE_CHECKING, Any

from ruamel.yaml.composer import Composer, ComposerError

from derive.errors import Place, SheetError, SheetErrors
from derive.known.files import noted
from derive.sheet.source import Faults, Route, Source, Spot
from derive.sheet.yaml_faults import QUOTES, explain, taken_by_quotes, unprintable

MAX_VALUES = 40_000  # of a sheet
TOO_MANY = "too many values"

if TYPE_CHECKING:
    from ruamel.yaml.nodes import MappingNode, Node, SequenceNode

MAX_BYTES = 1_000_000
MAX_DEPTH = 30
TAG = "tag:yaml.org,2002:"
LINE_ENDS = re.compile("\r\n|[\n\r\x85\u2028\u2029]")  # those of YAML
TAGS = frozenset(TAG + name for name in ("map", "seq", "str", "int", "float", "bool", "null", "timestamp"))


def read(path: Path) -> Source:
    """The contents of a YAML file. Raises SheetErrors."""
    return read_text(_text(path), path)


def read_text(text: str, path: Path) -> Source:
    """The contents of YAML text said to stand in `path`. Raises SheetErrors."""
    lines = tuple(LINE_ENDS.split(text))
    root = _compose(text, path, lines)
    reading = _Reading(path, text, lines)
    data = reading.value(root, ())
    if reading.faults:
        raise SheetErrors(reading.faults)
    return Source(path, data, reading.spots, lines)


def _text(path: Path) -> str:
    noted(path)
    try:
        if not S_ISREG(path.stat().st_mode):  # a pipe or a device might never end
            hint = "a sheet is a file ending in .yaml"
            raise SheetErrors([SheetError(f"{path}: this is no ordinary file", None, hint)])
        with path.open("rb") as file:
            content = file.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            raise SheetErrors([SheetError(f"{path}: the file is larger than 1 MB", None, "split the sheet")])
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        hint = "save the file as UTF-8"
        raise SheetErrors([SheetError(f"{path}: the file is not UTF-8 text", None, hint)]) from error
    except OSError as error:
        raise SheetErrors([SheetError(f"{path}: {error.strerror or error}")]) from error


def _compose(text: str, path: Path, lines: tuple[str, ...]) -> Node:
    from ruamel.yaml import YAML
    from ruamel.yaml.error import YAMLError

    from derive.sheet.reader import Counting

    yaml = YAML(typ="safe", pure=True)
    yaml.Composer = Counting
    try:
        root = yaml.compose(text)
    except RecursionError as error:
        raise SheetErrors([SheetError(f"{path}: lists and mappings are nested too deeply")]) from error
    except (YAMLError, ValueError) as error:
        raise SheetErrors([explain(error, path, lines)]) from error
    if root is None:
        hint = "start it with 'derive new NAME'"
        raise SheetErrors([SheetError("the file is empty", Place(str(path), 1, 1, ""), hint)])
    found: Node = root
    return found


class _Reading:
    """Nodes to plain data, gathering the spot of each value and every fault."""

    def __init__(self, path: Path, text: str, lines: tuple[str, ...]) -> None:
        self.path = path
        self.text = text
        self.lines = lines
        self.spots: dict[Route, Spot] = {}
        self.faults = Faults()
        self.count = 0

    def value(self, node: Node, route: Route, key: tuple[int, int] | None = None) -> Any:
        from ruamel.yaml.nodes import MappingNode, SequenceNode

        from derive.sheet.reader import MAX_VALUES

        self.count += 1  # as they expand: an alias counts each time
        if self.count == MAX_VALUES or (self.count < MAX_VALUES and len(route) > MAX_DEPTH):
            self.fault(node, "too much is nested or repeated here", "write it out, or make it several sheets")
            self.count = MAX_VALUES
        line, column = node.start_mark.line, node.start_mark.column
        if key and line > key[0] and node.start_mark.index == node.end_mark.index:
            line, column = key  # nothing stands behind the key: what comes next is not its value
        self.spots[route] = Spot(line, column, key, _style(node))
        if self.count >= MAX_VALUES:
            return None
        if node.tag not in TAGS:
            self.fault(node, f"the tag {str(node.tag).removeprefix(TAG)} has no meaning here", "leave it out")
        if isinstance(node, MappingNode):
            return self.mapping(node, route)
        if isinstance(node, SequenceNode):
            return self.sequence(node, route)
        self.characters(node)
        return _scalar(node)

    def mapping(self, node: MappingNode, route: Route) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for key, value in node.value:
            if not isinstance(key.value, str):
                self.fault(key, "a key must be plain text", "write it as key: value")
                continue
            self.characters(key)
            if key.value in found:
                first = self.spots[(*route, key.value)].key or (0, 0)
                self.fault(key, f"'{key.value}' is given twice", f"it stands in line {first[0] + 1} already")
                continue
            mark = (key.start_mark.line, key.start_mark.column)
            found[key.value] = self.value(value, (*route, key.value), mark)
        return found

    def sequence(self, node: SequenceNode, route: Route) -> list[Any]:
        return [self.value(entry, (*route, index)) for index, entry in enumerate(node.value)]

    def characters(self, node: Node) -> None:
        """The first character that cannot stand in a sheet, as a fault."""
        start = node.start_mark.index
        if getattr(node, "style", None) == '"':
            for offset, escape in taken_by_quotes(self.text[start : node.end_mark.index]):
                message = f"in double quotes YAML takes {escape} for a control character"
                self.faults.append(SheetError(message, self.place(start + offset), QUOTES))
                return
        if (char := unprintable(str(node.value))) is not None:
            self.fault(node, f"the character U+{ord(char):04X} cannot be printed", "leave it out")

    def place(self, index: int) -> Place:
        """The place of a character of the text."""
        before = LINE_ENDS.split(self.text[:index])
        return Place(str(self.path), len(before), len(before[-1]) + 1, self.lines[len(before) - 1])

    def fault(self, node: Node, message: str, hint: str) -> None:
        line, column = node.start_mark.line, node.start_mark.column
        text = self.lines[line] if line < len(self.lines) else ""
        self.faults.append(SheetError(message, Place(str(self.path), line + 1, column + 1, text), hint))


def _scalar(node: Node) -> str | None:
    return None if node.tag == TAG + "null" else str(node.value)


def _style(node: Node) -> str:
    style = getattr(node, "style", None) or ""
    lines = node.end_mark.line > node.start_mark.line
    return "-" if lines and style in ("", "'", '"') else style


class Counting(Composer):
    """Raises ComposerError at the first node that is too many; a key is one, its value another."""

    def __init__(self, loader: Any = None) -> None:
        super().__init__(loader=loader)
        self.warn_double_anchors = False
        self.nodes = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        """The node, counted. Raises ComposerError where there are too many."""
        self.nodes += 1
        if self.nodes > 2 * MAX_VALUES:
            raise ComposerError(None, None, TOO_MANY, self.parser.peek_event().start_mark)
        return super().compose_node(parent, index)
