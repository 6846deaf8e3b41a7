"""What q holds, said among the conventions of a sheet: formulas have q, and its pages theta_1 and d_3."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from derive.expression import Expr, Indexed, Number, Symbol, column, walk
from derive.render.latex import Printer
from derive.render.layout import Link, one_line
from derive.render.notation import Notation
from derive.render.printed import Printed
from derive.render.skin import environment

Q = re.compile(r"q(_[ijk]+)?(_?d?dot)?")  # q, its rates, and any of its entries
RATE = re.compile(r"q_?d?dot")
POINT = re.compile(r"q_\d+")  # where points are called so, q is one of them
WORDS = "words/_coordinates.j2"


def speaks_of_q(printed: Iterable[Printed]) -> bool:
    """Whether a formula has the vector q, or an entry of it in general."""
    trees = (link.tree for each in printed for chain in each.chains for link in chain if link.tree)
    found = {name for tree in trees for node in walk(tree) if (name := _name(node))}
    q = RATE if any(map(POINT.fullmatch, found)) else Q
    return any(map(q.fullmatch, found))


def _name(node: Expr) -> str:
    match node:
        case Symbol(name):
            return name
        case Indexed(base, (Symbol(index),)):
            return f"{base}_{index}"
        case Indexed(base, (Number(index),)):
            return f"{base}_{index}"
    return ""


def coordinates(arms: Mapping[tuple[str, ...], Notation], printed: list[Printed]) -> str:
    """The sentence for the first of these arms, "" where there is none; its formula is added to `printed`."""
    if not arms:
        return ""
    variables, notation = next(iter(arms.items()))
    printer = Printer(notation, in_line=True)
    trees = Symbol("q"), column(map(Symbol, variables))
    chain = tuple(Link("=", printer.write(tree), tree) for tree in trees)
    printed.append(Printed.inline(one_line(chain), chain, notation))
    q = f"${one_line(chain)}$"
    words = environment().get_template(WORDS)
    return words.render(q=q, several=len(variables) > 1, others=len(arms) > 1).strip()
