"""Writes boxes as MathML Core: what browsers set by themselves, with room between signs as TeX gives it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
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
    "hat": "^", "widehat": "^", "bar": "¯", "overline": "¯", "underline": "_", "vec": "→", "dot": "˙",
    "ddot": "¨", "dddot": "\N{COMBINING THREE DOTS ABOVE}", "tilde": "~", "widetilde": "~", "check": "ˇ",
    "acute": "´", "grave": "`", "breve": "˘", "overrightarrow": "→", "overbrace": "⏞", "underbrace": "⏟",
}  # fmt: skip
STRETCHING = ("widehat", "widetilde", "overline", "underline", "overrightarrow", "overbrace", "underbrace")
BELOW = ("underline", "underbrace")
SIZES = {"display": "true", "inline": "false", "text": "false"}
LIMITS = ("max", "min", "sup", "inf", "lim")
INTEGRALS = "∫∬∮"
TAG = re.compile("<[^>]*>")
THIN = '<mspace width="0.167em"></mspace>'
DEGREE = Sign("∘", "binary")
DEGREES = '<mi mathvariant="normal">°</mi>'
FORMS = {
    "opening": "prefix", "closing": "postfix", "prefix": "prefix", "binary": "infix", "relation": "infix"
}  # fmt: skip


def math(box: Box, display: bool = False) -> str:
    """A formula of a page, on lines of its own or in one of text."""
    return f'<math display="block">{mathml(box)}</math>' if display else f"<math>{mathml(box)}</math>"


@lru_cache(4096)
def mathml(box: Box, style: str = "", tight: bool = False) -> str:
    """A box; `style` is the alphabet of its letters. In scripts signs stand `tight`."""
    match box:
        case Letter(char):
            return _letter(char, style)
        case Digits(text):
            return f"<mn>{in_alphabet(text, style)}</mn>"
        case Word(text, operator):
            return _word(text, operator, style)
        case Sign(char, kind):
            return _sign(char, kind, tight)
        case Gap(em):
            return f'<mspace width="{em:.3g}em"></mspace>'
        case Row(boxes):
            return _one("".join(_spaced(boxes, style, tight)), len(boxes))
        case Scripts(base, below, above):
            return _scripts(base, below, above, style)
        case Grid():
            return _grid(box, style)
        case _:
            return _around(box, style)


def _around(box: Box, style: str) -> str:
    match box:
        case Fraction(above, below, size, bar):
            line = "" if bar else ' linethickness="0"'
            fraction = f"<mfrac{line}>{mathml(above, style)}{mathml(below, style)}</mfrac>"
            return _sized(size, fraction) if size else fraction
        case Root(inside, degree):
            if degree is None:
                return f"<msqrt>{mathml(inside, style)}</msqrt>"
            return f"<mroot>{mathml(inside, style)}{mathml(degree, style)}</mroot>"
        case Fenced(opening, inside, closing):
            return _fenced(opening, mathml(inside, style), closing)
        case Accent(mark, over):
            stretchy = "" if mark in STRETCHING else ' stretchy="false"'
            tag, kind = ("munder", "accentunder") if mark in BELOW else ("mover", "accent")
            sign = f"<mo{stretchy}>{ACCENTS[mark]}</mo>"
            return f'<{tag} {kind}="true">{mathml(over, style)}{sign}</{tag}>'
        case Stacked(base, over, under):
            return _stacked(mathml(base, style), over, under, style)
        case Styled(name, inside) if name in SIZES:
            return _sized(name, mathml(inside, style))
        case Styled(name, inside):
            return mathml(inside, name)
        case _:
            raise TypeError(f"not a box: {box!r}")


def _one(written: str, count: int) -> str:
    return written if count == 1 else f"<mrow>{written}</mrow>"


def _sized(size: str, written: str) -> str:
    return f'<mstyle displaystyle="{SIZES[size]}" scriptlevel="0">{written}</mstyle>'


# -- letters, words and signs --------------------------------------------------------------------------


def _letter(char: str, style: str) -> str:
    """One letter is set in italics, unless it is a capital of Greek or of another alphabet."""
    upright = style == "upright" or (not style and char in "ΓΔΘΛΞΠΣΥΦΨΩ")
    return f'<mi mathvariant="normal">{char}</mi>' if upright else f"<mi>{in_alphabet(char, style)}</mi>"


def _word(text: str, operator: bool, style: str) -> str:
    if " " in text:
        return f"<mtext>{escape(text)}</mtext>".replace(" ", "\N{NO-BREAK SPACE}")
    if len(text) == 1 and not style:
        return f'<mi mathvariant="normal">{escape(text)}</mi>'
    if operator and text in LIMITS:
        return f'<mo form="prefix" movablelimits="true" lspace="0" rspace="0">{text}</mo>'
    return f"<mi>{in_alphabet(escape(text), style)}</mi>"


def _sign(char: str, kind: str, tight: bool) -> str:
    shown = escape(char)
    if tight and kind in ("binary", "relation", "punctuation"):
        return f'<mo lspace="0" rspace="0">{shown}</mo>'
    match kind:
        case "ordinary" if char in "|‖/":
            return f'<mo stretchy="false" lspace="0" rspace="0">{shown}</mo>'
        case "ordinary":
            return f'<mi mathvariant="normal">{shown}</mi>'
        case "opening" | "closing":
            return f'<mo form="{FORMS[kind]}" stretchy="false" lspace="0" rspace="0">{shown}</mo>'
        case "prefix" | "binary" | "relation":
            room = ' lspace="0.278em" rspace="0.278em"' if kind == "relation" and char in ":∣→←" else ""
            return f'<mo form="{FORMS[kind]}"{room}>{shown}</mo>'
        case "large" if char in INTEGRALS:
            return f"<mo>{shown}</mo>"
        case "large":
            return f'<mo movablelimits="true">{shown}</mo>'
        case _:
            return f"<mo>{shown}</mo>"


def _fenced(opening: str, inside: str, closing: str) -> str:
    return f"<mrow>{_fence(opening, 'prefix')}{inside}{_fence(closing, 'postfix')}</mrow>"


def _fence(char: str, form: str) -> str:
    return f'<mo form="{form}" stretchy="true">{escape(char)}</mo>' if char else ""


# -- one beside the other --------------------------------------------------------------------------------


def _spaced(boxes: Sequence[Box], style: str, tight: bool) -> Iterator[str]:
    """The pieces of a row, with the room that a function's name has from what stands beside it."""
    for k, box in enumerate(boxes):
        before = boxes[k - 1] if k else None
        if before is not None and _stand_apart(before, box):
            yield THIN
        yield mathml(box, style, tight)


def _stand_apart(left: Box, right: Box) -> bool:
    after = _is_function(left) and _takes_room(right)
    return after or (_is_function(right) and _ends_something(left))


def _is_function(box: Box) -> bool:
    inner = box.base if isinstance(box, Scripts) else box
    return isinstance(inner, Word) and inner.operator


def _takes_room(box: Box) -> bool:
    """Whether it stands apart from a function before it, as its argument without parentheses does."""
    if isinstance(box, Sign):
        return box.kind in ("ordinary", "prefix")
    return not isinstance(box, Gap | Fenced)


def _ends_something(box: Box) -> bool:
    """Whether a function after it stands apart."""
    return box.kind in ("ordinary", "closing") if isinstance(box, Sign) else not isinstance(box, Gap)


# -- above and below ---------------------------------------------------------------------------------------


def _scripts(base: Box, below: Box | None, above: Box | None, style: str) -> str:
    if above == DEGREE:
        return f"<mrow>{mathml(base if below is None else Scripts(base, below), style)}{DEGREES}</mrow>"
    shown = mathml(base, style) if base != Row(()) else "<mi></mi>"
    if _has_limits(base):
        return _stacked(shown, above, below, style)
    scripts = [mathml(script, style, True) for script in (below, above) if script is not None]
    tag = "msubsup" if len(scripts) == 2 else "msup" if below is None else "msub"
    return f"<{tag}>{shown}{''.join(scripts)}</{tag}>"


def _has_limits(base: Box) -> bool:
    if isinstance(base, Sign):
        return base.kind == "large" and base.char not in INTEGRALS
    return isinstance(base, Word) and base.operator and base.text in LIMITS


def _stacked(base: str, over: Box | None, under: Box | None, style: str) -> str:
    parts = [mathml(part, style, True) for part in (under, over) if part is not None]
    tag = "munderover" if len(parts) == 2 else "mover" if under is None else "munder"
    return f"<{tag}>{base}{''.join(parts)}</{tag}>"


# -- rows and columns ----------------------------------------------------------------------------------------


def _grid(grid: Grid, style: str) -> str:
    rows = "".join(f"<mtr>{''.join(_cells(row, style))}</mtr>" for row in grid.rows)
    if grid.aligned:
        return f'<mtable class="lines" displaystyle="true">{rows}</mtable>'
    kind = "cases" if (grid.opening, grid.closing) == ("{", "") else "loose" if grid.loose else ""
    table = f'<mtable class="{kind}">{rows}</mtable>' if kind else f"<mtable>{rows}</mtable>"
    return _fenced(grid.opening, table, grid.closing)


def _cells(row: Iterable[Box], style: str) -> Iterator[str]:
    for cell in row:
        yield f"<mtd>{mathml(cell, style)}</mtd>"
