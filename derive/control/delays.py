"""Delays e^(-T s), the fractions that stand for them, and other functions of s.

Baker and Graves-Morris, Pade Approximants, section 1.2.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import factorial
from typing import TypeAlias

from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.control.rational import Polynomial, S, polynomial, written
from derive.control.ratios import PLAIN
from derive.expression import (
    Call,
    Expr,
    Number,
    Power,
    Quotient,
    Symbol,
    free_symbols,
    is_negative,
    rebuild,
    walk,
)

Function: TypeAlias = Call | Power


@dataclass(frozen=True, slots=True)
class Delay:
    """e^(-T s) as it was typed, its T, and the fraction of order n in its place."""

    typed: Expr
    time: Expr
    order: int

    @property
    def fraction(self) -> Quotient:
        """N(s)/D(s) with D(s) = N(-s): (2 - T s)/(2 + T s), (12 - 6 T s + T^2 s^2)/(...), ..."""
        style = _style(self.typed)
        return Quotient(written(self._side(-1), style), written(self._side(1), style))

    def agrees(self) -> bool:
        """Whether D(s) e^(-T s) begins with N(s) and has no further terms up to s^(2 n)."""
        top, bottom = (self._ascending(side) for side in (self.fraction.numerator, self.fraction.denominator))
        n, T = self.order, normal(self.time)
        series = [(-T) ** k / factorial(k) for k in range(2 * n + 1)]
        for k, term in enumerate([*top, *[Scalar.of(0)] * n]):
            product = sum((bottom[j] * series[k - j] for j in range(min(k, n) + 1)), Scalar.of(0))
            if product != term:
                return False
        return True

    def _side(self, sign: int) -> Polynomial:
        """The sum of (2n - k)!/(k! (n - k)!) (sign T s)^k, highest power first."""
        n, T = self.order, normal(self.time)
        terms = [
            T**k * (sign**k * factorial(2 * n - k) // (factorial(k) * factorial(n - k))) for k in range(n + 1)
        ]
        return tuple(reversed(terms))

    def _ascending(self, side: Expr) -> list[Scalar]:
        return list(reversed(polynomial(normal(side))))


def delay_of(node: Expr) -> Expr | None:
    """T of e^(-T s); None of anything else."""
    match node:
        case Call("exp", (exponent,)) | Power(Symbol("e"), exponent) if S.name in free_symbols(exponent):
            time = readable(-normal(exponent) / normal(S), _style(node))
            return None if is_negative(time) or S.name in free_symbols(time) else time
    return None


def found_in(expr: Expr, order: int) -> tuple[Delay, ...]:
    """The delays of a tree, each once, with fractions of this order."""
    found = {node: time for node in walk(expr) if (time := delay_of(node)) is not None}
    return tuple(Delay(node, time, order) for node, time in found.items())


def replaced(expr: Expr, delays: tuple[Delay, ...]) -> Expr:
    """A tree with the fractions in their place."""
    known = {delay.typed: delay.fraction for delay in delays}

    def put(part: Expr) -> Expr:
        return known[part] if part in known else rebuild(part, put)

    return put(expr)


# -- whatever is no ratio of polynomials --------------------------------------------------------------


def transcendental(expr: Expr) -> Iterator[Function]:
    """Functions of s, and its powers that are not whole, the outer ones first."""
    for node in walk(expr):
        if isinstance(node, Call | Power) and _is_transcendental(node):
            yield node


def _is_transcendental(node: Function) -> bool:
    if isinstance(node, Call):
        return any(S.name in free_symbols(argument) for argument in node.arguments)
    whole = isinstance(node.exponent, Number) and node.exponent.value.denominator == 1
    return S.name in free_symbols(node.exponent) or (not whole and S.name in free_symbols(node.base))


def _style(expr: Expr) -> Style:
    """Decimals where they were typed."""
    decimal = any(isinstance(node, Number) and node.decimal for node in walk(expr))
    return Style(decimals=True) if decimal else PLAIN
