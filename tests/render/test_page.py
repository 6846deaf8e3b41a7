from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from shutil import which
from time import perf_counter
from zipfile import ZipFile

import pytest
import sympy

from derive.render.document import Document
from derive.render.docx import write_docx
from derive.render.failures import PdfFailed
from derive.render.figures import draw
from derive.render.json_result import render_json
from derive.render.page import render_latex, render_markdown
from derive.render.pdf import typesetting, write_pdf_with_latex
from derive.render.web import write_html
from tests.render import sample

pytestmark = pytest.mark.usefixtures("sample_words")


def test_markdown_keeps_the_rules_of_github_and_pandoc() -> None:
    page = render_markdown(sample.sheet())
    prose = re.sub(r"\$\$.*?\$\$", "", page, flags=re.DOTALL).replace(r"\$", "")
    assert all(formula == formula.strip() for formula in re.findall(r"\$([^$]*)\$", prose))
    for display in re.findall(r"\$\$(.*?)\$\$", page, flags=re.DOTALL):
        assert display.startswith("\n") and display.endswith("\n")
        assert not re.search(r"^\s*([-+=]\s|$)", display.strip("\n"), flags=re.MULTILINE)
    assert not re.search(r"\\!|\\left\.|\\hline", page)


def test_the_page_has_its_parts() -> None:
    page = render_markdown(sample.sheet())
    parts = ("# Solutions & more", "Robotics · A. Teacher", "## Problem 1: Two links",
             "### Question 1 (10 marks)",
             "*Hint*: Use *both*", "#### Solution", "At $\\theta_1 = 30^\\circ$, $a_1 = 0.5$:",
             "Verified by computer: the results agree with a second method.")  # fmt: skip
    assert [part for part in parts if part not in page] == []
    assert "\n\n\n" not in page


def test_a_problem_sheet_has_no_solutions() -> None:
    problem = sample.sheet().problems[0]
    assert problem.questions[0].order
    page = render_markdown(replace(sample.sheet(), solutions=False))
    assert "Solution\n" not in page and "Verified" not in page and "Use *both*" in page


def test_a_lone_question_has_no_heading() -> None:
    problem = sample.sheet().problems[0]
    alone = type(problem)(1, problem.questions[:1])
    page = render_markdown(Document("One", (alone,)))
    assert "Question" not in page and "## Problem 1 (10 marks)" in page


def test_json_has_the_shapes_of_the_contract() -> None:
    question = json.loads(render_json(sample.sheet()))["problems"][0]["questions"][0]
    results = question["results"]
    assert results["T_2^0"][0][3] == "a1*cos(theta1) + a2*cos(theta1 + theta2)"
    assert results["o"] == ["a1", "7/20", "pi/6"]
    assert results["solutions"] == [{"theta2": "-theta", "when": "elbow up"}]
    assert question["evaluated"]["T_2^0"][0][1] == -0.8660254037844386
    law = {"claim": "R^T R = 1", "by": "normal form", "holds": True, "tried": 1, "truth": "law"}
    assert question["checks"][0] == law
    sympy.sympify(results["T_2^0"][1][3])


def test_pages_are_rendered_fast() -> None:
    render_markdown(sample.sheet())
    started = perf_counter()
    render_markdown(sample.sheet())
    render_latex(sample.sheet())
    assert perf_counter() - started < 0.25  # 0.03 s on an idle machine


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for path, plot in sample.sheet().plots().items():
        draw(plot, tmp_path / path)
    return tmp_path


def test_pdf_is_the_same_each_time(folder: Path) -> None:
    made = []
    for _ in range(2):
        with typesetting(sample.sheet(), folder) as pdf:
            made.append(pdf.result())
    assert made[0].startswith(b"%PDF") and made[0] == made[1]


def test_text_the_fonts_lack_is_an_error(folder: Path) -> None:
    with typesetting(replace(sample.sheet(), author="見"), folder) as pdf, pytest.raises(PdfFailed):
        pdf.result()


def test_html_and_docx(folder: Path) -> None:
    write_html(replace(sample.sheet(), author='"><script>'), folder / "page.html")
    page = (folder / "page.html").read_text()
    assert "<math" in page and "<script" not in page and 'src="sample' not in page
    write_docx(sample.sheet(), folder / "page.docx")
    with ZipFile(folder / "page.docx") as archive:
        made = archive.read("word/document.xml").decode()
    for table in re.findall(r'<w:tbl><w:tblPr><w:tblStyle w:val="Table" />.*?</w:tbl>', made, re.DOTALL):
        *kept, last = table.split("</w:tr>")[:-1]
        assert all("<w:keepNext/>" in row for row in kept) and "<w:keepNext/>" not in last


def test_figures_are_the_same_each_time(tmp_path: Path) -> None:
    plot = sample.arm().plots[0]
    first = [path.read_bytes() for path in draw(plot, tmp_path / "a" / "step")]
    second = [path.read_bytes() for path in draw(plot, tmp_path / "b" / "step")]
    assert first == second
    assert b"<text" not in first[0]


@pytest.mark.skipif(which("pdflatex") is None, reason="needs a TeX installation")
def test_latex_compiles(folder: Path) -> None:
    (folder / "page.tex").write_text(render_latex(sample.sheet()))
    write_pdf_with_latex(folder / "page.tex", folder / "page.pdf")
    assert (folder / "page.pdf").read_bytes().startswith(b"%PDF")
