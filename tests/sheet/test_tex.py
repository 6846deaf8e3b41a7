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
        r"$\frac12 x'^2 + \sqrt[3]{x}_1^2 + \hat\theta + 30^\circ + {}^0T_1 + x_\mathrm{max}$",
        r"$\begin{array}{cc} a & b \\ c & d \end{array}$ and $\begin{cases} a & b \\ c \end{cases}$",
        r"$\left. x \right|_0 + \big( x \big) + \sum\limits_{i=1}^n x_i + \text{if } x'' > 0$",
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
        "a & b", r"a \\ b", r"\\theta", r"\frac{1}", r"\frac{a}{b", "#1", r"\begin{matrix} a",
        r"\end{matrix}",
        r"\begin{bmatrix} 1 \end{pmatrix}", r"\begin{array} a \end{array}", "x^2^3", "x_a_b", "x^", "x_}",
        r"\hat", r"\sqrt", r"\sqrt[3", r"\hat\frac12", r"\left( a", r"a \right)", r"\left a \right)", r"\big",
        r"\text{a_b}", r"\text x", r"x \limits_a", r"\degree", "{" * 5000 + "}" * 5000,
        r"\begin{matrix} \left( a & b \right) \end{matrix}",
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
