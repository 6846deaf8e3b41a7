"""Chains of equal expressions, as a line of working shows them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from derive.algebra.infix import text
from derive.algebra.rationals import significant_digits
from derive.algebra.readable.writing import opposite
from derive.derivation import Phrase, Step
from derive.expression import (
    Degrees,
    Expr,
    Number,
    Product,
    Quotient,
    Sum,
    children,
    measured,
    multiply,
    walk,
    with_value,
)

SHORT = 5  # digits of a decimal number that is put in


def closing(step: Step, result: Expr, spare: bool = False) -> Step:
    """The step ended by its result with every name replaced, where that says anything new; it may be left out
    too where it is `spare`."""
    if step.chain and step.result == result:
        return step
    return replace(step, chain=(*step.chain, result), spare=(*step.spare, result) if spare else step.spare)


def distinct(chain: Iterable[Expr]) -> tuple[Expr, ...]:
    """A chain without an expression that reads like the one before it."""
    found: list[Expr] = []
    for expr in chain:
        if not found or text(expr) != text(found[-1]):
            found.append(expr)
    return tuple(found)


def piled(expr: Expr) -> bool:
    """Whether a fraction stands in a fraction, which no one would write."""
    quotients = [node for node in walk(expr) if isinstance(node, Quotient)]
    return any(_fractional(part) for each in quotients for side in children(each) for part in walk(side))


def _fractional(expr: Expr) -> bool:
    return isinstance(expr, Quotient) or (
        isinstance(expr, Number) and expr.value.denominator != 1 and not expr.decimal
    )


def constants_together(tree: Expr) -> Expr:
    """30 deg (3 - sqrt(5)) for 60 deg times 1/2 (3 - sqrt(5)); a sign goes into the sum."""
    match tree:
        case Product((Degrees(angle) as turn, Product((Number(size), *rest)))) if rest:
            value, last = angle * size, multiply(*rest)
            if value < 0 and isinstance(last, Sum):
                value, last = -value, opposite(last)
            return with_value(turn, value) * last
    return tree


def with_units(values: Mapping[Expr, Expr], units: Mapping[Expr | Phrase, str]) -> dict[Expr, Expr]:
    """What names stand for as it is put in for them: with its unit, a fraction as a decimal where it ends."""
    return {name: measured(_decimal(value), units.get(name, "")) for name, value in values.items()}


def _decimal(value: Expr) -> Expr:
    short = isinstance(value, Number) and 0 < (significant_digits(value.value) or 0) <= SHORT
    if isinstance(value, Number) and short and value.value.denominator != 1:
        return replace(value, decimal=True)
    return value
