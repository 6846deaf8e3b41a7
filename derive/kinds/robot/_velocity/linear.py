"""Sums that are linear in the components of a vector, with one term for each component."""

from __future__ import annotations

from collections.abc import Iterable

from derive.algebra.readable.writing import opposite
from derive.algebra.scalar import Scalar
from derive.expression import Expr, Symbol, add, is_negative, multiply
from derive.kinds.problem import Problem
from derive.kinds.robot._determinants import mostly_negative


def combined(pairs: Iterable[tuple[Expr, Expr]]) -> Expr:
    """The sum of coefficients times components, in their order; a sign that all of them have in front."""
    terms = [_term(coefficient, component) for coefficient, component in pairs]
    if len(terms) > 1 and all(map(is_negative, terms)):
        return -add(*(-term for term in terms))
    return add(*terms)


def collected(problem: Problem, value: Scalar, components: Iterable[Symbol]) -> Expr:
    """A value that is linear in the components."""
    pairs = ((value.diff(each.name), each) for each in components)
    return combined((problem.readable(part), each) for part, each in pairs if part)


def _term(coefficient: Expr, component: Expr) -> Expr:
    if mostly_negative(coefficient):
        return -multiply(opposite(coefficient), component)
    return multiply(coefficient, component)
