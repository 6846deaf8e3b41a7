"""Distances that go from a smallest to a largest one, as trees, and what is decided of their order."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import completed, number
from derive.algebra.signs import sign_of
from derive.errors import NotDerivable
from derive.expression import PI, ZERO, Call, Expr, add, free_symbols, multiply, sqrt
from derive.expression import number as number_tree
from derive.kinds.problem import Problem

CLOSE = 1e-12


@dataclass(frozen=True, slots=True)
class Span:
    """From `low` to `high`; None is without end."""

    low: Expr | None
    high: Expr | None


@dataclass(frozen=True, slots=True)
class Order:
    """Signs and simple forms of trees whose names are positive lengths."""

    problem: Problem

    def sign(self, tree: Expr) -> int | None:
        """1, 0, -1; None where it is not decided."""
        if not free_symbols(tree) - self.problem.where.keys():
            size = number(tree, completed({}, self.problem.where))
            return 0 if abs(size) < CLOSE else 1 if size > 0 else -1
        try:
            return sign_of(normal(tree, self.problem.names), self.problem.symbols)
        except NotDerivable:
            return None

    def simple(self, tree: Expr) -> Expr:
        """As it is read best; itself where there is no normal form of it."""
        try:
            return self.problem.readable(normal(tree))
        except NotDerivable:
            return tree

    def largest(self, candidates: Iterable[Expr]) -> Expr:
        """The largest of zero and these."""
        left: list[Expr] = []
        for each in map(self.simple, candidates):
            if self.sign(each) not in (0, -1) and each not in left:
                left.append(each)
        left = [each for each in left if not self._is_passed(each, left)]
        if len(left) == 1 and self.sign(left[0]) == 1:
            return left[0]
        return Call("max", (ZERO, *left)) if left else ZERO

    def _is_passed(self, tree: Expr, others: list[Expr]) -> bool:
        return any(self.sign(other - tree) == 1 for other in others if other != tree)

    def size(self, span: Span) -> Span:
        """Of what goes from one side of zero to the other, how far away it is. Raises NotDerivable where it
        is not known whether it passes zero."""
        low, high = span.low, span.high
        below = -1 if low is None else self.sign(low)
        above = 1 if high is None else self.sign(high)
        if below is None or above is None:
            raise NotDerivable("whether a slide passes the axis is not decided; give its range in numbers")
        if below >= 0:
            return span
        if above <= 0:
            return Span(self._negative(high), self._negative(low))
        if low is None or high is None:
            return Span(ZERO, None)
        further = self.sign(add(high, low))
        if further is None:
            raise NotDerivable("which end of a range is further away is not decided; give it in numbers")
        return Span(ZERO, high if further >= 0 else self._negative(low))

    def _negative(self, tree: Expr | None) -> Expr | None:
        return None if tree is None else self.simple(-tree)

    def beside(self, span: Span, aside: Expr) -> Span:
        """The same distances to a point that lies to the side of the line."""
        if aside == ZERO:
            return span

        def away(tree: Expr | None) -> Expr | None:
            return None if tree is None else aside if tree == ZERO else sqrt(tree**2 + aside**2)

        return Span(away(span.low), away(span.high))

    def around(self, way: Span, rest: Span) -> Span:
        """How far the end of a `rest` that turns freely about the end of a `way` is from the start."""
        if rest == Span(ZERO, ZERO):
            return way
        high = None if way.high is None or rest.high is None else self.simple(add(way.high, rest.high))
        holes = [
            long - short
            for long, short in ((way.low, rest.high), (rest.low, way.high))
            if long is not None and short is not None
        ]
        return Span(self.largest(holes), high)

    def turn(self, low: Expr, high: Expr) -> Expr:
        """An angle between two, in radians."""
        share = normal((high - low) / PI, self.problem.names).constant
        if share is not None:
            return multiply(number_tree(share), PI) if share != 1 else PI
        return self.simple(high - low)
