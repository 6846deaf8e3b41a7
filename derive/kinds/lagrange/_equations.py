"""Equations of motion as a person writes them: accelerations first, then products of rates, then the rest."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import prod

from derive.algebra.polynomials import holds
from derive.algebra.scalar import Scalar
from derive.expression import (
    MINUS_ONE,
    ZERO,
    Call,
    Expr,
    Number,
    Power,
    Product,
    Quotient,
    Symbol,
    add,
    multiply,
    negate,
    number,
    walk,
)
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
    if rest.denominator is not None and holds(Scalar(rest.ring, rest.denominator), system.rates):
        return add(*terms, problem.readable(rest))  # a relativistic energy, say: no sum over rates
    for powers, factor in by_rates(rest, system.rates):
        rates = tuple(_power(name, power) for name, power in powers.items())
        terms.append(_times(problem.readable(factor), rates))
    return add(*terms)


def _power(name: str, power: int) -> Expr:
    return Symbol(name) if power == 1 else Power(Symbol(name), number(power))


def _times(value: Expr, factors: Sequence[Expr]) -> Expr:
    """Numbers gathered in front, then letters and sums, the rates, and sines and cosines last."""
    parts = _factors(value)
    numbers = [part for part in parts if isinstance(part, Number)]
    whole = prod((part.value for part in numbers), start=Fraction(1))
    decimal = any(part.decimal for part in numbers)
    front = [part for part in parts if not isinstance(part, Number) and not _is_trig(part)]
    back = [part for part in parts if _is_trig(part)]
    return multiply(Number(whole, decimal), *front, *factors, *back) if value != ZERO else ZERO


def _is_trig(expr: Expr) -> bool:
    inner = expr.base if isinstance(expr, Power) else expr
    return isinstance(inner, Call) and inner.function in ("cos", "sin")


def _factors(expr: Expr) -> tuple[Expr, ...]:
    return expr.factors if isinstance(expr, Product) else (expr,)


def written_fraction(value: Scalar, problem: Problem) -> Expr:
    """A quotient with as few minus signs as it can have, one in front of it rather than above."""
    if value.denominator is None:
        return problem.readable(value)
    opposite = Scalar(value.ring, -value.numerator), Scalar(value.ring, -value.denominator)
    forms = [problem.readable(value), Quotient(*map(problem.readable, opposite))]
    chosen = min(forms, key=_signs)
    match chosen:
        case Quotient(Product((Number(lead), *rest)), bottom) if lead == -1:
            return Product((MINUS_ONE, Quotient(multiply(*rest), bottom)))
    return chosen


def _signs(expr: Expr) -> int:
    return sum(isinstance(node, Number) and node.value < 0 for node in walk(expr))


def difference(left: Expr, right: Expr) -> Expr:
    """left - right, nothing where the right is zero."""
    return left if right == ZERO else add(left, negate(right))
