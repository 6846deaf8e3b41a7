"""Equations of motion as a person writes them: accelerations first, then products of rates, then the rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import lcm, prod

from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomials import holds
from derive.expression import (
    MINUS_ONE,
    ZERO,
    Call,
    Expr,
    Number,
    Power,
    Product,
    Sum,
    Symbol,
    add,
    factors_of,
    is_negative,
    multiply,
    negate,
    number,
    terms_of,
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
        term = _times(problem.readable(factor), rates)
        terms += term.terms if isinstance(term, Sum) else (term,)
    return add(*terms)


def _power(name: str, power: int) -> Expr:
    return Symbol(name) if power == 1 else Symbol(name) ** number(power)


def _times(value: Expr, factors: Sequence[Expr]) -> Expr:
    """Numbers gathered in front, then letters and sums, the rates, and sines and cosines last."""
    parts = factors_of(value)
    numbers = [part for part in parts if isinstance(part, Number)]
    whole = prod((part.value for part in numbers), start=Fraction(1))
    decimal = any(part.decimal for part in numbers)
    front = [part for part in parts if not isinstance(part, Number) and not _is_trig(part)]
    back = [part for part in parts if _is_trig(part)]
    return multiply(Number(whole, decimal), *front, *factors, *back) if value != ZERO else ZERO


def _is_trig(expr: Expr) -> bool:
    inner = expr.base if isinstance(expr, Power) else expr
    return isinstance(inner, Call) and inner.function in ("cos", "sin")


def written_motion(value: Scalar, system: LagrangianSystem, problem: Problem) -> Expr:
    """What the rates stand in without a fraction, written beside the quotient of the rest."""
    if value.denominator is None or holds(Scalar(value.ring, value.denominator), system.rates):
        return written_fraction(value, problem)
    whole = [(powers, part) for powers, part in by_rates(value, system.rates) if part.denominator is None]
    if not whole or len(whole) == len(by_rates(value, system.rates)):
        return written_fraction(value, problem)
    apart = sum((part * _monomial(powers) for powers, part in whole), Scalar.of(0))
    return add(
        *terms_of(written_fraction(value - apart, problem)), *terms_of(written_side(apart, system, problem))
    )


def _monomial(powers: Mapping[str, int]) -> Scalar:
    return prod((Scalar.symbol(name) ** power for name, power in powers.items()), start=Scalar.of(1))


def written_fraction(value: Scalar, problem: Problem) -> Expr:
    """A quotient with no minus sign below, and one in front of it rather than many above."""
    if value.denominator is None:
        return problem.readable(value)
    whole = lcm(*(int(k.q) for k in value.numerator.coeffs()))
    top = Scalar(value.ring, value.numerator * whole)
    bottom = Scalar(value.ring, value.denominator * whole)
    below = problem.readable(bottom)
    if _leads_with_minus(below):
        top, below = -top, problem.readable(-bottom)
    above = problem.readable(top)
    match above:
        case Product((Number(lead), *rest)) if lead == -1:
            return MINUS_ONE * (multiply(*rest) / below)
        case Sum(terms) if all(map(is_negative, terms)):
            return MINUS_ONE * (Sum(tuple(map(negate, terms))) / below)
    return problem.readable(value) if isinstance(below, Number) else above / below


def _leads_with_minus(expr: Expr) -> bool:
    return is_negative(expr.terms[0]) if isinstance(expr, Sum) else is_negative(expr)


def difference(left: Expr, right: Expr) -> Expr:
    """left - right, nothing where the right is zero."""
    return left if right == ZERO else left + -right
