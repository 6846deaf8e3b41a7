"""An arm with the ranges of its joints: how far a slide goes, and how far a joint turns."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from derive.algebra.formulas.with_units import measured
from derive.algebra.numbers.floats import completed, number
from derive.algebra.scalar import Scalar
from derive.derivation import Said
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Number, Symbol, between, free_symbols, replace, walk
from derive.kinds.problem import Problem
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.spans import Order, Span
from derive.mechanics.chain import Chain
from derive.mechanics.slides import Stretch

R_MIN, R_MAX = Symbol("r_min"), Symbol("r_max")
WHOLE, NEARLY = 2 * math.pi, 1e-9
Limits = Mapping[str, tuple[Expr, Expr]]


@dataclass(frozen=True, slots=True)
class Ranged:
    """A point of an arm, whose joints have limits."""

    problem: Problem
    chain: Chain
    point: Tracked

    @property
    def order(self) -> Order:
        return Order(self.problem)

    def span(self, row: int) -> Span:
        limits: Limits = self.problem.subject.ranges
        return Span(*limits.get(self.chain.joint(row).variable, (None, None)))

    def stride(self, stretch: Stretch) -> Span:
        """From where to where the slide goes, counted from the axis."""
        assert stretch.stride is not None
        span, tree = self.span(stretch.row), self.problem.readable(stretch.stride)
        name = Symbol(self.chain.joint(stretch.row).variable)

        def at(end: Expr | None) -> Expr | None:
            return None if end is None else self.order.simple(replace(tree, {name: end}))

        return Span(at(span.low), at(span.high))

    def typed(self, length: Scalar) -> Expr:
        """A length with its unit, where it is a number."""
        tree = self.problem.readable(length)
        return tree if free_symbols(tree) else measured(tree, unit_of_lengths(self.problem))

    def goes_outward(self, stretch: Stretch) -> bool:
        """Whether a slide does not pass the axis."""
        low = self.stride(stretch).low
        return low is not None and self.order.sign(low) in (0, 1)

    def way(self, stretch: Stretch) -> Span:
        """How far it is from one axis to the next."""
        aside = self.problem.readable(stretch.aside)
        if stretch.stride is None:
            return Span(aside, aside)
        return self.order.beside(self.order.size(self.stride(stretch)), aside)

    def turn(self, row: int) -> tuple[Expr, Expr] | None:
        """The limits of a joint that does not make a whole turn. Raises NotDerivable where that is not
        known."""
        limits: Limits = self.problem.subject.ranges
        span = limits.get(self.chain.joint(row).variable)
        if span is None:
            return None
        try:
            angle = number(span[1] - span[0], completed({}, self.problem.where))
        except KeyError as error:
            raise NotDerivable("ranges of joints that turn are honoured in numbers") from error
        return None if angle >= WHOLE - NEARLY else span

    def simple_end(
        self, chain: tuple[Expr, ...], distance: Span, spans: Sequence[Span] = ()
    ) -> tuple[Expr, ...]:
        """With the distances put in, where that tells more than the formula itself. Where the length of one
        of the `spans` is a number that no decimal shows, as that of one metre, all stand in numbers."""
        known: dict[Expr, Expr] = {R_MIN: distance.low or ZERO, R_MAX: distance.high or ZERO}
        filled = replace(chain[-1], known)
        simple = self.order.simple(filled)
        typed = any(not free_symbols(within_brackets(each)) for each in spans)
        if typed and not any(isinstance(node, Number) and node.decimal for node in walk(chain[-1])):
            return (filled, simple) if filled != simple else (simple,)
        told = filled == chain[-1] and 0 < _letters(filled) <= _letters(simple)
        return chain if told else (*chain, simple)


def _letters(tree: Expr) -> int:
    """How many names stand in it."""
    return sum(isinstance(node, Symbol) for node in walk(tree))


def within_brackets(span: Span) -> Expr:
    return (span.high or ZERO) - (span.low or ZERO)


def distances(order: Order, distance: Span) -> Iterator[tuple[str, tuple[Expr, ...]]]:
    for name, tree in (("r_max", distance.high), ("r_min", distance.low)):
        if tree is not None:
            simple = order.simple(tree)
            yield name, (tree,) if tree == simple else (tree, simple)


def ranges_of(problem: Problem, rows: Sequence[int]) -> tuple[Said, ...]:
    """low <= variable <= high of the rows that have limits."""
    links = [problem.subject.links[i - 1] for i in rows]
    return tuple(
        between(measured(link.range[0]), Symbol(link.variable), measured(link.range[1]))
        for link in links
        if link.range
    )
