"""Where a pseudo-inverse fails: the denominators that may vanish."""

from __future__ import annotations

from dataclasses import replace
from math import prod

from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.algebra.solving.factors import primitive
from derive.expression import (
    Expr,
    Symbol,
    is_negative,
)
from derive.kinds.spaces._redundancy.board import Board
from derive.kinds.spaces._redundancy.given import Given
from derive.mechanics.minors import minors

MOST_ENTRIES = 24  # of a matrix whose minors are looked at together


def denominators(given: Given, board: Board, plus: Symbol) -> tuple[Board, tuple[Expr, ...]]:
    """The denominators of J^+ that may vanish, with the claim that it has no others."""
    J = board[given.map.name]
    if prod(J.shape) <= MOST_ENTRIES and any(
        each.value and not _may_vanish(each.value, given.nonzero) for each in minors(J)
    ):
        return board, ()
    found: dict[str, Scalar] = {}
    whole, over = board.fractions[plus]
    below = [Scalar(each.ring, each.denominator) for each in whole.entries if each.denominator is not None]
    for each in map(primitive, [over] if over is not None else below):
        found.setdefault(str(each), each)
    readable = board.problem.readable
    told = {_unsigned(readable(each)): each for each in found.values() if _may_vanish(each, given.nonzero)}
    if not told:
        return board, ()
    law = (normal(tree) in (value, -value) for tree, value in told.items())
    return replace(board, work=board.work.law("denominators", law)), tuple(told)


def _unsigned(tree: Expr) -> Expr:
    return -tree if is_negative(tree) else tree


def _may_vanish(value: Scalar, nonzero: frozenset[str]) -> bool:
    """Whether its sign is not known, or all its terms may be zero."""
    constant = any(not any(powers) for powers in value.numerator.to_dict())
    return sign_of(value, nonzero) is None or not (constant or value.letters() <= nonzero)
