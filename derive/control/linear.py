"""Trees read as linear forms: a coefficient for each signal, kept unexpanded."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from derive.algebra.infix import text
from derive.algebra.scalar import Scalar
from derive.control.exact import common, divided
from derive.control.rational import Polynomial, Rational, times
from derive.control.ratios import Ratio, total
from derive.control.system import Equation
from derive.errors import NotDerivable
from derive.expression import (
    MINUS_ONE,
    Expr,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    add,
    factors_of,
    free_symbols,
    multiply,
)

Form: TypeAlias = Mapping[Symbol, Ratio]  # signal -> its coefficient; zero coefficients left out
UNIT = Symbol("1")  # stands for the part without a signal


def form_of(expr: Expr, signals: Iterable[Symbol], decimals: bool = False) -> Form:
    """The linear form of a tree. Raises NotDerivable where a term has no signal, or a product two."""
    found = _read(expr, frozenset(signals), decimals)
    if UNIT in found:
        raise NotDerivable(f"{text(expr)} has a term without a signal")
    return found


def combined(parts: Iterable[tuple[Ratio, Form]], decimals: bool = False) -> Form:
    """The sum of multiples of forms."""
    collected: dict[Symbol, list[Ratio]] = {}
    for scale, form in parts:
        for signal, coefficient in form.items():
            collected.setdefault(signal, []).append(scale * coefficient)
    sums = {signal: total(each, decimals) for signal, each in collected.items()}
    return {signal: coefficient for signal, coefficient in sums.items() if coefficient}


def one_side(equation: Equation, signals: Iterable[Symbol], decimals: bool = False) -> Form:
    """left - right as a form."""
    found = tuple(signals)
    left, right = (form_of(side, found, decimals) for side in (equation.left, equation.right))
    return combined([(Ratio(), left), (-Ratio(), right)], decimals)


def cleared(form: Form) -> dict[Symbol, Polynomial]:
    """The coefficients of an equation multiplied by the least that leaves no s below."""
    fractions = {signal: Rational.of(ratio) for signal, ratio in form.items()}
    below: Polynomial = (Scalar.of(1),)
    for fraction in fractions.values():
        if len(fraction.den) > 1:
            below = times(below, divided(fraction.den, common(fraction.den, below))[0])
    return {signal: _over(times(below, each.num), each.den) for signal, each in fractions.items()}


def _over(top: Polynomial, bottom: Polynomial) -> Polynomial:
    return divided(top, bottom)[0]


def term(coefficient: Ratio, signal: Expr, decimals: bool = False) -> Expr:
    """A coefficient times a signal, as it is written."""
    if coefficient.scale < 0:
        size = term(-coefficient, signal, decimals)
        return MINUS_ONE * size if isinstance(size, Quotient) else -size
    if coefficient.bottom and not coefficient.top:
        top, bottom = coefficient.parts(decimals)
        return multiply(top, signal) / bottom
    return multiply(*factors_of(coefficient.expr(decimals)), signal)


def tree(form: Form, decimals: bool = False) -> Expr:
    """A form as it is written."""
    return add(*(term(coefficient, signal, decimals) for signal, coefficient in form.items()))


def _read(expr: Expr, signals: frozenset[Symbol], decimals: bool) -> Form:
    inside = free_symbols(expr) & {signal.name for signal in signals}
    if not inside:
        value = Ratio.of(expr, decimals)
        return {UNIT: value} if value else {}
    match expr:
        case Symbol():
            return {expr: Ratio()}
        case Sum(terms):
            return combined(((Ratio(), _read(part, signals, decimals)) for part in terms), decimals)
        case Product(factors):
            return _of_product(factors, signals, decimals)
        case Quotient(top, bottom) if not free_symbols(bottom) & inside:
            return combined([(Ratio.of(bottom, decimals).inverse(), _read(top, signals, decimals))], decimals)
        case Power(base, exponent) if exponent == multiply():
            return _read(base, signals, decimals)
    raise NotDerivable(f"{text(expr)} is not linear in {', '.join(sorted(inside))}")


def _of_product(factors: tuple[Expr, ...], signals: frozenset[Symbol], decimals: bool) -> Form:
    names = {signal.name for signal in signals}
    holders = [factor for factor in factors if free_symbols(factor) & names]
    if len(holders) > 1:
        raise NotDerivable(f"{text(Product(factors))} is a product of signals")
    scale = Ratio.of(multiply(*(factor for factor in factors if factor is not holders[0])), decimals)
    return combined([(scale, _read(holders[0], signals, decimals))], decimals)
