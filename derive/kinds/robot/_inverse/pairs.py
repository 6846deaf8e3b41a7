"""Two equations in one angle, written out: no choice is left, unless signs were chosen before."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from derive.algebra.normal import trig_of
from derive.algebra.scalar import Scalar
from derive.expression import (
    ZERO,
    Degrees,
    Expr,
    Number,
    Quotient,
    Symbol,
    add,
    atan2,
    cos,
    multiply,
    negate,
    number,
    sin,
    subtract,
)
from derive.kinds.robot._inverse.board import Board, Draft
from derive.kinds.robot._inverse.moves import Move, Option
from derive.kinds.robot._inverse.trees import minus, over, times, unsigned
from derive.mechanics.inverse.trigonometric import Row, TwoEquations

SIGNS = (1, -1)
Sides = tuple[Expr, Expr, Expr]  # a, b, c of a cos q + b sin q = c
Answer = tuple[tuple[Option, ...], Mapping[str, Any]]


def write(board: Board, found: TwoEquations) -> Move:
    """The two equations, and the angle."""
    draft, angle, found = Draft(board), board.angle(found.angle), plainest(board, found)
    first, second = (_collected(draft, row, angle) for row in (found.first, found.second))
    if found.kind == "direction":
        options, more = _direction(board, found, first, second)
    elif found.kind == "difference":
        options, more = _difference(first, second)
    else:
        options, more = _cramer(draft, found, first, second)
    return draft.move(found.angle, angle, options, {"method": found.kind, "by_name": False, **more})


def plainest(board: Board, found: TwoEquations) -> TwoEquations:
    """With as few minus signs in the known sides and coefficients as can be."""
    one, two = found.first, found.second
    alike = found.kind == "difference"
    if alike:
        pairs = [(one, two), (one.negated(), two.negated()), (two, one.negated()), (two.negated(), one)]
    else:
        pairs = [(a, b) for a in (one, one.negated()) for b in (two, two.negated())]

    def minuses(pair: tuple[Row, Row]) -> int:
        (a, c1), (b, c2) = (pair[0].a, pair[0].c), (pair[1].a if alike else pair[1].b, pair[1].c)
        return board.minuses(c1, c2, a, b)

    first, second = min(pairs, key=minuses)
    return replace(found, first=first, second=second)


def _collected(draft: Draft, row: Row, angle: Expr) -> Sides:
    """(a, b, c) as trees, with a step c = a cos q + b sin q."""
    c, a, b = (draft.short(value) for value in (row.c, row.a, row.b))
    draft.equation(c, add(times(a, cos(angle)), times(b, sin(angle))))
    return a, b, c


def _direction(board: Board, found: TwoEquations, first: Sides, second: Sides) -> Answer:
    """cos = c1 / a, sin = c2 / b."""
    (a, _, c1), (_, b, c2) = first, second
    ratio = (found.second.b / found.first.a).constant
    sign, earlier = board.sign_of(found.first.a) if ratio is not None else (0, ())
    if ratio is None or not sign:
        value = atan2(over(c2, b), over(c1, a))
        return (Option(value),), {"unless": board.may_vanish(a, b)}
    plain = _given_angle(board, found)
    if plain is not None:
        return (Option(plain),), {"unless": [], "by_name": True}
    sine = c2 if abs(ratio) == 1 else Quotient(c2, number(abs(ratio)))
    options = _turned(sine if ratio > 0 else minus(sine), c1, sign, earlier)
    if not earlier:  # a factor of known sign does not vanish
        return options, {"unless": []}
    return options, {"unless": [unsigned(a)], "factor": unsigned(a)}


def _turned(y: Expr, x: Expr, sign: int, earlier: tuple[int, ...]) -> tuple[Option, ...]:
    """A direction, or the opposite one, by the signs chosen at earlier moves."""
    values = {1: atan2(y, x), -1: atan2(minus(y), minus(x))}
    if not earlier:
        return (Option(values[sign]),)
    return tuple(Option(values[sign * each], earlier=earlier, product=each) for each in SIGNS)


def _given_angle(board: Board, found: TwoEquations) -> Expr | None:
    """The given angle itself, where its cosine and sine stand alone."""
    name = board.goal.angle
    if name is None:
        return None
    c, s = found.first.c / found.first.a, found.second.c / found.second.b
    for sign in SIGNS:
        for quarters in (0, 1, 2, -1):
            turned = Scalar.symbol(name) * sign + Scalar.symbol("pi") * Fraction(quarters, 2)
            if trig_of(turned) == (c, s):
                given = Symbol(name) if sign > 0 else negate(Symbol(name))
                return add(given, _quarters(quarters, board))
    return None


def _quarters(n: int, board: Board) -> Expr:
    """n times a right angle."""
    if n == 0:
        return ZERO
    if board.problem.style.degrees:
        return Degrees(Fraction(90 * n))
    return multiply(Number(Fraction(n, 2)), Symbol("pi"))


def _difference(first: Sides, second: Sides) -> Answer:
    """c1 = k1 cos - k2 sin, c2 = k2 cos + k1 sin."""
    (k1, _, c1), (k2, _, c2) = first, second
    value = subtract(atan2(c2, c1), atan2(k2, k1))
    fixed = isinstance(k1, Number) or isinstance(k2, Number)
    return (Option(value),), {"unless": [] if fixed else [unsigned(k1), unsigned(k2)]}


def _cramer(draft: Draft, found: TwoEquations, first: Sides, second: Sides) -> Answer:
    """By the determinant of the coefficients."""
    (a1, b1, c1), (a2, b2, c2) = first, second
    D = draft.short(found.determinant)
    cosine, sine = subtract(multiply(c1, b2), times(c2, b1)), subtract(multiply(a1, c2), times(a2, c1))
    sign, earlier = draft.board.sign_of(found.determinant)
    unless = draft.board.may_vanish(D)
    if sign:
        return _turned(sine, cosine, sign, earlier), {"unless": unless, "factor": unsigned(D)}
    return (Option(atan2(over(sine, D), over(cosine, D))),), {"unless": unless}
