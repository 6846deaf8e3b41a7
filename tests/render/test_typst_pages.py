"""Where pages end in a PDF: not in a boxed answer, nor between a question and its figures."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from typst import compile as compiled

from derive.render.layout import Display
from derive.render.skin import templates
from derive.render.typst_skin import FORMULAS, TYPST, laid_out
from tests.render.test_typst_displays import INPUTS
from tests.sheets import pages

MARKS = re.compile(r"^[#* ]*(Question \d+$|Problem \d+(?=:)|Figure \d+(?=:))", re.MULTILINE)


def text_of(pdf: Path) -> list[str]:
    """That of each page."""
    done = subprocess.run(["pdftotext", "-layout", pdf, "-"], capture_output=True, text=True)
    return done.stdout.split("\f")


def test_a_boxed_answer_stays_on_one_page(tmp_path: Path) -> None:
    """Wherever on a page it is told."""
    answer = FORMULAS.display(Display(tuple(f"q_{{{i}}} &= 1" for i in range(25)), boxed=True))
    furniture = (templates() / "typst" / "furniture.typ").read_text(encoding="utf-8")
    for before in (20, 30, 40):
        shown = laid_out("text\n\n" * before + TYPST.numbered(answer, 1) + "\n\n")
        source = f"#let solved = true\n{furniture}\n{shown}"
        compiled(source.encode(), output=str(tmp_path / "page.pdf"), sys_inputs=INPUTS)
        assert sorted(page.count("= 1") for page in text_of(tmp_path / "page.pdf"))[-1] == 25


def test_figures_stand_before_the_next_question(tmp_path: Path) -> None:
    """In a PDF as in Markdown, though they move to where they fit."""
    pages(Path("exercises/planar-2r.yaml"), tmp_path, "md", "pdf")
    written = (tmp_path / "planar-2r.md").read_text(encoding="utf-8")
    told = MARKS.findall(written)
    assert len([mark for mark in told if mark.startswith("Figure")]) > 5
    assert MARKS.findall("\n".join(text_of(tmp_path / "planar-2r.pdf"))) == told
