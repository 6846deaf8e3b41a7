"""Decimals stand for all numbers that are rounded to them: how far a published value may be off for that.

In a formula a decimal of three digits or more does, at a point where the sheet asks for numbers any decimal.
Zeros at the end are digits given: 0.0130 has three.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from flint import arb

from derive.algebra.rationals import decimal_places
from derive.answers.budget import parts_of
from derive.answers.points import Point, distance, value_at
from derive.answers.terms import Terms, values
from derive.expression import Degrees, Expr, Number, with_value
from derive.expression import replace as replaced

MOST_PLACES = 40  # of a number that has no end
DIGITS = 3  # of a decimal that counts as rounded
ROUNDED = "to the digits given"
TOO_FEW = "agrees to the digits given, which are few"


def rounded(published: Expr, derived: Expr, terms: Terms) -> str:
    """Whether rounding explains all of the difference: a note, or nothing."""
    compared = 0
    for theirs, ours, most in _with_room(published, derived, terms):
        if distance(theirs, ours, terms.angle) > most * 1.000001:
            return ""
        compared += 1
    return digits_note(published, terms) if compared else ""


def digits_note(published: Expr, terms: Terms) -> str:
    """What can be said of numbers that are right as they are rounded; nothing where none is."""
    given = [digits(node) for node in _decimals(published, terms)]
    if not given:
        return ""
    return TOO_FEW if min(given) < DIGITS and not terms.evaluated else ROUNDED


def _with_room(published: Expr, derived: Expr, terms: Terms) -> Iterator[tuple[arb, arb, float]]:
    """Both values at points, and how far the first may be off because its decimals are rounded."""
    if not _decimals(published, terms):
        return
    for point, theirs, ours in values(published, derived, terms):
        if theirs is not None and ours is not None:
            yield theirs, ours, room(published, theirs, terms, point)


def room(published: Expr, value: arb, terms: Terms, point: Point) -> float:
    """How much the value at a point may change by half a unit in the last place of each decimal."""
    return sum((_moved(published, node, value, terms, point) for node in _decimals(published, terms)), 0.0)


def _decimals(published: Expr, terms: Terms) -> set[Number | Degrees]:
    """The numbers that count as rounded: decimals, also in degrees, of two digits at least in a formula."""
    nodes = {part for part in parts_of(published, terms.own) if isinstance(part, Number | Degrees)}
    least = 1 if terms.evaluated else DIGITS - 1
    return {node for node in nodes if _is_decimal(node) and digits(node) >= least}


def _is_decimal(node: Number | Degrees) -> bool:
    return node.decimal if isinstance(node, Number) else _places(node) > 0


def _moved(published: Expr, decimal: Number | Degrees, value: arb, terms: Terms, point: Point) -> float:
    last = Fraction(1, 2 * 10 ** _places(decimal))
    other: dict[Expr, Expr] = {decimal: with_value(decimal, decimal.value + last)}
    own = {name: replaced(tree, other) for name, tree in terms.own.items()}
    moved = value_at(replaced(published, other), {**terms.published, **own}, point)
    return abs(float((moved - value).mid())) if moved is not None else 0.0


def digits(node: Number | Degrees) -> int:
    """Significant digits of a decimal, zeros at its end included; of 0.00 those after the point."""
    places = _places(node)
    return (
        len(str(abs(node.value.numerator * 10**places // node.value.denominator))) if node.value else places
    )


def _places(node: Number | Degrees) -> int:
    """Digits after the point as typed, or as many as the value has."""
    needed = decimal_places(node.value)
    return max(MOST_PLACES if needed is None else min(needed, MOST_PLACES), node.places)
