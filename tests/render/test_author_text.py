from __future__ import annotations

import subprocess
import sys

import pytest

from derive.render.author_text import html_prose, latex_prose, markdown_prose


@pytest.mark.parametrize(
    ("text", "markdown", "latex"),
    [
        ("Given $ d_2 = 0.1 $ m, find it.", "Given $d_2 = 0.1$ m, find it.", "Given $d_2 = 0.1$ m, find it."),
        ("Use *both* and **all**.", "Use *both* and **all**.", r"Use \emph{both} and \textbf{all}."),
        ("50% at θ = 30°", "50% at θ = 30°", r"50\% at $\theta$ = 30$^\circ$"),
        ("a_b & c#d", r"a\_b & c\#d".replace(r"\#", "#"), r"a\_b \& c\#d"),
        ("- one\n- two", "- one\n- two", "\\begin{itemize}\\tight\n\\item one\n\\item two\n\\end{itemize}"),
        ("See [here](https://x.org/a#b).", "See [here](<https://x.org/a#b>).",
         r"See \href{https://x.org/a\#b}{here}."),
        ("The $z$-axis, *not* - the\n\\- x.", "The $z$-axis, *not* - the\n\\- x.",
         "The $z$-axis, \\emph{not} - the\n- x."),
        ("1\\. no list", "1\\. no list", "1. no list"),
        ("$$\nx = 1\n$$", "$$\nx = 1\n$$", "\\[\nx = 1\n\\]"),
    ],
)  # fmt: skip
def test_an_authors_markdown_in_both_formats(text: str, markdown: str, latex: str) -> None:
    assert markdown_prose(text).strip() == markdown
    assert latex_prose(text).strip() == latex


ATTACKS = [
    r"\input{/etc/passwd}",
    r"\write18{ls} and {braces}",
    "<script>alert(1)</script>",
    "`` `=html` ``{=html}",
    "```{=latex}\n\\input{x}\n```",
    "[x](javascript:alert(1))",
    "![x](/etc/passwd)",
    r"\![x](https://x.org/a.png)",
    "&lt;script&gt;",
    "$a<script>alert(1)</script>b$",
    r"*so* $\text{<img src=x onerror=alert(1)>}$",
    "$$\na<!-- b\n$$",
    "$[x](javascript:alert(1))$ and *$[x](javascript:alert(1))$*",
    "{{ 7 * 7 }}{% raw %}",
    "#set page(width: 1cm)",
    "cost $5 and $6",
    "1. \\def\\x{}",
]


@pytest.mark.parametrize("text", ATTACKS)
def test_nothing_but_text_comes_through(text: str) -> None:
    latex = latex_prose(text)
    for command in (r"\input", r"\write", r"\def", "{{", "{%"):
        assert command not in latex
    markdown = markdown_prose(text)
    for tag in ("<script", "</script", "<img", "<!--"):
        assert tag not in markdown.replace(f"\\{tag}", "")
    live = markdown.replace(r"\[", "").replace(r"\]", "").replace(r"\!", "")
    assert "](javascript" not in live and "![" not in live


def test_plain_text_needs_no_reader_of_markdown() -> None:
    code = (
        "import sys; from derive.render.author_text import markdown_prose;"
        "markdown_prose('Find $x_1$ (in m), please.'); sys.exit('markdown_it' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_no_line_ends_between_a_number_and_its_unit() -> None:
    assert markdown_prose("20 N m at 3 kg, 2 motors, $2 m$") == "20\xa0N\xa0m at 3\xa0kg, 2 motors, $2 m$"
    assert latex_prose("20 N m") == "20~N~m"
    assert html_prose("in 0.5 s") == 'in <span class="held">0.5 s</span>'
    assert markdown_prose("see `2 m` of 2 m").count("\xa0") == 0


def test_a_lone_dollar_is_a_dollar() -> None:
    assert markdown_prose("5 $ and *more*") == r"5 \$ and *more*"
