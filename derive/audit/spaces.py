"""The rank of a matrix, its null spaces and its range, by elimination in numbers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy

from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.linear import Rows, is_zero, product, rank, transposed
from derive.audit.points import Point


def spaces(asked: Asked, J: Rows, there: Point) -> Iterator[Test]:
    """J (m by n) at a point: its rank, that bases are independent, as many as it leaves, and annihilated or
    in the range."""
    m, n, r = len(J), len(J[0]), rank(J)
    yield Same("rank", there.at(sympy.Integer(r)))
    null, span, left = (asked.result(name) and there.each(asked.result(name)) for name in SPACES)
    yield Holds("null_space", _spans(J, null, n - r), "rates that give a velocity, or too few of them")
    yield Holds(
        "left_null_space", _spans(transposed(J), left, m - r), "wrenches that need torques, or too few"
    )
    yield Holds("range", _in_range(J, span, r), "not the velocities that can be produced")
    if asked.options.velocity is not None:
        yield from _judged(asked, J, there)
    if asked.options.wrench is not None:
        tau = product(transposed(J), _column(asked, asked.options.wrench, there))
        yield Same("tau", [entry for (entry,) in tau])
        if asked.options.velocity is None:
            told = asked.results["feasible"]
            yield Holds(
                "feasible", told is all(is_zero(entry) for (entry,) in tau), "it needs torques, or none"
            )


SPACES = ("null_space", "range", "left_null_space")


def _column(asked: Asked, given: Any, there: Point) -> list[list[Any]]:
    return [[there.at(asked.formula(each))] for each in given]


def _spans(J: Rows, basis: Any, size: int) -> bool:
    """Whether so many independent columns are annihilated by J."""
    if not basis:
        return size == 0
    nothing = all(is_zero(entry) for row in product(J, basis) for entry in row)
    return bool(nothing and rank(basis) == size == len(basis[0]))


def _in_range(J: Rows, basis: Any, size: int) -> bool:
    """Whether so many independent columns lie in the range of J."""
    if not basis:
        return size == 0
    beside = [[*a, *b] for a, b in zip(J, basis, strict=True)]
    return rank(beside) == size == rank(basis) == len(basis[0])


def _judged(asked: Asked, J: Rows, there: Point) -> Iterator[Test]:
    """Whether [J v] has the rank of J; and all rates that give v."""
    v, told = _column(asked, asked.options.velocity, there), asked.results["feasible"]
    if isinstance(told, list):  # equations; at a random point they do not hold, and no rates give v
        lefts = [there.at(asked.read(str(each).removesuffix(" = 0"))) for each in told]
        told = bool(lefts) and all(map(is_zero, lefts))
    beside = [[*a, *b] for a, b in zip(J, v, strict=True)]
    yield Holds("feasible", told is (rank(beside) == rank(J)), "the velocity is, or is not, in the range")
    if told:
        rates = [[there.at(each)] for each in asked.result("qdot")]
        met = product(J, rates)
        gaps = (a - b for (a,), (b,) in zip(met, v, strict=True))
        yield Holds("qdot", all(map(is_zero, gaps)), "the rates give another velocity")
