"""The words of a kind read what the kind declares in its `Facts`, no more and no less."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from importlib import import_module

import pytest
from jinja2 import nodes

from derive.derivation import PageFacts
from derive.render.resources import templates
from derive.render.skin import environment
from derive.render.words import QUESTION

WORDS = templates() / "words"
KINDS = sorted(f"{path.parent.name}/{path.stem}" for path in WORDS.glob("*/[!_]*.j2"))
SHARED = {each.name for each in fields(PageFacts)}


def _facts(kind: str) -> type[PageFacts] | None:
    return getattr(import_module(f"derive.kinds.{kind.replace('/', '.')}"), "Facts", None)


@pytest.mark.parametrize("kind", KINDS)
def test_declared_facts_are_those_read(kind: str):
    facts = _facts(kind)
    if facts is None:
        pytest.skip("plain mappings still")
    assert issubclass(facts, PageFacts)
    declared = {each.name for each in fields(facts)} - SHARED
    assert set(_read(f"words/{kind}.j2")) <= declared
    sharing = [other for other in KINDS if _facts(other) is facts]
    assert {name for other in sharing for name in _read(f"words/{other}.j2")} == declared


def _read(template: str, *macros: str) -> Iterator[str]:
    """The names read of `facts` by the words, or by these macros of theirs, and by all they include."""
    text, _, _ = environment().loader.get_source(environment(), template)
    whole = environment().parse(text)
    called = [macro for macro in whole.find_all(nodes.Macro) if macro.name in macros]
    for part in called or [whole]:
        yield from _names(part, {"facts"})
        for other in part.find_all(nodes.Include):
            yield from _read(other.template.value)
        calls = {call.node.name for call in part.find_all(nodes.Call) if isinstance(call.node, nodes.Name)}
        for other in whole.find_all(nodes.FromImport):
            names = {name if isinstance(name, str) else name[0] for name in other.names}
            if (called and not calls & names) or not names:
                continue
            yield from _read(other.template.value, *names)
        if called and (inner := calls & {macro.name for macro in whole.find_all(nodes.Macro)} - {*macros}):
            yield from _read(template, *inner)


def _names(node: nodes.Node, known: set[str]) -> Iterator[str]:
    """Attributes of `facts`, also under another name that the words set it to; not those of a question."""
    for part in node.iter_child_nodes():
        match part:
            case nodes.Block(name=str(name)) if name == QUESTION:
                continue
            case nodes.Assign(target=nodes.Name(name=str(name)), node=nodes.Name(name=str(value))):
                known |= {name} if value in known else set()
            case nodes.Getattr(node=nodes.Name(name=str(name)), attr=attr) if name in known:
                yield attr
        yield from _names(part, known)
