"""Trees read as linear forms: a coefficient for each signal, kept unexpanded."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from derive.algebra.infix import text
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.control.exact import common, divided
from derive.control.rational import Polynomial, Rational, times
from derive.control.ratios import PLAIN, Ratio, total
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


def form_of(expr: Expr, signals: Iterable[Symbol], style: Style = PLAIN) -> Form:
    """The linear form of a tree. Raises NotDerivable where a term has no signal, or a product two."""
    found = _read(expr, frozenset(signals), style)
    if UNIT in found:
        raise NotDerivable(f"{text(expr)} has a term without a signal")
    return found


def combined(parts: Iterable[tuple[Ratio, Form]], style: Style = PLAIN) -> Form:
    """The sum of multiples of forms."""
    collected: dict[Symbol, list[Ratio]] = {}
    for scale, form in parts:
        for signal, coefficient in form.items():
            collected.setdefault(signal, []).append(scale * coefficient)
    sums = {signal: total(each, style) for signal, each in collected.items()}
    return {signal: coefficient for signal, coefficient in sums.items() if coefficient}


def one_side(equation: Equation, signals: Iterable[Symbol], style: Style = PLAIN) -> Form:
    """left - right as a form."""
    found = tuple(signals)
    left, right = (form_of(side, found, style) for side in (equation.left, equation.right))
    return combined([(Ratio(), left), (-Ratio(), right)], style)


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


def term(coefficient: Ratio, signal: Expr, style: Style = PLAIN) -> Expr:
    """A coefficient times a signal, as it is written."""
    if coefficient.scale < 0:
        size = term(-coefficient, signal, style)
        return MINUS_ONE * size if isinstance(size, Quotient) else -size
    if coefficient.bottom and not coefficient.top:
        top, bottom = coefficient.parts(style)
        return multiply(top, signal) / bottom
    return multiply(*factors_of(coefficient.expr(style)), signal)


def tree(form: Form, style: Style = PLAIN) -> Expr:
    """A form as it is written."""
    return add(*(term(coefficient, signal, style) for signal, coefficient in form.items()))


def _read(expr: Expr, signals: frozenset[Symbol], style: Style) -> Form:
    inside = free_symbols(expr) & {signal.name for signal in signals}
    if not inside:
        value = Ratio.of(expr, style)
        return {UNIT: value} if value else {}
    match expr:
        case Symbol():
            return {expr: Ratio()}
        case Sum(terms):
            return combined(((Ratio(), _read(part, signals, style)) for part in terms), style)
        case Product(factors):
            return _of_product(factors, signals, style)
        case Quotient(top, bottom) if not free_symbols(bottom) & inside:
            return combined([(Ratio.of(bottom, style).inverse(), _read(top, signals, style))], style)
        case Power(base, exponent) if exponent == multiply():
            return _read(base, signals, style)
    raise NotDerivable(f"{text(expr)} is not linear in {', '.join(sorted(inside))}")


def _of_product(factors: tuple[Expr, ...], signals: frozenset[Symbol], style: Style) -> Form:
    names = {signal.name for signal in signals}
    holders = [factor for factor in factors if free_symbols(factor) & names]
    if len(holders) > 1:
        raise NotDerivable(f"{text(Product(factors))} is a product of signals")
    scale = Ratio.of(multiply(*(factor for factor in factors if factor is not holders[0])), style)
    return combined([(scale, _read(holders[0], signals, style))], style)
