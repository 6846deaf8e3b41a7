"""The words of a kind read what the kind declares in its `Facts`, no more and no less."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from importlib import import_module

import pytest
from jinja2 import nodes

from derive.derivation import PageFacts
from derive.render.skin import environment, templates
from derive.render.words import QUESTION

WORDS = templates() / "words"
KINDS = sorted(f"{path.parent.name}/{path.stem}" for path in WORDS.glob("*/[!_]*.j2"))
SHARED = {each.name for each in fields(PageFacts)}


def _facts(kind: str) -> type[PageFacts]:
    return getattr(import_module(f"derive.kinds.{kind.replace('/', '.')}"), "Facts", PageFacts)


@pytest.mark.parametrize("kind", KINDS)
def test_declared_facts_are_those_read(kind: str):
    facts = _facts(kind)
    declared = {each.name for each in fields(facts)} - SHARED
    assert set(_read(f"words/{kind}.j2")) <= declared
    sharing = [other for other in KINDS if _facts(other) is facts]
    assert {name for other in sharing for name in _read(f"words/{other}.j2")} == declared


def _tree(template: str) -> nodes.Template:
    return environment().parse(environment().loader.get_source(environment(), template)[0])


def _read(template: str) -> Iterator[str]:
    """The names read of `facts` by the words, by what they include and by the macros they call."""
    yield from _followed(_tree(template), {"facts"}, {})


def _followed(node: nodes.Node, known: set[str], scope: dict[str, nodes.Macro]) -> Iterator[str]:
    """What a part reads of the facts, which are also called as in `known`, with its macros followed."""
    scope = {**scope, **_macros(node)}
    yield from _names(node, known)
    for each in node.find_all(nodes.Include):
        yield from _read(each.template.value)
    for call in node.find_all(nodes.Call):
        if isinstance(call.node, nodes.Name) and (macro := scope.get(call.node.name)):
            passed = zip(macro.args, call.args, strict=False)
            known_there = {to.name for to, value in passed if getattr(value, "name", "") in known}
            inner = {name: other for name, other in scope.items() if other is not macro}
            yield from _followed(macro, {"facts", *known_there}, inner)


def _macros(node: nodes.Node) -> dict[str, nodes.Macro]:
    """The macros that are defined or imported there, with those of the files imported from."""
    found = {macro.name: macro for macro in node.find_all(nodes.Macro)}
    for each in node.find_all(nodes.FromImport):
        found |= _macros(_tree(each.template.value))
    return found


def _names(node: nodes.Node, known: set[str]) -> Iterator[str]:
    """Attributes of `facts`, also under another name that the words set it to; not those of a question."""
    for part in node.iter_child_nodes():
        match part:
            case nodes.Block(name=str(name)) if name == QUESTION:
                continue
            case nodes.Macro():
                continue
            case nodes.Assign(target=nodes.Name(name=str(name)), node=nodes.Name(name=str(value))):
                known |= {name} if value in known else set()
            case nodes.Getattr(node=nodes.Name(name=str(name)), attr=attr) if name in known:
                yield attr
        yield from _names(part, known)
