"""How pages look in Typst: formulas spelt as its mathematics, each with what a listener is told."""

from __future__ import annotations

import re

from derive.render.aloud import aloud
from derive.render.author_text import typst_prose
from derive.render.failures import PageFailed
from derive.render.formula.tex import boxes, boxes_of_lines
from derive.render.formula.typst import in_text, typst
from derive.render.formulas import spelt
from derive.render.layout import LINE, Display
from derive.render.plain_text import typst_string, typst_text
from derive.render.skin import Skin
from derive.render.width import width

DOLLAR = "\x01"  # around what is Typst's mathematics already, until the page is laid out
BLOCK = "\x02"  # before what a paragraph leads to, until the page is laid out
ITEM = "- "  # of a list
IN_LINE = "m|long|emph|strong|link|raw"  # the calls that a paragraph may begin with
NO_PARAGRAPH = rf"{BLOCK}|#(?!(?:{IN_LINE})\b)|\]"  # what begins otherwise
LEAD_IN = re.compile(rf"(?<=\n\n)(?!{NO_PARAGRAPH})((?:.+\n)+)\n(?=({BLOCK}+|{ITEM}))")
ONE_LINE = re.compile(rf"(?<=\n\n)(?!{NO_PARAGRAPH}|{ITEM})(.+\n)\n(?!{NO_PARAGRAPH}|{ITEM}|[=\s])")
LISTS = re.compile(r"^(?=#(?:list|enum)\()", re.MULTILINE)
SPOKEN = re.compile(rf'#[a-z]+\("[^"]*", {DOLLAR}')  # what is not seen of a formula, and begins it
FORMULA, TYPICAL = re.compile(rf'#[a-z]+\("[^"]*", {DOLLAR}[^{DOLLAR}]*{DOLLAR}\);'), "x = 3 m/s"
BY_ITSELF, ALONE = 200, 85  # letters and signs: more than two lines, and less than one
UNIT = r"(?:rad|deg|mm|cm|kg|Nm|Hz|[mNsVWJgKA])(?![A-Za-z])[23²³]?"
MEASURE = re.compile(rf"(?<={DOLLAR}\);) {UNIT}(?:(?: |\\?/)\(?{UNIT}\)?)*")  # behind a formula
TYPED = re.compile(rf"(?<=\d)(?:°| {UNIT})(?:\\?/{UNIT})+")  # in an author's text, 25°/s
WORD_JOINER = "\u2060"  # where no line ends
HYPHEN = re.compile(rf"(?<={DOLLAR}\);)(\\?-)(?=[a-z])")  # behind a formula: of the x-axis
HELD = 14.0  # em, up to which a formula does not break in a line of text
FRAME = 2.4  # em that a frame takes from a line
# Rows of a display, those of its matrices too, above which it may break between its lines: several equations,
# and one that goes on from line to line or stands in a frame.
SEVERAL, ONE = 7, 12
HIGH = 30  # rows of a line that may be higher than the page


class TypstFormulas:
    """Formulas as calls of the page's own functions: `eq`, `tall`, `fit` and `broad` for a display, `m` in a
    line."""

    def inline(self, formula: Display) -> str:
        (latex,) = formula.lines
        name, written = ("m", typst) if width(latex) <= HELD else ("long", in_text)
        return f"#{name}({typst_string(aloud(formula))}, {DOLLAR}{written(boxes(latex))}{DOLLAR});"

    def display(self, formula: Display) -> str:
        spoken = typst_string(aloud(formula))
        name = _shape(formula)
        shown = f"#{name}({spoken}, {DOLLAR} {typst(boxes_of_lines(formula.lines))} {DOLLAR})"
        return f"{BLOCK}#answer[{shown}]" if formula.boxed else f"{BLOCK}{shown}"


def _is_wide(formula: Display) -> bool:
    """Whether it may be wider than the line, with the frame that it stands in."""
    framed = formula.boxed and max(width(line.replace("&", "")) for line in formula.lines) > LINE - FRAME
    return formula.wide or framed


def _shape(formula: Display) -> str:
    """The function of the page that finds room for it."""
    rows = [max(part.count(r"\\") + 1 for part in line.split(r"\begin")) for line in formula.lines]
    if max(rows) > HIGH:
        return "high"
    one = formula.boxed or any(line.lstrip().startswith("&") for line in formula.lines[1:])
    tall = sum(rows) > (ONE if one else SEVERAL)
    if _is_wide(formula):
        return "broad" if tall else "fit"
    return "tall" if tall else "eq"


def laid_out(page: str) -> str:
    """The page with its dollars, each paragraph that leads to a block held to it. Raises PageFailed for
    mathematics that is still in TeX."""
    if "$" in page:
        raise PageFailed(f"a formula is still in TeX: {page[page.index('$') :][:80]}")
    page = HYPHEN.sub(rf"{WORD_JOINER}\1{WORD_JOINER}", page)
    tied = TYPED.sub(_unbroken, MEASURE.sub(_tied, page))
    return LEAD_IN.sub(_led, ONE_LINE.sub(_held, tied)).replace(BLOCK, "").replace(DOLLAR, "$")


def _tied(found: re.Match[str]) -> str:
    """A unit in one piece with its number."""
    return _unbroken(found).replace(" ", "~")


def _unbroken(found: re.Match[str]) -> str:
    """A quotient of units in one piece."""
    return found[0].replace("/", f"/{WORD_JOINER}")


def _held(found: re.Match[str]) -> str:
    """A paragraph of one line held to that which follows: alone it would be an orphan."""
    short = len(FORMULA.sub(TYPICAL, found[1])) < ALONE
    return f"#lead[{found[1]}]\n\n" if short else found[0]


def _led(found: re.Match[str]) -> str:
    """A paragraph held to what it leads to; one that is long and has its full stop stands by itself, but not
    before a question."""
    paragraph = found[1]
    by_itself = (
        found[2] == BLOCK and paragraph.rstrip().endswith(".") and len(SPOKEN.sub("", paragraph)) > BY_ITSELF
    )
    item = found[2] == ITEM and paragraph.startswith(ITEM)  # one after another
    return found[0] if by_itself or item else f"#lead[{paragraph}]\n\n"


FORMULAS = TypstFormulas()


def _prose(text: str) -> str:
    return spelt(LISTS.sub(BLOCK, typst_prose(text)), FORMULAS, ())


TYPST = Skin("typst", _prose, typst_text, FORMULAS)
