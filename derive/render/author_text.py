"""The author's own text: Markdown with `$...$`, brought into a format with nothing else let through.

A formula of several rows has no room in a line of text and is displayed. Raw HTML and TeX outside formulas
come out as the characters they are. What stands between dollars is passed on as it is: the sheet's reader
admits only mathematics there.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from derive.render.author_writers import HtmlWriter, LatexWriter, MarkdownWriter, TypstWriter, Writer
from derive.render.plain_text import html_text, latex_text, markdown_formula, markdown_text, typst_text

IN_ROWS = re.compile(r" *(?<![\\$])\$([^$]+\\\\[^$]+)\$(?!\$)([.,;:]?) *")  # and the sign after it
FORMULA = re.compile(r"(?<!\\)\$([^$\n]+(?:\n[^$\n]+)*)\$")
BEFORE_UNIT = re.compile(
    r"(?<=\d) (?=(?:rad|deg|mm|cm|kg|Nm|Hz|[mNsVWJ])(?![A-Za-z]))|(?<=\d N) (?=m(?![A-Za-z]))"
)
WITH_UNIT = re.compile(r"[\d.,]*\d(?:\xa0[A-Za-z]+)+")
MARKUP = re.compile(r"[\\`*_\[\]<>#$&~|]|^\s*(?:[-+=>]|\d+[.)])|^(?: {4}|\t)| {2}$", re.MULTILINE)


def markdown_prose(text: str) -> str:
    """An author's text as Markdown that means the same to every reader of Markdown."""
    text = _with_rows_displayed(_with_units_held(text))
    return _plain(text, markdown_text, markdown_formula) or _blocks(text, MarkdownWriter())


def latex_prose(text: str) -> str:
    """An author's text as LaTeX."""
    text = _with_rows_displayed(_with_units_held(text))
    return _plain(text, latex_text, str.strip) or _blocks(text, LatexWriter())


def typst_prose(text: str) -> str:
    """An author's text as Typst, its formulas still in TeX."""
    text = _with_rows_displayed(_with_units_held(text))
    return _plain(text, typst_text, TypstWriter().formula) or _blocks(text, TypstWriter())


def html_prose(text: str) -> str:
    """An author's text as HTML, its formulas still in TeX."""
    text = _with_rows_displayed(_with_units_held(text))
    written = _plain(text, html_text, HtmlWriter().formula) or _blocks(text, HtmlWriter())
    return WITH_UNIT.sub(_held, written)


def _held(found: re.Match[str]) -> str:
    """A number with its unit, without the blank that is wide in some fonts."""
    return f'<span class="held">{found[0]}</span>'.replace("\xa0", " ")


def _with_units_held(text: str) -> str:
    """A text in which no line ends between a number and its unit."""
    if "`" in text:
        return text  # a program's text stays what it is
    pieces = re.split(r"((?<!\\)\$[^$]*\$)", text)
    return "".join(
        piece if place % 2 else BEFORE_UNIT.sub("\xa0", piece) for place, piece in enumerate(pieces)
    )


def _with_rows_displayed(text: str) -> str:
    return IN_ROWS.sub(r"$$\1\2$$", text)


def _plain(text: str, escape: Callable[[str], str], formula: Callable[[str], str]) -> str:
    """Text that is nothing but paragraphs and formulas, or "" where there is more to it."""
    pieces = FORMULA.split(text.strip())
    if any(map(MARKUP.search, pieces[::2])):
        return ""
    written = "".join(
        f"${formula(piece)}$" if place % 2 else escape(piece) for place, piece in enumerate(pieces)
    )
    kept = "".join(written.split())
    if lost := [piece for piece in pieces[1::2] if f"${''.join(piece.split())}$" not in kept]:
        raise ValueError(f"a text has lost a formula: {lost[0]}")
    return written


def _blocks(text: str, writer: Writer) -> str:
    from markdown_it import MarkdownIt
    from markdown_it.tree import SyntaxTreeNode
    from mdit_py_plugins.dollarmath import dollarmath_plugin

    reader = MarkdownIt("commonmark", {"html": False})
    reader.disable(["html_block", "html_inline", "reference"])
    reader.use(dollarmath_plugin, allow_labels=False, double_inline=True)
    tree = SyntaxTreeNode(reader.parse(text))
    left = sum(node.content.count("$") for node in tree.walk() if node.type == "text")
    if left > text.count("\\$") + 1:  # "5 $" is no formula
        raise ValueError("a text has lost a formula: a dollar is left over")
    return writer.blocks(tree)
