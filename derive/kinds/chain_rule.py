"""Rates of a place that depends on a parameter, tried where the place is the square of the parameter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.algebra.numbers.arrays import arrays
from derive.expression import Expr, Symbol
from derive.kinds.checks import close

X, V, A = 0.7, 1.3, -0.4  # a value of the parameter, its rate and its acceleration


def chain_rule(laws: Sequence[Expr], slopes: Sequence[Symbol], rates: Sequence[Symbol]) -> Iterator[bool]:
    """Of the velocity and the acceleration, written in the derivatives of the place by the parameter (first,
    second) and in the parameter with its rates."""
    at = dict(zip((each.name for each in (*slopes, *rates)), (2 * X, 2.0, X, V, A), strict=True))
    for law, value in zip(laws, (2 * X * V, 2 * (V * V + X * A)), strict=True):
        yield close(arrays(law, at), value)
