"""Every sentence of a page comes from the templates of words: in a language that no one speaks no plain word
is left but those of the sheet.

So a page can be translated by translating the templates, and nothing below `render` speaks English.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from derive.build import derive_all
from derive.kinds import registry
from derive.render.document import Document
from derive.render.plain_text import LETTER_NAMES
from derive.render.questions import example_of
from derive.sheet.load import load_sheet
from derive.sheet.subjects.registry import subjects
from derive.writing import render
from tests.pseudo import pseudo_language, translated
from tests.sheets import NAMES, SHEETS

KINDS = [(subject, kind) for subject in subjects() for kind in registry.kinds_of(subject)]
NO_WORDS = re.compile(  # programs, mathematics, paths and titles
    r"```.*?```|\$\$.*?\$\$|\$[^$\n]*\$|\]\([^)]*\)|\S*/\S*|^#[^\n]*$", re.DOTALL | re.MULTILINE
)
WORD = re.compile(r"(?<![A-Za-z])[A-Za-z]{3,}")
MATHEMATICS = {
    *["sin", "cos", "tan", "sqrt", "exp", "log", "det", "deg", "rad", "Abs", "qdot", "dot", "ddot"],
    *LETTER_NAMES.split(),
    "ZYX",  # the axes of three angles where a sheet names no convention
}


@pytest.fixture(autouse=True)
def language() -> Iterator[None]:
    with pseudo_language():
        yield


def built(path: Path) -> Document:
    (document,) = derive_all([load_sheet(path)], True, lambda _: None, lambda _: None)
    return document


def plain(path: Path) -> list[str]:
    """The words in plain letters that are not those of the sheet, on its page and in its JSON."""
    document = built(path)
    said = [NO_WORDS.sub(" ", render(document, "md")), *_said(json.loads(render(document, "json")))]
    results = {name for _, question in document.questions() for name in question.derivation.results}
    names = (
        str(problem.subject.name) for problem in load_sheet(path).problems if problem.subject_name == "robot"
    )
    own = set(WORD.findall(" ".join((path.read_text(encoding="utf-8"), *results, *names)))) | MATHEMATICS
    return [word for text in said for word in WORD.findall(text) if word not in own]


def _said(results: Any) -> Iterator[str]:
    """What is said in words in a JSON, but for the names of steps."""
    if isinstance(results, list):
        for part in results:
            yield from _said(part)
    elif isinstance(results, dict):
        for name, part in results.items():
            if name in ("when", "claim", "by") and isinstance(part, str):
                yield "" if translated("every link") in part else part
            else:
                yield from _said(part)


@pytest.mark.parametrize(("subject", "kind"), KINDS, ids=[f"{s}-{k}" for s, k in KINDS])
def test_no_word_of_an_example_is_from_elsewhere(subject: str, kind: str, tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text(example_of(registry.module_name(subject, kind)), encoding="utf-8")
    assert plain(path) == []


@pytest.mark.parametrize("sheet", SHEETS, ids=NAMES)
def test_no_word_of_a_sheet_is_from_elsewhere(sheet: Path) -> None:
    assert plain(sheet) == []
