"""Equations of motion as a person writes them: accelerations first, then products of rates, then the rest."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import prod

from derive.algebra.scalar import Scalar
from derive.expression import ZERO, Expr, Number, Power, Product, Symbol, add, multiply, negate, number
from derive.kinds.problem import Problem
from derive.mechanics.lagrangian import LagrangianSystem, by_rates, without


def written_side(side: Scalar, system: LagrangianSystem, problem: Problem) -> Expr:
    """A sum over accelerations, products of rates, and what is left, each with what multiplies it."""
    terms = [
        _times(problem.readable(factor), (Symbol(name),))
        for name in system.accelerations
        if (factor := side.diff(name))
    ]
    rest = without(side, system.accelerations)
    for powers, factor in by_rates(rest, system.rates):
        rates = tuple(_power(name, power) for name, power in powers.items())
        terms.append(_times(problem.readable(factor), rates))
    return add(*terms)




def _power(name: str, power: int) -> Expr:
    return Symbol(name) if power == 1 else Power(Symbol(name), number(power))


def _times(value: Expr, factors: Sequence[Expr]) -> Expr:
    """Numbers gathered in front, and a sum in parentheses."""
    parts = [part for expr in (value, *factors) for part in _factors(expr)]
    numbers = [part for part in parts if isinstance(part, Number)]
    rest = [part for part in parts if not isinstance(part, Number)]
    whole = prod((part.value for part in numbers), start=Fraction(1))
    decimal = any(part.decimal for part in numbers)
    return multiply(Number(whole, decimal), *rest) if value != ZERO else ZERO


def _factors(expr: Expr) -> tuple[Expr, ...]:
    return expr.factors if isinstance(expr, Product) else (expr,)


def difference(left: Expr, right: Expr) -> Expr:
    """left - right, nothing where the right is zero."""
    return left if right == ZERO else add(left, negate(right))
