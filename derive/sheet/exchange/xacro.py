"""Xacro expanded to URDF: properties, arguments, macros with blocks, conditions, files included. Counted, so
that no file can grow without end; what is only seen (visual, collision, gazebo, ...) is left out unread."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from derive.errors import SheetError, SheetErrors
from derive.sheet.exchange.elements import MAX_ELEMENTS, Element
from derive.sheet.exchange.library import Library
from derive.sheet.exchange.values import plain
from derive.sheet.exchange.xacro_values import Given, NoValue, said, value
from derive.sheet.faults import did_you_mean

PREFIX = "xacro:"
SEEN_ONLY = frozenset(
    ("visual", "collision", "gazebo", "transmission", "material", "ros2_control", "safety_controller")
)
MAX_DEPTH = 40  # of macros in macros, and of files in files
BRACED = re.compile(r"\$\{([^{}]*)\}|\$\(([^()]*)\)")
PACKAGE = re.compile(r"\$\(find ([\w.-]+)\)/(.+)")
Read = Callable[[Path], Element]


@dataclass(frozen=True, slots=True)
class _Macro:
    parameters: tuple[str, ...]
    element: Element


@dataclass(slots=True)
class Scope:
    """The names that can be seen at a place."""

    outer: Scope | None = None
    values: dict[str, str | Given] = field(default_factory=dict)
    raw: dict[str, Element] = field(default_factory=dict)  # where a value stands that is to be worked out
    blocks: dict[str, list[Element]] = field(default_factory=dict)

    def holder(self, name: str) -> Scope | None:
        """The scope in which a name has its value."""
        scope: Scope | None = self
        while scope is not None and name not in scope.values:
            scope = scope.outer
        return scope

    def block(self, name: str) -> list[Element] | None:
        """The elements that a macro was given."""
        scope: Scope | None = self
        while scope is not None and name not in scope.blocks:
            scope = scope.outer
        return None if scope is None else scope.blocks[name]

    @property
    def top(self) -> Scope:
        """That of the file."""
        return self if self.outer is None else self.outer.top


def expanded(root: Element, read: Read, library: Library) -> tuple[Element, list[SheetError]]:
    """The description as plain URDF, and which files were not found. Raises SheetErrors."""
    expanding = _Expanding(read, library)
    try:
        children = list(expanding.all(root.children, Scope(), 0))
    except SheetErrors as errors:
        raise SheetErrors([*expanding.doubts, *errors.errors]) from errors
    if expanding.macros and not any(child.tag == "link" for child in children):
        hint = "import the file that calls them"
        raise root.error("this file holds macros, and no link stands outside of them", hint)
    return replace(root, children=children), expanding.doubts


class _Expanding:
    def __init__(self, read: Read, library: Library) -> None:
        self.read = read
        self.library = library
        self.macros: dict[str, _Macro] = {}
        self.arguments: dict[str, str] = {}
        self.doubts: list[SheetError] = []
        self.count = 0
        self.working: list[str] = []

    def all(self, elements: list[Element], scope: Scope, depth: int) -> Iterator[Element]:
        for element in elements:
            yield from self.one(element, scope, depth)

    def one(self, element: Element, scope: Scope, depth: int) -> Iterator[Element]:
        self.count += 1
        if self.count > MAX_ELEMENTS or depth > MAX_DEPTH:
            raise element.error("this grows too large: macros or files call each other")
        if not element.tag.startswith(PREFIX):
            if element.tag not in SEEN_ONLY:
                attributes = {
                    name: self.text(text, element, scope, name) for name, text in element.attributes.items()
                }
                children = list(self.all(element.children, scope, depth))
                yield replace(element, attributes=attributes, children=children)
            return
        match element.tag.removeprefix(PREFIX):
            case "property":
                self.property(element, scope)
            case "arg":
                self.arguments.setdefault(element.text("name"), element.attributes.get("default", ""))
            case "macro":
                name = element.text("name").removeprefix(PREFIX)
                self.macros[name] = _Macro(tuple(_parameters(element.attributes.get("params", ""))), element)
            case "include":
                yield from self.include(element, scope, depth)
            case "if" | "unless" as kind:
                if self.holds(element, scope) == (kind == "if"):
                    yield from self.all(element.children, scope, depth)
            case "insert_block":
                name = self.text(element.text("name"), element, scope, "name")
                if (block := scope.block(name)) is None:
                    raise element.error(f"there is no block '{name}'", attribute="name")
                yield from self.all(block, scope, depth + 1)
            case name:
                yield from self.call(name, element, scope, depth)

    def property(self, element: Element, scope: Scope) -> None:
        name = element.text("name")
        kept = {"parent": scope.outer or scope, "global": scope.top}.get(
            element.attributes.get("scope", ""), scope
        )
        if element.children:
            kept.blocks[name] = element.children
            return
        default = element.attributes.get("default")
        if "value" not in element.attributes and default is not None and scope.holder(name):
            return
        kept.values[name] = element.attributes.get("value", default or "")
        kept.raw[name] = element

    def include(self, element: Element, scope: Scope, depth: int) -> Iterator[Element]:
        typed = element.text("filename")
        path = self.found(typed, element, scope)
        if path is None:
            self.doubts.append(
                element.fault(
                    f"there is no file {typed}",
                    "it is left out; a package stands elsewhere: --package NAME=DIR",
                    "filename",
                )
            )
            return
        yield from self.all(self.read(path).children, scope, depth + 1)

    def found(self, typed: str, element: Element, scope: Scope) -> Path | None:
        """A file by its path, or in a package: $(find NAME)/path."""
        in_package = PACKAGE.fullmatch(typed)
        package, path = in_package.groups() if in_package else ("", typed)
        name = self.text(path, element, scope, "filename")
        return self.library.file(element.file.path.parent, name, package)

    def call(self, name: str, element: Element, scope: Scope, depth: int) -> Iterator[Element]:
        if (macro := self.macros.get(name)) is None:
            hint = did_you_mean(name, tuple(self.macros), "there are") if self.macros else ""
            raise element.error(f"there is no macro '{name}'", hint)
        inner = Scope(scope.top)
        blocks = list(element.children)
        given = {key: self.value(text, element, scope, key) for key, text in element.attributes.items()}
        for parameter in macro.parameters:
            own, _, default = parameter.partition(":=")
            if own.startswith("*"):
                if not blocks:
                    raise element.error(f"macro '{name}' wants a block '{own.strip('*')}'")
                block = blocks.pop(0)
                inner.blocks[own.strip("*")] = self.block(block, own, scope, depth)
            elif own in given:
                inner.values[own] = given.pop(own)
            elif ":=" in parameter:
                self.default(own, default, inner, scope, macro.element)
            else:
                raise element.error(f"macro '{name}' wants '{own}'")
        if given:
            raise element.error(f"macro '{name}' has no parameter '{next(iter(given))}'")
        yield from self.all(macro.element.children, inner, depth + 1)

    def block(self, block: Element, own: str, scope: Scope, depth: int) -> list[Element]:
        """A block as it is where the macro is called: the element, or what stands in it."""
        return list(self.all(block.children if own.startswith("**") else [block], scope, depth + 1))

    def default(self, own: str, default: str, inner: Scope, scope: Scope, macro: Element) -> None:
        if default.startswith("^"):
            if scope.holder(own):
                inner.values[own] = self.lookup(own, macro, scope)
                return
            default = default.removeprefix("^").removeprefix("|")
        inner.values[own] = self.value(default.strip("'\""), macro, scope, "params")

    def holds(self, element: Element, scope: Scope) -> bool:
        found = self.value(element.text("value"), element, scope, "value")
        if isinstance(found, str):
            raise element.error(f"'{found[:40]}' is neither true nor false", attribute="value")
        return bool(found)

    def text(self, typed: str, element: Element, scope: Scope, attribute: str) -> str:
        """An attribute with what stands in ${...} and $(...) put in."""
        return "".join(map(_written, self.parts(typed, element, scope, attribute)))

    def value(self, typed: str, element: Element, scope: Scope, attribute: str) -> Given:
        """The same as a number or a truth where it is one."""
        parts = list(self.parts(typed, element, scope, attribute))
        if len(parts) == 1 and not isinstance(parts[0], str):
            return parts[0]
        return said("".join(map(_written, parts)))

    def parts(self, typed: str, element: Element, scope: Scope, attribute: str) -> Iterator[Given]:
        end = 0
        for found in BRACED.finditer(typed):
            if found.start() > end:
                yield typed[end : found.start()]
            end = found.end()
            try:
                yield self.braced(found[1], found[2], element, scope)
            except NoValue as error:
                raise element.error(str(error), attribute=attribute) from error
        if end < len(typed):
            yield typed[end:]

    def braced(self, expression: str | None, command: str | None, element: Element, scope: Scope) -> Given:
        if expression is not None:
            return value(expression, lambda name: self.lookup(name, element, scope))
        name, _, rest = (command or "").strip().partition(" ")
        if name == "eval":
            return value(rest, lambda each: self.lookup(each, element, scope))
        if name != "arg":
            raise NoValue(f"$({command}) is known to ROS alone")
        if rest.strip() not in self.arguments:
            raise NoValue(f"there is no argument '{rest.strip()}'")
        return self.value(self.arguments[rest.strip()], element, scope, "")

    def lookup(self, name: str, element: Element, scope: Scope) -> Given:
        """The value of a property; worked out when it is wanted. Raises NoValue."""
        holder = scope.holder(name)
        if holder is None:
            if name in self.arguments:
                return said(self.arguments[name])
            raise NoValue(f"'{name}' is not defined")
        found = holder.values[name]
        if name not in holder.raw or not isinstance(found, str):
            return found
        if name in self.working:
            raise NoValue(f"the value of '{name}' leads back to itself")
        self.working.append(name)
        try:
            worked = self.value(found, holder.raw[name], holder, "value")
        finally:
            self.working.pop()
        holder.values[name] = worked
        holder.raw.pop(name, None)
        return worked


def _parameters(text: str) -> list[str]:
    """Words; a default may hold blanks in quotes or braces."""
    return [
        found[0].replace(" := ", ":=")
        for found in re.finditer(r"(?:'[^']*'|\"[^\"]*\"|\$\{[^}]*\}|\S)+", text)
    ]


def _written(each: Given) -> str:
    if isinstance(each, bool):
        return str(each)
    return each if isinstance(each, str) else plain(each)
