"""Formulas in Markdown as CommonMark leaves them: what GitHub hands to MathJax after reading the page."""

from __future__ import annotations

import html
import re

import pytest
from markdown_it import MarkdownIt

from derive.answers.latex.tokens import tokens
from derive.render.author_text import markdown_prose
from derive.render.latex import latex
from derive.render.markdown_math import left_alone
from derive.render.notation import Notation
from tests.render.shapes import nested

FORMULA = re.compile(r"(?<!\\)(\${1,2})([^$]+)\1")
CODE = re.compile(r"(`{3,}).*?\1|`[^`\n]*`", re.DOTALL)
ROW = "\\\\\n"  # at the end of a line GitHub keeps it


def as_written(page: str) -> list[str]:
    """The formulas of a page, one blank for any."""
    return [" ".join(tex.replace(ROW, "\\\n").split()) for _, tex in FORMULA.findall(CODE.sub("", page))]


def as_read(page: str) -> list[str]:
    """The formulas that are left when CommonMark, with tables, has read it."""
    made = MarkdownIt("commonmark").enable("table").render(page)
    text = re.sub(r"<(pre|code)\b.*?</\1>", "", made, flags=re.DOTALL)
    return [" ".join(html.unescape(tex).split()) for _, tex in FORMULA.findall(text)]


def signs(tex: str) -> list[str]:
    """What our own reader makes of a formula."""
    plain = re.sub(r"(\\d?dot) ?\{?(\\?[A-Za-z]+)\}?", r"\1{\2}", tex)
    return ["row" if token.kind == "row" else token.text for token in tokens(plain)]


def test_every_shape_is_left_as_it_is() -> None:
    trees = [latex(tree, Notation(trig=trig)) for _, tree in nested() for trig in ("short", "long")]
    page = left_alone("\n\n".join(f"$$\n{tex}\n$$" if r"\\" in tex else f"Is ${tex}$ it?" for tex in trees))
    assert as_read(page) == as_written(page)
    assert len(as_written(page)) == len(trees)
    written = [tex for _, tex in FORMULA.findall(page)]
    assert [*map(signs, written)] == [*map(signs, trees)]


@pytest.mark.parametrize(
    "text",
    [
        r"With $(3,\, 1,\; 0)^T$ and $\{a \mid \|a\| = 1\}$.",
        r"Both $\dot{\theta}_1$ and $\ddot{q}_{12}$, $\mathrm{Rot}_{z,\theta} \dot{x}_1$, $x_{2}$, $y_{3}$.",
        r"It is $R = \begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix}$, and so on.",
        "- first $\\dot{q}_1$\n- then $\\begin{bmatrix} 1 \\\\ 0 \\end{bmatrix}$, as $x_{1}$",
        "Typed as `$a\\,b$`, and meant as $a\\,b$.",
    ],
)
def test_an_authors_formulas_too(text: str) -> None:
    page = left_alone(markdown_prose(text))
    assert as_read(page) == as_written(page)
    assert not re.search(r"\$[^$\n]*\\[^A-Za-z\s][^$\n]*\$", CODE.sub("", page))
    assert ("`$a\\,b$`" in text) == ("`$a\\,b$`" in page)


def test_what_commonmark_would_take_is_seen() -> None:
    for tex in (r"a\,b", r"\dot{q}_1 + x_{2}", r"\begin{bmatrix} 1 \\ 0 \end{bmatrix}"):
        page = f"With ${tex}$."
        assert as_read(page) != as_written(page)
