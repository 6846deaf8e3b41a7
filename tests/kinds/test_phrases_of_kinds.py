"""What kinds say in words, without running them: every key has its words and every word its key, and no
sentence stands below `render`."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from derive.render.phrases import lines_of, shared_lines
from derive.render.skin import templates

WORDS = templates() / "words"
DERIVE = Path(__file__).parents[2] / "derive"
FOLDERS = sorted(path.name for path in WORDS.iterdir() if path.is_dir())
BELOW = [DERIVE / folder for folder in ("kinds", "mechanics", "control", "algebra", "figures")]
PRINTED = {"Branch", "Table", "Plot", "Step", "Caption", "Derivation"}  # beside facts and what is said
SENTENCE = re.compile(r"[A-Za-z]{2,} [a-z]{2,}")
SAYING = ("Phrase", "Claim", "law", "agreement", "agrees", "within")  # their first argument is a key


def lines(folder: str) -> set[str]:
    kinds = [path.stem for path in (WORDS / folder).glob("[!_]*.j2")]
    return {key for kind in kinds for key in lines_of(folder, kind)}


def trees(*folders: Path) -> Iterator[ast.Module]:
    for folder in folders:
        for path in sorted(folder.rglob("*.py")):
            yield ast.parse(path.read_text(encoding="utf-8"), str(path))


def keys(tree: ast.Module) -> Iterator[str]:
    """The keys of phrases that stand in the code as texts."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and node.args and _called(node) in SAYING:
            yield from _texts(node.args[0])


def _called(node: ast.Call) -> str:
    return node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")


def _texts(node: ast.expr) -> Iterator[str]:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from (*_texts(node.body), *_texts(node.orelse))


@pytest.mark.parametrize("folder", FOLDERS)
def test_every_key_has_its_words(folder: str) -> None:
    said = {key for tree in trees(DERIVE / "kinds" / folder) for key in keys(tree)}
    assert said - lines(folder) == set()


def test_every_line_is_said_by_something() -> None:
    texts = {
        node.value
        for tree in trees(DERIVE)
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    assert {key for folder in FOLDERS for key in lines(folder)} - texts == set()
    assert shared_lines().keys() <= texts


def test_no_sentence_is_printed_that_stands_in_the_code() -> None:
    sentences = [
        part.value
        for tree in trees(*BELOW)
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and (_called(node) in {*PRINTED, *SAYING} or _called(node).endswith(("Facts", "Told")))
        for part in ast.walk(node)
        if isinstance(part, ast.Constant) and isinstance(part.value, str) and SENTENCE.search(part.value)
    ]
    assert sentences == []
