from __future__ import annotations

import pytest

from derive.errors import FormulaError
from derive.sheet.tex import check_text


@pytest.mark.parametrize(
    "text",
    [
        "Given the arm with $d_2 = 0.1$ m, answer.",
        r"$T_6^0 = \begin{bmatrix} \cos\theta & -s_{12} \\ 0 & 1 \end{bmatrix}$",
        r"A price of 3 \$, **bold**, a < b, `code`, and a [link](https://example.org).",
        r"$\left\{ \frac{1}{2} \right\}$ and $50\,\%$",
    ],
)
def test_allowed(text: str) -> None:
    assert check_text(text) == text


@pytest.mark.parametrize(
    "mathematics",
    [
        r"\input{/etc/passwd}", r"\write18{ls}", r"\def\x{y}", r"\csname input\endcsname", r"\catcode`\@=11",
        r"\href{javascript:x}{y}", r"\include{x}", r"\openin5=x", r"\immediate\write18{x}", "^^5cinput{x}",
        r"\begin{document}", r"\newcommand{\x}{y}", r"\let\x=\input", "x} y {", "{x", "x % y", r"\loop",
        r"\expandafter\x", r"\special{x}", r"\usepackage{x}", r"\directlua{x}", r"\verb|x|",
    ],
)  # fmt: skip
def test_refused_in_mathematics(mathematics: str) -> None:
    with pytest.raises(FormulaError):
        check_text(f"Given ${mathematics}$, answer.")


@pytest.mark.parametrize(
    "text",
    [
        "<script>alert(1)</script>", r"\input{x}", "a $ sign", "$$x$$", "[x](javascript:alert(1))",
        "<!-- x -->", r"\begin{verbatim}", "`\\input`{=latex}", "x" * 20_001,
    ],
)  # fmt: skip
def test_refused_in_prose(text: str) -> None:
    with pytest.raises(FormulaError):
        check_text(text)
