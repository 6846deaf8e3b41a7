"""When a branch is the one: its kind says it in plain words and formulas, which are typeset here."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from operator import add

from derive.algebra.formulas.grammar import parse
from derive.algebra.formulas.units import ANY
from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.errors import FormulaError
from derive.expression import PI, Expr, Quotient, walk
from derive.render.latex import Printer

CLAUSES = re.compile(r"(, (?:where )?|; |: | and | or | if | where )")
RELATION = re.compile(r" (<=|>=|!=|<|>|=) ")
SIGNS = {"<=": r"\leq", ">=": r"\geq", "!=": r"\neq"}


def condition(
    words: str,
    names: Iterable[str],
    printer: Printer,
    plain: Callable[[str], str],
    style: Style | None = None,
) -> str:
    """`elbow up, theta2 > 0` with its relation as inline mathematics; of other words only `names` are.

    `plain` makes text safe for the format; decimals and fixed angles are written in the author's `style`.
    """
    known = frozenset(names)
    return "".join(
        part if place % 2 else _clause(part, known, printer, plain, style or Style())
        for place, part in enumerate(CLAUSES.split(words))
    )


def _clause(
    clause: str, names: frozenset[str], printer: Printer, plain: Callable[[str], str], style: Style
) -> str:
    sides = RELATION.split(clause)
    if len(sides) > 1:
        try:
            written = [printer.write(_in_style(_tree(side), style)) for side in sides[::2]]
        except FormulaError:
            return _words(clause, names, printer, plain)
        signs = [f" {SIGNS.get(sign, sign)} " for sign in sides[1::2]]
        return f"${written[0]}{''.join(map(add, signs, written[1:]))}$"
    return _words(clause, names, printer, plain)


def _in_style(tree: Expr, style: Style) -> Expr:
    """Written anew where it holds what this style writes otherwise."""
    nodes = [*walk(tree)]
    fixed = style.degrees and PI in nodes
    fractions = style.decimals and any(isinstance(node, Quotient) for node in nodes)
    return readable(normal(tree), style) if fixed or fractions else tree


def _tree(side: str) -> Expr:
    return parse(side, dimension=ANY)


def _words(text: str, names: frozenset[str], printer: Printer, plain: Callable[[str], str]) -> str:
    """Sums and differences of the names are mathematics, the rest is text."""
    if not names:
        return plain(text)
    one = "|".join(sorted(map(re.escape, names), key=len, reverse=True))
    terms = re.split(rf"((?<!\w)(?:{one})(?: [-+] (?:{one}))*(?!\w))", text)
    return "".join(
        f"${printer.write(_tree(part))}$" if place % 2 else plain(part) for place, part in enumerate(terms)
    )
