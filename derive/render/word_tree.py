"""Pandoc's tree of a page as Word is to have it: our equations and captions, tables of their own width."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from math import floor
from typing import Any, TypeAlias

from derive.render.formula.boxes import Box, Grid
from derive.render.formula.omml import omml
from derive.render.formula.tex import boxes
from derive.render.typed import BOXED
from derive.render.width import width

Node: TypeAlias = Any  # of pandoc's tree, as JSON

LINE = 40.5  # em, a line of text
EM = 220  # twentieths of a point, of 11 pt
SLACK = 1.12  # Word's letters are wider than those that were measured,
MOST = 1.35  # and those of other programs may be wider still
FUNCTION, FUNCTIONS = 0.2, re.compile(r"\\(?:sin|cos|tan|ln|exp|operatorname)\b")
NUMBER = 3.0  # em, for the number of an equation at the margin
INSET = 140  # twentieths of a point, that a frame needs beside an equation
BESIDE = r"\qquad"
TAGGED = re.compile(r"(.*?)(?:\{\})?\s*\\tag\{(\d+)\}", re.DOTALL)
CHARACTER, MARGIN = 0.56, 1.6  # em, of a text and beside a column


def in_word(blocks: Sequence[Node]) -> Iterator[Node]:
    """The blocks of a page; a paragraph that leads to an equation or a table stays with it."""
    alone = [_alone(block) for block in blocks]
    kinds = [_kind(block, only) for block, only in zip(blocks, alone, strict=True)]
    for k, (block, only, kind) in enumerate(zip(blocks, alone, kinds, strict=True)):
        if kind == "Equation":
            yield _raw("RawBlock", _display(only["c"][1]))
        elif kind == "Image":
            yield _styled("Captioned Figure", [block])
        elif kind == "Emph" and k and kinds[k - 1] == "Image":
            yield _styled("Image Caption", [{"t": "Para", "c": _inside(only["c"])}])
        elif kind == "Table":
            yield _inside(_with_widths(block))
        elif block["t"] == "Para" and k + 1 < len(blocks) and kinds[k + 1] in ("Equation", "Table"):
            yield _styled("Lead In", [_inside(block)])
        else:
            yield _inside(block)


def _alone(block: Node) -> Node:
    """What a paragraph holds and nothing else."""
    single = block["t"] in ("Para", "Plain") and len(block["c"]) == 1
    return block["c"][0] if single else {"t": ""}


def _kind(block: Node, only: Node) -> str:
    displayed = only["t"] == "Math" and only["c"][0]["t"] == "DisplayMath"
    return "Equation" if displayed else str(only["t"] or block["t"])


def _inside(node: Node) -> Node:
    """A part of the tree with our equations in the place of pandoc's own."""
    match node:
        case {"t": "Math", "c": [_, tex]}:
            return _raw("RawInline", f"<m:oMath>{omml(boxes(tex))}</m:oMath>")
        case {"t": "BulletList", "c": items}:
            return {"t": "BulletList", "c": [[*in_word(item)] for item in items]}
        case {"t": "OrderedList", "c": [start, items]}:
            return {"t": "OrderedList", "c": [start, [[*in_word(item)] for item in items]]}
        case dict():
            return {key: _inside(each) for key, each in node.items()}
        case list():
            return [*map(_inside, node)]
        case _:
            return node


def _raw(kind: str, written: str) -> Node:
    return {"t": kind, "c": ["openxml", written]}


def _styled(name: str, blocks: list[Node]) -> Node:
    return {"t": "Div", "c": [["", [], [["custom-style", name]]], blocks]}


# -- tables ------------------------------------------------------------------------------------------------


def _with_widths(table: Node) -> Node:
    """The table with columns as wide as what stands in them."""
    attributes, caption, columns, (kept, heads), bodies, foot = table["c"]
    rows = [row for rows in (heads, *(body[3] for body in bodies)) for row in rows]
    wide = [max(_width(row[1][k][4]) for row in rows) + MARGIN for k in range(len(columns))]
    share = min(1.0, LINE / sum(wide)) / LINE
    sized = [
        [column[0], {"t": "ColWidth", "c": round(each * share, 4)}]
        for column, each in zip(columns, wide, strict=True)
    ]
    return {"t": "Table", "c": [attributes, caption, sized, [kept, heads], bodies, foot]}


def _width(node: Node) -> float:
    """How wide a cell is in one line, in em."""
    match node:
        case {"t": "Math", "c": [_, tex]}:
            return SLACK * width(tex)
        case {"t": "Str", "c": text}:
            return CHARACTER * len(text)
        case {"t": "Space"}:
            return CHARACTER / 2
        case {"c": inside}:
            return _width(inside)
        case list():
            return sum(map(_width, node))
        case _:
            return 0.0


# -- equations ---------------------------------------------------------------------------------------------


def _display(tex: str) -> str:
    """An equation, with its number at the margin in a table of one row."""
    numbered = TAGGED.fullmatch(tex.strip())
    return _numbered(_equation(numbered[1], LINE - 2 * NUMBER), numbered[2]) if numbered else _equation(tex)


def _numbered(written: str, number: str) -> str:
    side, middle = round(EM * NUMBER), round(EM * (LINE - 2 * NUMBER))
    label = f"<w:r><w:t>({number})</w:t></w:r>"
    cells = ((side, _line("", "left")), (middle, written), (side, _line(label, "right")))
    row = "".join(_in_cell(inside, wide) for wide, inside in cells)
    return _table([row], [side, middle, side], "")


def _line(inside: str, side: str) -> str:
    """A paragraph of a table that sets equations."""
    return f'<w:p><w:pPr><w:pStyle w:val="EquationLine"/><w:jc w:val="{side}"/></w:pPr>{inside}</w:p>'


def _equation(tex: str, room: float = LINE) -> str:
    """A paragraph for an equation, a table for several that meet at their signs; an answer has a frame."""
    framed = BOXED.fullmatch(tex.strip())
    tex = framed[1] if framed else tex
    box = boxes(tex)
    if isinstance(box, Grid) and box.aligned:
        columns = _columns(tex, room)
        whole = sum(columns) / EM
        fitting = [round(column * min(1.0, room / whole)) for column in columns]
        return _small(_lines(box, fitting, framed is not None), whole, room)
    rows = _rows(tex, room)
    wide = max(map(_wide, rows))
    frame = _frame("pBdr") + _indented(wide, room) if framed else ""
    equations = (
        f'<w:p><w:pPr><w:pStyle w:val="Equation"/>{"" if row is rows[-1] else "<w:keepNext/>"}{frame}</w:pPr>'
        f"<m:oMathPara><m:oMath>{omml(boxes(row))}</m:oMath></m:oMathPara></w:p>"
        for row in rows
    )
    return _small("".join(equations), wide, room)


def _rows(tex: str, room: float) -> list[str]:
    """Equations that stand side by side, as many in a row as have room."""
    rows: list[str] = []
    for part in map(str.strip, tex.split(BESIDE)):
        together = f"{rows[-1]} {BESIDE} {part}" if rows else ""
        if together and _wide(together) <= room:
            rows[-1] = together
        else:
            rows.append(part)
    return rows


def _frame(of: str) -> str:
    """Four rules around a paragraph or a table."""
    rules = "".join(
        f'<w:{side} w:val="single" w:sz="6" w:space="{0 if of == "tblBorders" else 6}" w:color="000000"/>'
        for side in ("top", "left", "bottom", "right")
    )
    return f"<w:{of}>{rules}</w:{of}>"


def _indented(wide: float, room: float) -> str:
    """A paragraph as wide as its equation, in the middle."""
    side = max(INSET, round(EM * (room - wide - 2) / 2))
    return f'<w:ind w:left="{side}" w:right="{side}"/>'


def _small(written: str, wide: float, room: float) -> str:
    """An equation in letters so small that it fits."""
    if wide <= room:
        return written
    size = floor(22 * room / wide)  # half points
    return written.replace("<m:t ", f'<w:rPr><w:sz w:val="{size}"/><w:szCs w:val="{size}"/></w:rPr><m:t ')


def _wide(tex: str) -> float:
    """How wide an equation may be; there is a blank behind the name of a function."""
    return SLACK * width(tex) + FUNCTION * len(FUNCTIONS.findall(tex))


def _columns(tex: str, room: float) -> list[int]:
    """How wide the columns of aligned lines are, in twentieths of a point."""
    body = tex.split("{aligned}")[1].removesuffix("\\end")
    found: list[float] = []
    for line in body.split("\\\\\n"):
        for k, cell in enumerate(_cells(line)):
            found += [0.0] * (k + 1 - len(found))
            found[k] = max(found[k], width(cell))
    scale = max(SLACK, min(MOST, room / sum(found)))
    return [round(EM * (scale * each + 0.3)) for each in found]


def _cells(line: str) -> list[str]:
    """The parts of a line between marks that are of no matrix."""
    cells, depth = [""], 0
    for part in line.replace("\\begin", "\0\\begin").replace("\\end", "\0\\end").split("\0"):
        depth += part.startswith("\\begin") - part.startswith("\\end")
        first, *rest = part.split("&") if depth == 0 else [part]
        cells[-1] += first
        cells += rest
    return cells


def _lines(grid: Grid, columns: list[int], framed: bool) -> str:
    rows = [_row(row, columns) for row in grid.rows]
    return _table(rows, columns, _frame("tblBorders") if framed else "")


def _table(rows: Sequence[str], columns: Sequence[int], frame: str) -> str:
    """A table in the middle, and a low line that keeps it from the next."""
    shape = "".join(f'<w:gridCol w:w="{column}"/>' for column in columns)
    whole = "".join(f"<w:tr><w:trPr><w:cantSplit/></w:trPr>{row}</w:tr>" for row in rows)
    return (
        f'<w:tbl><w:tblPr><w:tblW w:w="{sum(columns)}" w:type="dxa"/><w:jc w:val="center"/>{frame}'
        '<w:tblLayout w:type="fixed"/><w:tblCellMar><w:left w:w="0" w:type="dxa"/>'
        '<w:right w:w="0" w:type="dxa"/></w:tblCellMar></w:tblPr>'
        f"<w:tblGrid>{shape}</w:tblGrid>{whole}</w:tbl>"
        '<w:p><w:pPr><w:spacing w:line="120" w:lineRule="exact"/></w:pPr></w:p>'
    )


def _row(cells: tuple[Box, ...], columns: list[int]) -> str:
    return "".join(_in_cell(_line(_cell(cells, k), "left"), wide) for k, wide in enumerate(columns))


def _in_cell(inside: str, wide: int) -> str:
    return (
        f'<w:tc><w:tcPr><w:tcW w:w="{wide}" w:type="dxa"/><w:vAlign w:val="center"/></w:tcPr>{inside}</w:tc>'
    )


def _cell(cells: tuple[Box, ...], place: int) -> str:
    written = omml(cells[place]) if place < len(cells) else ""
    if not written:
        return ""
    side = "left" if place % 2 else "right"
    return (
        f'<m:oMathPara><m:oMathParaPr><m:jc m:val="{side}"/></m:oMathParaPr><m:oMath>{written}</m:oMath>'
        "</m:oMathPara>"
    )
