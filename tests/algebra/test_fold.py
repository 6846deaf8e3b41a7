"""One walk, many meanings: a new domain is what its nodes become, and what it does not define is refused."""

from __future__ import annotations

import pytest

from derive.algebra.fold import Domain, fold
from derive.algebra.formulas.grammar import parse
from derive.errors import NotDerivable
from derive.expression import Approximate, Derivative, Expr, Indexed, Matrix, Symbol


class Depth(Domain[int]):
    """How deep a tree is: a domain that has nothing to do with numbers."""

    def number(self, value: object) -> int:
        return 1

    def symbol(self, name: str) -> int:
        return 1

    def sum(self, terms: list[int]) -> int:
        return 1 + max(terms)

    product = sum

    def quotient(self, top: int, bottom: int) -> int:
        return self.sum([top, bottom])

    power = quotient

    def call(self, function: str, arguments: list[int]) -> int:
        return self.sum(arguments)


def test_a_domain_gives_every_node_its_meaning() -> None:
    assert fold(parse("(a + 2*b^2)/sin(x) - 1"), Depth()) == 6


@pytest.mark.parametrize(
    "expr",
    [
        parse("30 deg"), Approximate(0.5), Matrix(((Symbol("a"),),)), Indexed("R", (Symbol("a"),)),
        Derivative(Symbol("a"), Symbol("b")),
    ],
)  # fmt: skip
def test_what_a_domain_does_not_define_is_refused(expr: Expr) -> None:
    with pytest.raises(NotDerivable):
        fold(expr, Depth())
