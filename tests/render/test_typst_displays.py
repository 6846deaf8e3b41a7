"""A display wider or higher than a page of Typst breaks or shrinks: no ink beyond the text."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from typst import compile as compiled

from derive.render.layout import Display
from derive.render.skin import templates
from derive.render.typst_skin import FORMULAS, laid_out

INPUTS = {"title": "", "author": "", "course": "", "lang": "en", "byline": ""}
LEFT, RIGHT, TOP, BOTTOM = (25 / 25.4 * 72, (210 - 25) / 25.4 * 72, 27 / 25.4 * 72, (297 - 28) / 25.4 * 72)
SUM = " + ".join(f"a_{{{i}}} b_{{{i}}}" for i in range(20))


def column(rows: int, entry: str = "x") -> str:
    return r"\begin{bmatrix} " + r" \\ ".join([entry] * rows) + r" \end{bmatrix}"


DISPLAYS = {
    "wide and high": Display(tuple(f"J_{i} &= {column(6, SUM)}" for i in range(9)), wide=True),
    "a column higher than the page": Display((f"q = {column(70)}",)),
    "wide matrices below each other": Display((rf"q &= {column(40, SUM)}", r"p &= 0"), wide=True, boxed=True),
    "wider than twice the line": Display((f"q = {SUM} + {SUM}",), wide=True),
    "many lines": Display(tuple(f"q_{i} &= 1" for i in range(80)), boxed=True),
}


@pytest.mark.parametrize("name", DISPLAYS)
def test_no_display_runs_over_its_page(name: str, tmp_path: Path) -> None:
    shown = laid_out(f"text\n\n{FORMULAS.display(DISPLAYS[name])}\n\ntext\n")
    furniture = templates() / "typst" / "furniture.typ"
    source = f"#let solved = true\n{furniture.read_text(encoding='utf-8')}\n{shown}"
    compiled(source.encode(), output=str(tmp_path / "page.pdf"), sys_inputs=INPUTS)
    done = subprocess.run(["pdftotext", "-bbox", tmp_path / "page.pdf", "-"], capture_output=True, text=True)
    boxes = re.findall(r'xMin="(.*?)" yMin="(.*?)" xMax="(.*?)" yMax="(.*?)">([^<]+)<', done.stdout)
    words = [tuple(map(float, box[:4])) for box in boxes if not re.fullmatch(r"\d+|/", box[4])]
    assert words and not [
        word
        for word in words
        if word[0] < LEFT - 1 or word[1] < TOP - 8 or word[2] > RIGHT + 1 or word[3] > BOTTOM
    ]


def test_one_equation_keeps_its_lines_together() -> None:
    """Several equations may break between them."""
    lines = f"J &= {column(2)}", f"&= {column(6)}"
    assert "#eq(" in FORMULAS.display(Display(lines))
    assert "#tall(" in FORMULAS.display(Display((lines[0], f"K {lines[1]}")))
    assert "#tall(" in FORMULAS.display(Display((*lines, *lines[1:])))
