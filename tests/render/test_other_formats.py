"""Every node of a tree in every shape as HTML, Word and Typst have it, read as LaTeX is."""

from __future__ import annotations

from functools import cache
from html import unescape
from xml.etree.ElementTree import fromstring

from fontTools.ttLib import TTFont

from derive.algebra.fingerprint import fingerprint
from derive.answers.latex.printed import parts_of, read_part
from derive.errors import FormulaError, Unfit
from derive.expression import Expr
from derive.render.formula.mathml import TAG, math
from derive.render.formula.omml import omml
from derive.render.formula.tex import boxes
from derive.render.formula.typst import in_text
from derive.render.formula.typst import typst as spelt
from derive.render.latex import latex
from derive.render.notation import Notation
from derive.render.word_tree import in_word as in_word_blocks
from tests.render import mathml, typst
from tests.render import omml as word
from tests.render.make_font import FONT, letters
from tests.render.shapes import nested


@cache
def trees() -> tuple[tuple[str, Expr], ...]:
    return tuple(nested())


def wrong(read: list[str]) -> list[tuple[str, str]]:
    """Those that do not say what their trees do, as LaTeX."""
    assert len(read) == len(trees())
    found = []
    for (name, tree), written in zip(trees(), read, strict=True):
        try:
            ((_, part),) = parts_of([written])[0]
            if fingerprint(read_part(part, tree, False), 3) != fingerprint(tree, 3):
                found.append((name, written))
        except Unfit:
            continue
        except FormulaError as error:
            found.append((name, f"{written}: {error}"))
    return found


@cache
def in_mathml() -> tuple[str, ...]:
    """All of them as MathML, read as LaTeX."""
    made = (math(boxes(latex(tree, Notation()))) for _, tree in trees())
    return tuple(mathml.latex_of(fromstring(each)) for each in made)


def test_mathml_says_what_the_trees_do() -> None:
    assert wrong([*in_mathml()]) == []


def test_the_font_has_every_sign_of_mathml() -> None:
    shown = {
        char for each in trees() for char in unescape(TAG.sub("", math(boxes(latex(each[1], Notation())))))
    }
    assert letters() | shown | {"√"} <= {*map(chr, TTFont(FONT).getBestCmap())}


@cache
def in_word() -> tuple[str, ...]:
    """All of them as equations of Word."""
    return tuple(omml(boxes(latex(tree, Notation()))) for _, tree in trees())


def test_word_says_what_the_trees_do() -> None:
    assert wrong([word.latex_of(word.element(each)) for each in in_word()]) == []


def test_libreoffice_finds_something_beside_every_sign_of_a_docx() -> None:
    assert [
        name for name, each in zip(trees(), in_word(), strict=True) if word.torn(word.element(each))
    ] == []
    assert word.torn(word.element("<m:r><m:t>=</m:t></m:r><m:r><m:t>a</m:t></m:r>")) == ["="]


@cache
def in_typst() -> tuple[str, ...]:
    """All of them as Typst understands what we write."""
    return tuple(typst.read([spelt(boxes(latex(tree, Notation()))) for _, tree in trees()]))


def test_typst_says_what_the_trees_do() -> None:
    assert wrong([*in_typst()]) == []
    assert in_typst() == tuple(typst.read([in_text(boxes(latex(tree, Notation()))) for _, tree in trees()]))


def test_a_mistake_of_either_is_seen() -> None:
    for right, mistaken in (
        (" - ", " + "),
        ("cos", "sin"),
        (r"\sqrt", ""),
        ("^{2}", "^{3}"),
        (" & ", r" \\ "),
    ):
        in_docx = (word.latex_of(word.element(each)) for each in in_word())
        for made in (in_typst(), in_mathml(), tuple(in_docx)):
            assert wrong([written.replace(right, mistaken) for written in made])


def test_what_stands_side_by_side_in_word_stands_below_where_it_is_too_wide() -> None:
    def paragraphs(tex: str) -> int:
        math = {"t": "Math", "c": [{"t": "DisplayMath"}, tex]}
        (block,) = in_word_blocks([{"t": "Para", "c": [math]}])
        return str(block["c"][1]).count("<m:oMathPara>")

    wide = " + ".join(["a b c"] * 8)
    assert paragraphs(r"x = 1 \qquad y = 2") == 1
    assert paragraphs(rf"x = {wide} \qquad y = {wide}") == 2
