"""Trees as the links of what is displayed, with the sign that stands before each."""

from __future__ import annotations

from derive.expression import (
    Expr,
    Relation,
)
from derive.render.latex import Printer, is_approximate
from derive.render.layout import Chain, Link
from derive.render.phrases import sign_of


def chain_links(chain: tuple[Expr, ...], printer: Printer) -> Chain:
    """The links of a chain, with the sign that stands before each."""
    links: list[Link] = []
    rounded = False
    for expr in chain:
        now = is_approximate(expr)
        links.append(Link(r"\approx" if now or rounded else "=", printer.write(expr), expr))
        rounded = now
    return tuple(links)


def signed_links(relation: Relation, printer: Printer) -> Chain:
    """The sides of a relation, with the sign that stands before each."""
    left = relation.left
    last = Link(sign_of(relation, printer.notation.digits), printer.write(relation.right), relation.right)
    if isinstance(left, Relation):
        return (*signed_links(left, printer), last)
    return Link("=", printer.write(left), left), last
