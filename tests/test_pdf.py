"""The PDF of every exercise, from outside: what a screen reader finds in it, and where its pages break.

Typst itself holds each to PDF/UA-1 and PDF/A-2a while it is made.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import outloud
import pdfua
import pikepdf
import pytest

from derive.build import build
from tests.sheets import NAMES, SHEETS, pages

HEADINGS = re.compile(r"/H([1-6])")
HEADING = re.compile(r"(Problem|Question) \d|Solution$")
SHORT = SHEETS[NAMES.index("week6")]


def elements(node: Any) -> Iterator[Any]:
    """The elements of a structure tree, in the order in which they are read."""
    if isinstance(node, pikepdf.Array):
        for part in node:
            yield from elements(part)
    elif isinstance(node, pikepdf.Dictionary) and ("/S" in node or "/K" in node):
        if "/S" in node:
            yield node
        yield from elements(node.get("/K"))


def pdf_of(sheet: Path, folder: Path) -> Path:
    return next(path for path in pages(sheet, folder, "pdf") if path.parent == folder)


@pytest.mark.parametrize("sheet", SHEETS, ids=NAMES)
def test_it_can_be_listened_to_and_leafed_through(sheet: Path, tmp_path: Path) -> None:
    made = pdf_of(sheet, tmp_path)
    with pikepdf.open(made) as pdf:
        require_told(pdf)
    require_whole(made)


def require_told(pdf: pikepdf.Pdf) -> None:
    """A title and a language, headings in order, and words for every formula and figure."""
    root = pdf.Root
    assert str(root.Lang) == "en"
    assert root.MarkInfo.Marked and root.ViewerPreferences.DisplayDocTitle
    with pdf.open_metadata() as about:
        assert about["dc:title"] and about["pdfuaid:part"] == "1"
    found = [(str(node.S), str(node.get("/Alt", ""))) for node in elements(root.StructTreeRoot.get("/K"))]
    told = [said for kind, said in found if kind in ("/Formula", "/Figure")]
    assert told and all(told)
    assert not [said for kind, said in found if kind == "/Formula" and re.search(r"[\\${}^]", said)]
    levels = [int(level[1]) for kind, _ in found if (level := HEADINGS.fullmatch(kind))]
    assert levels[0] == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


def require_whole(made: Path) -> None:
    """No page ends with what leads to the next."""
    done = subprocess.run(["pdftotext", "-layout", made, "-"], capture_output=True, text=True, check=True)
    for number, page in enumerate(done.stdout.split("\f")[:-1], 1):
        *_, last, foot = [line.strip() for line in page.splitlines() if line.strip()]
        assert re.fullmatch(rf"{number} ?/ ?\d+", foot)
        assert not last.endswith(":") and not HEADING.match(last)


def test_checkers_of_pdf_ua_find_no_error(tmp_path: Path) -> None:
    made = pdf_of(SHORT, tmp_path)
    assert not pdfua.validate(str(made)).findings
    found = outloud.check(str(made))
    assert found.stats["tagged"]
    assert not [finding for finding in found.findings if finding.severity != "info"]


def test_nothing_of_a_pdf_is_made_by_pandoc(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subprocess, "run", lambda *_, **__: pytest.fail("another program was started"))
    build([SHORT], ["pdf"], tmp_path)


ROOMY = """title: Room
problems:
- motion: [{rotate: z, by: alpha}, {rotate: y, by: beta}]
  questions:
"""


def test_the_room_for_an_answer_stands_behind_its_question(tmp_path: Path) -> None:
    sheet = tmp_path / "room.yaml"
    asked = "  - {find: rotation-matrix, marks: 6, evaluate: {alpha: 30 deg, beta: 60 deg}}\n"
    sheet.write_text(ROOMY + 4 * asked, encoding="utf-8")
    (made,) = build([sheet], ["pdf"], tmp_path, problems=True, space=True)
    done = subprocess.run(
        ["pdftotext", "-layout", str(made), "-"], capture_output=True, text=True, check=True
    )
    assert all(re.search(r"Question \d", page) for page in done.stdout.split("\f")[:-1])
