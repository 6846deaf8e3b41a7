"""What a listener is told of a formula of a page, by what is printed and what the trees know of its names."""

from __future__ import annotations

from collections.abc import Iterator

from derive.expression import Expr, Indexed, Symbol, walk
from derive.render.formula.boxes import Box
from derive.render.formula.spoken import spoken
from derive.render.formula.tex import boxes, boxes_of_lines
from derive.render.latex import Printer
from derive.render.layout import Display


def aloud(formula: Display) -> str:
    """A formula in words."""
    names = frozenset(_upper(formula)) if formula.chains else None
    return spoken(boxes_of_lines(formula.lines), names)


def _upper(formula: Display) -> Iterator[Box]:
    """The names in a formula that have an upper index, as they are printed."""
    printer = Printer(formula.notation)
    trees = (link.tree for chain in formula.chains for link in chain if link.tree is not None)
    for node in {node for tree in trees for node in walk(tree) if _is_upper(node)}:
        yield boxes(printer.write(node))


def _is_upper(node: Expr) -> bool:
    return (isinstance(node, Symbol) and "^" in node.name) or (isinstance(node, Indexed) and bool(node.upper))
