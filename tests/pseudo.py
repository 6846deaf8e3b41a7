"""A language that no one speaks: the letters of all that the templates say are written ａ instead of a.

What stays in plain letters on a page made so was said by no template.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

from jinja2 import nodes
from jinja2.visitor import NodeTransformer

from derive.render.phrases import PHRASES
from derive.render.skin import environment

LETTERS = str.maketrans({chr(k): chr(k + 0xFEE0) for k in (*range(65, 91), *range(97, 123))})
FIELD = re.compile(r"(\{[^{}]*\})")
SAYING = {"em": 0, "strong": 0, "items": 0, "append": 0, "plot": 1, "count": 1}  # arguments that are names
SAID_BESIDE = ("entries", "caption")  # of a display, of a picture
JOINING = ("join", "listed", "default", "replace")
MATHEMATICS = ("m", "each")  # filters that print mathematics: ("x_" ~ k) | m
UNSAID = (nodes.Compare, nodes.Test, nodes.Getattr, nodes.Import, nodes.FromImport, nodes.Include)


def translated(text: str, mathematics: bool = False) -> str:
    """The text in that language, but for what stands between dollars; it may begin within `mathematics`."""
    parts = text.split("$")
    return "$".join(part if k % 2 != mathematics else part.translate(LETTERS) for k, part in enumerate(parts))


@contextmanager
def pseudo_language() -> Iterator[None]:
    """The templates of words speak that language."""
    here = environment()
    parse, cache, compiled = here._parse, here.cache, here.bytecode_cache

    def parsed(source: str, name: str | None, filename: str | None) -> nodes.Template:
        tree = parse(source, name, filename)
        return _Translation().visit(tree) if name and name.startswith("words/") else tree

    here._parse, here.cache, here.bytecode_cache = parsed, {}, None
    try:
        yield
    finally:
        here._parse, here.cache, here.bytecode_cache = parse, cache, compiled


class _Translation(NodeTransformer):
    """Translates what is printed and leaves what is compared or names something."""

    def __init__(self) -> None:
        self.mathematics = False  # whether the text before ended between dollars

    def visit(self, node: nodes.Node, *_: object, **__: object) -> nodes.Node:
        match node:
            case nodes.TemplateData():
                before, self.mathematics = self.mathematics, self.mathematics ^ _opens(node.data)
                node.data = translated(node.data, before)
            case nodes.Block(name="example" | "results"):  # printed on no page
                return node
            case nodes.Const():
                if isinstance(node.value, str):
                    node.value = translated(node.value, self.mathematics)
            case nodes.Concat():
                self._concat(node)
            case nodes.Block(name=name) if name == PHRASES:
                for data in node.find_all(nodes.TemplateData):
                    data.data = "".join(map(_phrase, data.data.splitlines(keepends=True)))
            case nodes.Call():
                names = SAYING.get(getattr(node.node, "name", getattr(node.node, "attr", "")), len(node.args))
                node.args = [*node.args[:names], *map(self.visit, node.args[names:])]
                for each in node.kwargs:
                    each.value = self.visit(each.value) if each.key in SAID_BESIDE else each.value
            case nodes.Filter(name=name) if name in MATHEMATICS:
                return node
            case nodes.Filter():
                node.node = self.visit(node.node) if node.node else None
                node.args = [self.visit(each) for each in node.args] if node.name in JOINING else node.args
            case nodes.Pair():
                node.value = self.visit(node.value)
            case nodes.Getitem():
                node.node = self.visit(node.node)
            case _ if not isinstance(node, UNSAID):
                self.generic_visit(node)
        return node

    def _concat(self, node: nodes.Concat) -> None:
        """`"$x_" ~ k ~ "$ meets"`."""
        inside = self.mathematics
        for part in node.nodes:
            if isinstance(part, nodes.Const) and isinstance(part.value, str):
                opens = _opens(part.value)
                part.value, inside = translated(part.value, inside), inside ^ opens
            else:
                self.visit(part)


def _opens(text: str) -> bool:
    return text.count("$") % 2 == 1


def _phrase(line: str) -> str:
    key, colon, words = line.partition(": ")
    parts = FIELD.split(words)
    return key + colon + "".join(part if k % 2 else translated(part) for k, part in enumerate(parts))
