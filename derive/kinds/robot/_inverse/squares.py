"""Sums of squares written out: the law of cosines at an elbow, the length of a sliding joint."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction
from functools import reduce
from operator import add as add_values

from derive.algebra.infix import text
from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar
from derive.expression import (
    Expr,
    Power,
    Symbol,
    add,
    cos,
    multiply,
    negate,
    number,
    sin,
    sqrt,
    squared,
    subtract,
)
from derive.kinds.robot._inverse.board import Board, Draft
from derive.kinds.robot._inverse.moves import Move, Option
from derive.kinds.robot._inverse.single import solved
from derive.kinds.robot._inverse.trees import (
    common_denominator,
    leaves,
    minus,
    multiplied,
    ordered,
    over,
    square,
    starts_negative,
    terms_of,
    times,
    total,
)
from derive.mechanics.inverse.squares import Elbow, Part, Reach
from derive.mechanics.inverse.trigonometric import Row

SIGNS = (1, -1)


def elbow(board: Board, found: Elbow) -> Move:
    """The sum of squares in one angle, which is then one equation in it."""
    draft, q = Draft(board), board.angle(found.angle)
    squares = [square(side) for side in _known_sides(draft, found.parts)]
    row, common = reduced(found.row)
    rest = terms_of(board.problem.readable(-row.c))
    cosine, sine = (board.problem.readable(each * common) for each in (row.a, row.b))
    draft.add("squares", total(squares), add(*rest, times(cosine, cos(q)), times(sine, sin(q))))
    c = _without(squares, rest, board.problem.readable(common))
    a, b = (draft.short(each) if each else number(0) for each in (row.a, row.b))
    if row.a and row.b:
        c = draft.name(c)
    return solved(draft, found.angle, (a, b, c), row, extra={"law": len(squares)})


def _without(squares: list[Expr], rest: tuple[Expr, ...], common: Expr) -> Expr:
    """(the squares less the constant terms) / the common factor, without fractions in fractions."""
    n = common_denominator((*rest, common))
    top = total((*(multiplied(n, each) if n > 1 else each for each in squares), *_turned(n, rest)))
    return over(top, multiplied(n, common) if n > 1 else common)


def _turned(n: int, terms: Iterable[Expr]) -> Iterable[Expr]:
    return (minus(multiplied(n, term) if n > 1 else term) for term in terms)


def reach(board: Board, found: Reach) -> Move:
    """The sum of squares in one displacement."""
    draft, d = Draft(board), Symbol(found.slide)
    squares = [square(side) for side in _known_sides(draft, found.parts)]
    P, Q, D = (board.problem.readable(v) for v in (found.square, found.linear, found.constant))
    half, middle = found.linear / 2, found.square * Scalar.symbol(found.slide) + found.linear / 2
    draft.add("squares", total(squares), add(times(P, squared(d)), times(Q, d), *terms_of(D)))
    rest = total((*squares, *map(minus, terms_of(D))))
    symmetric = not found.linear
    values: tuple[Expr, Expr]
    if symmetric:
        size = sqrt(over(rest, P))
        values = (size, negate(size))
        names = [f"{d.name} {relation} 0" for relation in "><"]
    else:
        h = board.problem.readable(half)
        known = reduce(add_values, (part.known * part.known for part in found.parts))
        rest = min(
            add(square(h), multiply(P, rest)),
            board.tree(half * half + found.square * (known - found.constant)),
            key=leaves,
        )
        values = (over(ordered(add(minus(h), sqrt(rest))), P), over(subtract(minus(h), sqrt(rest)), P))
        names = [f"{text(board.tree(middle))} {relation} 0" for relation in "><"]
    options = [Option(v, s, when) for v, s, when in zip(values, SIGNS, names, strict=True)]
    positive = symmetric and board.problem.assumptions.get(d.name) in ("positive", "nonnegative")
    if not symmetric:
        board.sums.append((middle, len(board.moves)))
    facts = {"method": "reach", "symmetric": symmetric, "positive": positive, "exists": _doubtful(rest)}
    return draft.move(found.slide, d, options[:1] if positive else options, {**facts, "law": len(squares)})


def _doubtful(rest: Expr) -> Expr | None:
    """What has to be positive; nothing to say of a sum of squares."""
    squares = all(isinstance(term, Power) and term.exponent == number(2) for term in terms_of(rest))
    return None if squares else rest


def _known_sides(draft: Draft, parts: Iterable[Part]) -> list[Expr]:
    """The known side of each equation, with a step that says what it equals."""
    board, known = draft.board, []
    for part in parts:
        turn = starts_negative(board.known_as(part.known) or board.tree(part.known))
        value, unknown = (-part.known, -part.unknown) if turn else (part.known, part.unknown)
        known.append(draft.short(value))
        draft.equation(known[-1], board.problem.readable(unknown))
    return known


def reduced(row: Row) -> tuple[Row, Scalar]:
    """The coefficients without their common factor, and that factor."""
    one = Scalar.of(1)
    if not (row.a and row.b):
        return replace(row, a=one if row.a else row.a, b=one if row.b else row.b), row.a or row.b
    home = row.a.ring
    common = Scalar(home, row.a.numerator.gcd(row.b.numerator))
    lead = (row.a / common).numerator.leading_coefficient()
    if (row.a / common).constant is None and (row.b / common).constant is None:
        common = common * abs(as_fraction(lead))
    else:
        common = common * Fraction(1)
    return replace(row, a=row.a / common, b=row.b / common), common
