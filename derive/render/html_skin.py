"""How pages look in HTML: formulas as MathML, with what a line may not tear apart held together."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from html import unescape

from derive.render.author_text import html_prose
from derive.render.formula.boxes import Box, Row, Sign
from derive.render.formula.mathml import TAG, math
from derive.render.formula.tex import boxes, boxes_of_lines
from derive.render.formulas import spelt
from derive.render.layout import Display
from derive.render.plain_text import html_text
from derive.render.skin import Skin, english
from derive.render.width import width

HELD = 12.0  # em, up to which a formula does not break in a line of text
NARROW = 11.5  # em that the narrowest screen has room for, beside a number; what is wider scrolls there
MANY, DEEPEST = 24, 9  # signs of a part that is broken again, and parentheses around such a break
BESIDE = r"\qquad"
BLOCKS = ("<h", "<div", "<aside", "<figure", "<ul", "<ol", "<pre", "<footer")  # what is no paragraph

# A formula with the signs or the unit beside it, between which no line begins or ends.
UNIT = r"(?:rad|deg|mm|cm|kg|Nm|Hz|°|[mNsVWJgK])(?![A-Za-z])[^\s<,.;:)]*"
MATH = r"<math>(?:(?!</math>).)*</math>"
GLUED = r"(?:-\w+|'s|[\w/°][^\s<,.;:)]*)?[)\]]*[.,;:?!]*"
TOGETHER = re.compile(rf"[(\[]*{MATH}(?:[ \xa0]{UNIT})?{GLUED}", re.DOTALL)
HEADING = re.compile(rf'(?<=<th scope="col">){MATH}(?=</th>)', re.DOTALL)
ALONE = re.compile(MATH, re.DOTALL)


class HtmlFormulas:
    """Formulas as MathML; wide ones scroll where the screen is narrow, and can be reached by keyboard."""

    def inline(self, formula: Display) -> str:
        (latex,) = formula.lines
        box = boxes(latex)
        if width(latex) <= HELD or not isinstance(box, Row):
            return math(box)
        return " ".join(map(math, _parts(box.boxes)))

    def display(self, formula: Display) -> str:
        shown = self._display(formula)
        return f'<div class="answer">{shown}</div>' if formula.boxed else shown

    def _display(self, formula: Display) -> str:
        (first, *rest) = formula.lines
        if rest or BESIDE not in first or "&" in first.split(r"\begin")[0]:
            return _shown(boxes_of_lines(formula.lines), max(map(width, formula.lines)))
        beside = (_shown(boxes(part), width(part)) for part in map(str.strip, first.split(BESIDE)))
        return f'<div class="beside">{"".join(beside)}</div>'


def _shown(box: Box, wide: float) -> str:
    reached = f' tabindex="0" role="group" aria-label="{english("equation")}"' if wide > NARROW else ""
    return f'<div class="display"{reached}>{math(box, display=True)}</div>'


def _parts(found: Sequence[Box]) -> Iterator[Box]:
    """A long formula of a text in parts between which a line may end: before relations and after commas, in
    parentheses only where a part is still long."""
    for part in _split(found, 0):
        yield from (map(Row, _split(part, DEEPEST)) if _is_long(part) else (Row(part),))


def _split(found: Iterable[Box], deepest: int) -> Iterator[tuple[Box, ...]]:
    part: list[Box] = []
    depth = 0
    for box in found:
        kind = box.kind if isinstance(box, Sign) else ""
        depth += (kind == "opening") - (kind == "closing")
        if kind == "relation" and depth <= deepest and part:
            yield tuple(part)
            part = []
        part.append(box)
        if kind == "punctuation" and depth <= deepest:
            yield tuple(part)
            part = []
    if part:
        yield tuple(part)


def _is_long(part: tuple[Box, ...]) -> bool:
    return len(TAG.sub("", math(Row(part)))) > MANY


def laid_out(page: str) -> str:
    """The page with its paragraphs. Raises ValueError for mathematics that is still in TeX."""
    if found := re.search(r"(?<!\\)\$[^$\n]*\$", page):
        raise ValueError(f"a formula is still in TeX: {found[0][:80]}")
    named = HEADING.sub(_named, page)
    blocks = (block.strip() for block in named.split("\n\n"))
    return "\n\n".join(_block(TOGETHER.sub(_held, block)) for block in blocks if block)


def _block(written: str) -> str:
    return written if written.startswith(BLOCKS) else f"<p>{written}</p>"


def _named(found: re.Match[str]) -> str:
    """A heading of a table that is a formula, with its letters for readers that take it for empty."""
    letters = html_text(unescape(TAG.sub("", found[0])))
    return f'<span class="heard">{letters}</span>' + found[0].replace("<math", '<math aria-hidden="true"')


def _held(found: re.Match[str]) -> str:
    return found[0] if ALONE.fullmatch(found[0]) else f'<span class="held">{found[0]}</span>'


FORMULAS = HtmlFormulas()


def _prose(text: str) -> str:
    return spelt(html_prose(text), FORMULAS, ())


HTML = Skin("html", _prose, html_text, FORMULAS)
