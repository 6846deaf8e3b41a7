"""Writes boxes as the equations of Word (OMML), so that LibreOffice, which reads them too, shows the same.

LibreOffice takes a run for a formula of its own language, in which a sign wants something on either side and
a parenthesis its partner: words, and signs that lack it, are runs of plain text, and parentheses are one box
with what they hold.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from html import escape

from derive.render.formula.alphabets import in_alphabet
from derive.render.formula.boxes import (
    Accent,
    Box,
    Digits,
    Fenced,
    Fraction,
    Gap,
    Grid,
    Letter,
    Root,
    Row,
    Scripts,
    Sign,
    Stacked,
    Styled,
    Word,
)

ACCENTS = {
    "hat": "\u0302", "widehat": "\u0302", "bar": "\u0305", "vec": "\u20d7", "dot": "\u0307", "ddot": "\u0308",
    "dddot": "\u20db", "tilde": "\u0303", "widetilde": "\u0303", "check": "\u030c", "acute": "\u0301",
    "grave": "\u0300", "breve": "\u0306", "overrightarrow": "\u20d7",
}  # fmt: skip
BARS = {"overline": "top", "underline": "bot"}
BRACES = {"overbrace": ("⏞", "top"), "underbrace": ("⏟", "bot")}
SIZES = ("display", "inline", "text")
SPACES = {
    3 / 18: "\u2009",
    4 / 18: "\u2005",
    5 / 18: "\u2005",
    0.25: "\u2005",
    1.0: "\u2003",
    2.0: "\u2003\u2003",
}
DEGREE = Sign("∘", "binary")
NARROW = "\u2009"  # beside the name of a function


def omml(box: Box) -> str:
    """What stands in an equation."""
    return "".join(_row((box,), "")) if isinstance(box, Sign) else _omml(box, "")


@lru_cache(4096)
def _omml(box: Box, style: str) -> str:
    match box:
        case Letter(char):
            upright = style == "upright" or (not style and char in "ΓΔΘΛΞΠΣΥΦΨΩ")
            return _text(char) if upright else _run(in_alphabet(char, style))
        case Digits(text):
            return _run(in_alphabet(text, style))
        case Word(text):
            return _text(in_alphabet(text, style))
        case Sign(char, kind):
            return _text(char) if kind in ("opening", "closing") or char in "|‖/:!" else _run(char)
        case Gap(em):
            return _text(SPACES.get(em, "\u2003" * round(em))) if em > 0 else ""
        case Row(boxes):
            return "".join(_row(_paired(boxes), style))
        case Scripts(base, below, above):
            return _scripts(base, below, above, style)
        case _:
            return _around(box, style)


def _around(box: Box, style: str) -> str:
    match box:
        case Fraction(above, below, _, bar):
            kind = "" if bar else _value("fPr", _value("type", "noBar"))
            return f"<m:f>{kind}{_part('num', above, style)}{_part('den', below, style)}</m:f>"
        case Root(inside, degree):
            hidden = "" if degree else '<m:radPr><m:degHide m:val="1"/></m:radPr>'
            index = _part("deg", degree, style) if degree else "<m:deg/>"
            return f"<m:rad>{hidden}{index}{_part('e', inside, style)}</m:rad>"
        case Fenced(opening, inside, closing):
            return _fenced(opening, _omml(inside, style), closing)
        case Accent(mark, over) if mark in BARS:
            place = f'<m:barPr><m:pos m:val="{BARS[mark]}"/></m:barPr>'
            return f"<m:bar>{place}{_part('e', over, style)}</m:bar>"
        case Accent(mark, over) if mark in BRACES:
            char, place = BRACES[mark]
            kind = f'<m:groupChrPr><m:chr m:val="{char}"/><m:pos m:val="{place}"/></m:groupChrPr>'
            return f"<m:groupChr>{kind}{_part('e', over, style)}</m:groupChr>"
        case Accent(mark, over):
            kind = f'<m:accPr><m:chr m:val="{ACCENTS[mark]}"/></m:accPr>'
            return f"<m:acc>{kind}{_part('e', over, style)}</m:acc>"
        case Stacked(base, over, under):
            return _stacked(_omml(base, style), over, under, style)
        case Styled(name, inside):
            return _omml(inside, style if name in SIZES else name)
        case Grid():
            return _grid(box, style)
        case _:
            raise TypeError(f"not a box: {box!r}")


# -- runs ----------------------------------------------------------------------------------------------


def _run(text: str) -> str:
    return f'<m:r><m:t xml:space="preserve">{escape(text)}</m:t></m:r>'


def _text(text: str) -> str:
    """Plain text, upright and spaced as it stands."""
    return f'<m:r><m:rPr><m:nor/></m:rPr><m:t xml:space="preserve">{escape(text)}</m:t></m:r>'


def _value(name: str, inside: str) -> str:
    return f'<m:{name} m:val="{inside}"/>' if "<" not in inside else f"<m:{name}>{inside}</m:{name}>"


def _part(name: str, box: Box, style: str) -> str:
    written = _text(box.char) if isinstance(box, Sign) else _omml(box, style)
    return f"<m:{name}>{written}</m:{name}>"


# -- one beside the other --------------------------------------------------------------------------------


def _paired(boxes: Sequence[Box]) -> tuple[Box, ...]:
    """The boxes of a row, parentheses in it as one box with what they hold and what hangs on them."""
    opened: list[tuple[str, list[Box]]] = [("", [])]
    for box in boxes:
        sign = box.base if isinstance(box, Scripts) else box
        kind = sign.kind if isinstance(sign, Sign) else ""
        if kind == "opening" and isinstance(box, Sign):
            opened.append((box.char, []))
        elif kind == "closing" and isinstance(sign, Sign) and len(opened) > 1 and sign.char != "!":
            opening, inside = opened.pop()
            fenced = Fenced(opening, Row(tuple(inside)), sign.char)
            opened[-1][1].append(
                Scripts(fenced, box.below, box.above) if isinstance(box, Scripts) else fenced
            )
        else:
            opened[-1][1].append(box)
    while len(opened) > 1:  # one that is closed in another line
        opening, inside = opened.pop()
        opened[-1][1].extend((Sign(opening, "opening"), *inside))
    return tuple(opened[0][1])


def _row(boxes: Sequence[Box], style: str) -> Iterator[str]:
    last = len(boxes) - 1
    for k, box in enumerate(boxes):
        if isinstance(box, Sign) and box.kind in ("binary", "relation") and k in (0, last):
            yield _text(f" {box.char} " if box.kind == "relation" else f"{box.char} ")
        elif isinstance(box, Sign) and box.kind == "punctuation":
            yield _text(f"{box.char} ")
        elif _is_function(box):
            before = k > 0 and _is_something(boxes[k - 1])
            after = k < last and _is_something(boxes[k + 1])
            yield (_text(NARROW) if before else "") + _omml(box, style) + (_text(NARROW) if after else "")
        else:
            yield _omml(box, style)


def _is_function(box: Box) -> bool:
    inner = box.base if isinstance(box, Scripts) else box
    return isinstance(inner, Word) and inner.operator


def _is_something(box: Box) -> bool:
    """Whether a function stands apart from it."""
    if isinstance(box, Sign):
        return box.kind == "ordinary"
    return not isinstance(box, Gap | Fenced) and not _is_function(box)


# -- around and on top -------------------------------------------------------------------------------------


def _fenced(opening: str, inside: str, closing: str) -> str:
    fences = f'<m:begChr m:val="{escape(opening)}"/><m:endChr m:val="{escape(closing)}"/>'
    return f"<m:d><m:dPr>{fences}</m:dPr><m:e>{inside}</m:e></m:d>"


def _scripts(base: Box, below: Box | None, above: Box | None, style: str) -> str:
    if above == DEGREE:
        return _omml(base if below is None else Scripts(base, below), style) + _text("°")
    if isinstance(base, Sign) and base.kind == "large":
        return _summed(base.char, below, above, style)
    shown = f"<m:e>{_omml(base, style) or _text('')}</m:e>"
    sub = "" if below is None else _part("sub", below, style)
    sup = "" if above is None else _part("sup", above, style)
    tag = "sSubSup" if sub and sup else "sSub" if sub else "sSup"
    return f"<m:{tag}>{shown}{sub}{sup}</m:{tag}>"


def _summed(char: str, below: Box | None, above: Box | None, style: str) -> str:
    """A sum with its limits; what is summed stands after it."""
    return _stacked(_run(char), above, below, style)


def _stacked(base: str, over: Box | None, under: Box | None, style: str) -> str:
    for tag, limit in (("limLow", under), ("limUpp", over)):
        if limit is not None:
            base = f"<m:{tag}><m:e>{base}</m:e>{_part('lim', limit, style)}</m:{tag}>"
    return base


def _grid(grid: Grid, style: str) -> str:
    columns = max(map(len, grid.rows))
    shape = (
        f'<m:mcs><m:mc><m:mcPr><m:count m:val="{columns}"/><m:mcJc m:val="center"/></m:mcPr></m:mc></m:mcs>'
    )
    rows = "".join(
        "<m:mr>" + "".join(_part("e", cell, style) for cell in row) + "</m:mr>" for row in grid.rows
    )
    table = f"<m:m><m:mPr>{shape}</m:mPr>{rows}</m:m>"
    return _fenced(grid.opening, table, grid.closing) if grid.opening or grid.closing else table
