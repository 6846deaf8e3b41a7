"""Where equations break: a chain on one line, broken at its equal signs, or several side by side.

An equation too wide for the page is broken at an equal sign, then between the terms of a sum, and what
is still too wide is marked for the page to scale.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from itertools import groupby
from math import ceil
from typing import TypeAlias

from derive.expression import Expr
from derive.render.notation import Notation
from derive.render.width import RELATION, width

HOUSE = Notation()
LINE = 40.8  # em: the text width of the pages, 160 mm at 11 pt
NUMBERED = LINE - 3.2  # with a number beside it
FRAMED = NUMBERED - 2.4  # in a frame that has a number beside it
GAP = 2.0  # em between equations side by side
INDENT, HANGING = r"&\quad ", 1.0  # of a sum that goes on in the next line, and its width in em
SIGN_SPACE = 0.44  # em around a sign between terms, more than around one in front
DEEPEST = 3  # brackets a break may stand inside
INDEX = re.compile(r"_(\w|\{\w+\})$")
SIGNED = ("-", "- ", "+ ")  # what stands before a fraction that begins a piece
OPENING, FENCE = ("{", r"\left", r"\begin"), re.compile(r"\\(?:left|right).|\\begin|\\end|[{}()]")
MANY = 5  # breaks between the rows of a column from which others stand beside it
WORTH_PACKING = 0.7  # rows per equation above which a plain list reads better


@dataclass(frozen=True, slots=True)
class Link:
    """One expression of a chain: the sign before it, its LaTeX, and the tree this was printed from."""

    relation: str
    latex: str
    tree: Expr | None = None

    @property
    def width(self) -> float:
        return width(self.latex)


@dataclass(frozen=True, slots=True)
class Display:
    """A displayed equation: lines with alignment marks, or a single one without. `wide`: may need scaling;
    `chains` are what was laid out, in a `notation`, none for a display that was typed. The answer to a
    question stands in a frame: `boxed`."""

    lines: tuple[str, ...]
    wide: bool = False
    chains: tuple[Chain, ...] = ()
    notation: Notation = HOUSE
    boxed: bool = False


Chain: TypeAlias = tuple[Link, ...]


def lay_out(chains: tuple[Chain, ...], notation: Notation = HOUSE, room: float = LINE) -> Display:
    """One display for all chains, which were printed in this notation, in lines of so much room (em)."""
    return replace(_laid_out(chains, room), chains=chains, notation=notation)


def _laid_out(chains: tuple[Chain, ...], room: float) -> Display:
    whole = [one_line(chain) for chain in chains]
    widths = [width(line) for line in whole]
    if len(chains) == 1:
        return Display((whole[0],)) if widths[0] <= room else _broken(chains, room)
    together = _of_one_index(chains)
    for count in _column_counts(len(chains)):
        if count % together:
            continue
        if _grid_width(chains, count) <= room:
            return Display(_packed(_rows(chains, count), room) or _grid_lines(chains, count))
    return _broken(chains, room)


def one_line(chain: Chain) -> str:
    """The chain as written in a line of text."""
    first, *rest = chain
    return " ".join((first.latex, *(f"{link.relation} {link.latex}" for link in rest)))


def _of_one_index(chains: tuple[Chain, ...]) -> int:
    """How many equations with one index follow each other, z_0 and o_0, then z_1 and o_1; 1 where they do
    not come in such groups."""
    found = [INDEX.search(chain[0].latex) for chain in chains]
    groups = [len([*group]) for _, group in groupby(index and index[1] for index in found)]
    return groups[0] if all(found) and len(groups) > 1 and len({*groups}) == 1 else 1


def _column_counts(count: int) -> list[int]:
    """How many equations to try in a row, the most first, in rows as equal as can be."""
    balanced = {ceil(count / rows) for rows in range(1, count + 1)}
    tried = sorted((columns for columns in balanced if columns > 1), reverse=True)
    return [columns for columns in tried if ceil(count / columns) / count <= WORTH_PACKING]


def _rows(chains: tuple[Chain, ...], count: int) -> list[tuple[Chain, ...]]:
    return [chains[start : start + count] for start in range(0, len(chains), count)]


def _grid_width(chains: tuple[Chain, ...], count: int) -> float:
    """The width of the equations in columns that align at their first equal signs."""
    total = GAP * (count - 1)
    for place in range(count):
        column = [row[place] for row in _rows(chains, count) if place < len(row)]
        heads = max(chain[0].width for chain in column)
        total += heads + max(width(one_line(chain)) - chain[0].width for chain in column)
    return total


def _grid_lines(chains: tuple[Chain, ...], count: int) -> tuple[str, ...]:
    if count == len(chains):
        return (r" \qquad ".join(one_line(chain) for chain in chains),)
    return tuple(r" &\qquad ".join(map(_aligned, row)) for row in _rows(chains, count))


def _packed(rows: list[tuple[Chain, ...]], room: float) -> tuple[str, ...]:
    """Many rows of columns, which are high: as many of them beside each other as have room. None where few
    lines are saved by it."""
    if len(rows) < MANY or not all(_is_column(chain) for row in rows for chain in row):
        return ()
    head = max(row[0][0].width for row in rows)
    lines: list[list[Chain]] = []
    used = 0.0
    for row in rows:
        needed = sum(GAP + width(one_line(chain)) for chain in row)
        if lines and used + needed <= room:
            lines[-1] += row
            used += needed
        else:
            lines.append([*row])
            used = head + needed - GAP - row[0][0].width
    if len(lines) > WORTH_PACKING * len(rows):
        return ()
    return tuple(r" \qquad ".join((_aligned(first), *map(one_line, others))) for first, *others in lines)


def _aligned(chain: Chain) -> str:
    first, *rest = chain
    tail = " ".join(f"{link.relation} {link.latex}" for link in rest)
    return f"{first.latex} &{tail}"


def _broken(chains: tuple[Chain, ...], room: float) -> Display:
    """Every chain on lines of its own, columns side by side; all lines aligned at the first equal sign."""
    head = max(chain[0].width if len(chain) > 1 else 0.0 for chain in chains)
    lines: list[str] = []
    widest = 0.0
    for row in _beside(chains, room - head):
        first, *others = row
        found = _chain_lines(first, room - head)
        found[-1:] = [r" \qquad ".join((found[-1], *map(one_line, others)))]
        lines += found
        widest = max(widest, *(head + width(line.partition("&")[2]) for line in found))
    if len(lines) == 1:
        return Display((one_line(chains[0]),), widest > room)
    return Display(tuple(lines), widest > room)


def _beside(chains: tuple[Chain, ...], room: float) -> list[list[Chain]]:
    """The chains in rows: one each, and as many columns one after the other as have room."""
    rows: list[list[Chain]] = []
    used = 0.0
    for chain in chains:
        needed = GAP + width(one_line(chain))
        if rows and _is_column(chain) and _is_column(rows[-1][-1]) and used + needed <= room:
            rows[-1].append(chain)
            used += needed
        else:
            rows.append([chain])
            used = needed - GAP - chain[0].width
    return rows


def _is_column(chain: Chain) -> bool:
    """Whether it says what a column of some rows is, which takes as much of the page as a list: of many rows
    by a formula too."""
    breaks = chain[-1].latex.count(r"\\")
    return breaks >= MANY or (breaks >= 2 and len(chain) == 2)


def _chain_lines(chain: Chain, room: float) -> list[str]:
    """The lines of a chain, as many links on a line as fit into `room` right of the alignment."""
    first, *rest = chain
    if not rest:
        return _split_sum(first, "&", room)
    lines: list[str] = []
    used, prefix = 0.0, first.latex + " &"
    for link in rest:
        needed = link.width + RELATION
        if lines and used + needed <= room:
            lines[-1] += f" {link.relation} {link.latex}"
            used += needed
            continue
        lines += _split_sum(link, f"{prefix if not lines else '&'}{link.relation} ", room - RELATION)
        used = needed
    return lines


def _split_sum(link: Link, prefix: str, room: float) -> list[str]:
    """A formula on as many lines as it needs, broken between its terms."""
    first, *rest = pieces(link.latex, room - HANGING)
    lines, used = [prefix + first], width(first)
    for piece in rest:
        needed = width(piece) + SIGN_SPACE
        if used + needed > room:
            lines.append(INDENT + piece)
            used = HANGING + needed
        else:
            lines[-1] += f" {piece}"
            used += needed
    return lines


# -- where a formula may break: before a plus or a minus, outside of braces and tall brackets --------------


def pieces(latex: str, room: float, fractions: bool = True) -> list[str]:
    """The formula in pieces, each but the first beginning with its sign.

    Breaks stand between terms; only a term wider than `room` is broken inside its parentheses too, and a
    fraction of a sum into fractions.
    """
    found = [latex]
    for depth in range(DEEPEST + 1):
        if all(width(piece) <= room for piece in found):
            break
        found = [part for piece in found for part in _fitting(piece, depth, room)]
        if fractions:
            found = [part for piece in found for part in _fractions(piece, room)]
    return found


def _fitting(piece: str, depth: int, room: float) -> list[str]:
    return [piece] if width(piece) <= room else _split(piece, depth)


def _fractions(piece: str, room: float) -> list[str]:
    """A fraction of a wide sum as fractions of the parts that fit, `\\frac{a + b}{d}`, `- \\frac{c}{d}`."""
    sign, mark, rest = piece.partition(r"\frac{")
    above, rest = _group(rest) if mark and sign in ("", *SIGNED) else ("", "")
    below, after = _group(rest[1:])
    if not below or after or width(piece) <= room:
        return [piece]
    parts: list[list[tuple[bool, str]]] = []  # whether each term is subtracted, and the term
    used = room
    for term in _split(above, 0):
        minus, bare = term.startswith("-"), term.lstrip("+- ")
        used += width(bare) + 2 * SIGN_SPACE
        if used > room:
            parts.append([])
            used = width(bare) + 2 * SIGN_SPACE
        parts[-1].append((minus, bare))
    negative = sign.startswith("-")
    first, *others = (_over(part, below, negative) for part in parts)
    return [first if sign == "+ " else first.removeprefix("+ "), *others]


def _over(terms: list[tuple[bool, str]], below: str, negative: bool) -> str:
    """A sum over a denominator, with the sign of its first term in front."""
    (turned, first), *rest = terms
    above = " ".join((first, *(f"{'+-'[minus != turned]} {term}" for minus, term in rest)))
    return rf"{'+-'[turned != negative]} \frac{{{above}}}{{{below}}}"


def _group(latex: str) -> tuple[str, str]:
    """What stands up to the brace that closes, and behind it."""
    depth = 1
    for k, letter in enumerate(latex):
        depth += (letter == "{") - (letter == "}")
        if depth == 0:
            return latex[:k], latex[k + 1 :]
    return "", ""


def _split(latex: str, deepest: int) -> list[str]:
    """Broken before every sign inside at most so many parentheses."""
    found: list[list[str]] = [[]]
    closed = level = 0
    for word in latex.split(" "):
        if word in ("+", "-") and not closed and level <= deepest and found[-1]:
            found.append([])
        found[-1].append(word)
        for fence in FENCE.findall(word):
            if fence in ("(", ")"):
                level += 0 if closed else 1 if fence == "(" else -1
            else:
                closed += 1 if fence.startswith(OPENING) else -1
    return [" ".join(words) for words in found]
