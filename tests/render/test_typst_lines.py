"""Where lines of a Typst page break: between the terms of a formula, and nowhere else in it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from typst import compile as compiled

from derive.render.formula.tex import boxes
from derive.render.formula.typst import in_text, typst
from derive.render.typst_skin import DOLLAR, laid_out

FORMULAS = (
    r"\tau = (a + b + c) (d + e + f) + g + h = k (l + m + n) - p + q",
    r"L_a \dot{I}_a = V_a - R_a I_a - \left( \frac{a}{b} + c + d + e \right) f - K_b \dot{\theta} = 1",
    r"x - y + z \leq \sqrt{a + b + c + d} + \lvert a + b - c \rvert + u",
)


def lines(formula: str, folder: Path) -> list[str]:
    """How a formula is broken in a narrow column."""
    page = (
        f"#set page(width: 45mm, height: auto, margin: 4mm)\n#set text(size: 10pt)\nwhere ${formula}$ holds"
    )
    compiled(page.encode(), output=str(folder / "line.pdf"))
    done = subprocess.run(["pdftotext", "-layout", folder / "line.pdf", "-"], capture_output=True, text=True)
    return [line.strip() for line in done.stdout.splitlines() if line.strip()]


@pytest.mark.parametrize("tex", FORMULAS)
def test_no_line_ends_with_an_equal_sign_or_in_parentheses(tex: str, tmp_path: Path) -> None:
    broken = lines(in_text(boxes(tex)), tmp_path)
    assert len(broken) > 1
    assert not torn(broken)


def test_typst_alone_would_break_there(tmp_path: Path) -> None:
    assert any(torn(lines(typst(boxes(tex)), tmp_path)) for tex in FORMULAS)


def torn(broken: list[str]) -> list[str]:
    return [line for line in broken if line.endswith(("=", "≤")) or line.count("(") != line.count(")")]


def test_no_line_ends_at_the_hyphen_behind_a_letter(tmp_path: Path) -> None:
    """Whatever stands before it: "the x-axis" is in one piece."""
    whole = set[str]()
    for place in range(24):
        page = f'{"i" * place} along the #m("x", {DOLLAR}x{DOLLAR});-axis of frame 1'
        head = "#set page(width: 40mm, height: auto, margin: 4mm)\n#let m(said, formula) = box(formula)\n"
        compiled((head + laid_out(page)).encode(), output=str(tmp_path / "line.pdf"))
        line = ["pdftotext", "-raw", tmp_path / "line.pdf", "-"]
        shown = subprocess.run(line, capture_output=True, text=True).stdout
        whole |= {part for part in shown.replace("\u2060", "").splitlines() if "axis" in part}
    assert all("𝑥-axis" in each for each in whole)
