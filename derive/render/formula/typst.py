"""Writes boxes as Typst mathematics: letters one by one, everything else a call, nothing left to be guessed.

Typst reads `a / b / c` from the left, makes fences grow by itself and takes letters side by side for a name;
so a fraction is `frac(a, b)`, a sign of ASCII is escaped, and every piece stands apart from the next.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache

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
from derive.render.formula.vocabulary import OPERATORS

ACCENTS = {
    "widehat": "hat", "bar": "macron", "vec": "arrow", "ddot": "dot.double", "dddot": "dot.triple",
    "widetilde": "tilde", "check": "caron", "overrightarrow": "arrow",
}  # fmt: skip
STYLES = {"bold": "bold(upright({}))", "bolditalic": "bold({})"}
GAPS = {3 / 18: "thin", 4 / 18: "med", 5 / 18: "thick", 1.0: "quad", 2.0: "wide"}
CLASSES = {"ordinary": "normal"}
OWN_CLASS = frozenset("|‖/:")  # what Typst would space as something else
PAIRED = frozenset("⟨⟩⌊⌋⌈⌉")  # what Typst would look for the partner of
UNIT = re.compile(r'\w|\\?[^\w\s"]|"[^"]*"|\d+(?:\.\d+)?')  # what is one piece without parentheses around
ROOM = {"relation": "thick", "binary": "med"}
DEGREE, PRIME = Sign("∘", "binary"), Sign("′")
ROW_GAPS = {2: "row-gap: #0.95em, ", 1: "row-gap: #0.7em, ", 0: ""}  # by how tall the fractions in rows are


@lru_cache(4096)
def typst(box: Box) -> str:
    """A box as Typst writes it within dollars."""
    match box:
        case Letter(char) | Digits(char):
            return char
        case Word(text, operator):
            return text if operator and text in OPERATORS else _word(text, operator)
        case Sign(char, kind):
            return _sign(char, kind)
        case Gap(em):
            return GAPS.get(em) or f"#h({em:.4f}em)"
        case Row(boxes):
            return _beside(boxes, _row(boxes))
        case Scripts(base, below, above):
            return _scripts(base, below, above)
        case Grid(rows, _, _, True):
            return " \\\n".join(" & ".join(map(typst, row)) for row in rows)
        case _:
            return _around(box)


def in_text(box: Box) -> str:
    """A box in a line of text, which breaks between terms only: at no equal sign, in no parentheses."""
    return _beside(box.boxes, _held_together(box.boxes)) if isinstance(box, Row) else typst(box)


def _beside(boxes: Sequence[Box], written: Iterable[str]) -> str:
    """Pieces side by side: Typst shows the blanks around a word, and no others."""
    line = ""
    for before, box, piece in zip((Gap(0), *boxes), boxes, written, strict=False):
        line += piece if not line or _is_word(before) or _is_word(box) else f" {piece}"
    return line


def _is_word(box: Box) -> bool:
    part = box.base if isinstance(box, Scripts) else box
    return isinstance(part, Word) and not part.operator


def _held_together(boxes: Sequence[Box], depth: int = 0) -> Iterator[str]:
    """The pieces of a row, with the signs that a line may not end with as plain ones between gaps; `depth`
    counts the parentheses around."""
    for box, written in zip(boxes, _row(boxes), strict=True):
        if isinstance(box, Sign) and box.kind in ("opening", "closing"):
            depth += 1 if box.kind == "opening" else -1
        if isinstance(box, Sign) and (box.kind == "relation" or (box.kind == "binary" and depth)):
            yield f'{ROOM[box.kind]} class("normal", {_character(box.char)}) {ROOM[box.kind]}'
        elif isinstance(box, Fenced) and isinstance(box.inside, Row):
            inside = box.inside.boxes
            yield _fenced(box, _beside(inside, _held_together(inside, depth + 1)))
        else:
            yield written


def _given(box: Box) -> str:
    """A box that a call is given; none is left out."""
    return typst(box) or '""'


def _around(box: Box) -> str:
    match box:
        case Fraction(above, below, size):
            written = f"frac({_given(above)}, {_given(below)})"
            return f"{'inline' if size == 'text' else size}({written})" if size else written
        case Root(inside, degree):
            return f"root({_given(degree)}, {_given(inside)})" if degree else f"sqrt({_given(inside)})"
        case Fenced(_, Fraction(above, below, _, False), _):
            return f"binom({_given(above)}, {_given(below)})"
        case Fenced(_, inside, _):
            return _fenced(box, _given(inside))
        case Accent(mark, over):
            return f"{ACCENTS.get(mark, mark)}({_given(over)})"
        case Stacked(base, over, under):
            return _attached(f"limits({_given(base)})", under, over)
        case Styled(style, inside):
            return STYLES.get(style, f"{style}({{}})").format(_given(inside))
        case Grid():
            return _grid(box)
        case _:
            raise TypeError(f"not a box: {box!r}")


def _fenced(box: Fenced, inside: str) -> str:
    opening, closing = (_character(fence) if fence else "" for fence in (box.opening, box.closing))
    return f"lr({opening} {inside} {closing})"


def _row(boxes: Iterable[Box]) -> Iterator[str]:
    before: Box = Gap(0)
    for box in boxes:
        starts = isinstance(before, Gap) and isinstance(box, Sign) and box.kind == "binary"
        yield f'"" {typst(box)}' if starts else typst(box)  # so that it is a sign between terms for Typst too
        before = box


def _word(text: str, operator: bool) -> str:
    quoted = '"' + text.replace("\\", r"\\").replace('"', r"\"") + '"'
    return f"op({quoted})" if operator else quoted


def _sign(char: str, kind: str) -> str:
    written = _character(char)
    return f'class("{CLASSES.get(kind, kind)}", {written})' if char in OWN_CLASS else written


def _character(char: str) -> str:
    bare = char in "+=" or (not char.isascii() and char not in PAIRED)
    return char if bare else f"\\{char}"


def _scripts(base: Box, below: Box | None, above: Box | None) -> str:
    written = _given(base)
    if above == DEGREE:
        above, written = None, f"{written} °"
    raised = above.boxes if isinstance(above, Row) else () if above is None else (above,)
    while raised and raised[0] == PRIME:
        written, raised = f"{written}'", raised[1:]
    rest = None if not raised else raised[0] if len(raised) == 1 else Row(tuple(raised))
    if isinstance(base, Row | Fraction | Fenced) and written != '""':
        return f"attach({', '.join((written, *_named(below, rest)))})"
    return _attached(written, below, rest)


def _named(below: Box | None, above: Box | None) -> Iterator[str]:
    for side, script in (("b", below), ("t", above)):
        if script is not None:
            yield f"{side}: {_given(script)}"


def _attached(base: str, below: Box | None, above: Box | None) -> str:
    for mark, script in (("_", below), ("^", above)):
        if script is not None:
            written = _given(script)
            bare = UNIT.fullmatch(written) and not base.startswith('"')  # what comes next touches a word
            base += mark + (written if bare else f"({written})")
    return base


def _grid(grid: Grid) -> str:
    if (grid.opening, grid.closing) == ("{", ""):
        return f"cases({', '.join(' & quad '.join(map(typst, row)) for row in grid.rows)})"
    fences = ", ".join(f'"{fence}"' if fence else "none" for fence in (grid.opening, grid.closing))
    rows = "; ".join(", ".join(map(typst, row)) for row in grid.rows)
    return f"mat(delim: #({fences}), {ROW_GAPS[_height(grid)]}{rows})"


def _height(grid: Grid) -> int:
    """2 where a matrix holds fractions in full size, 1 where it holds smaller ones."""
    if grid.loose:
        return 2
    parts = (box.boxes if isinstance(box, Row) else (box,) for row in grid.rows for box in row)
    return int(any(isinstance(part, Fraction) for boxes in parts for part in boxes))
