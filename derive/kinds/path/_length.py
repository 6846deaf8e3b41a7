"""The length of a path: exact where the speed is constant, a polynomial or the root of a quadratic in the
parameter, else by quadrature."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number as value_of
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.algebra.solving.polynomials import coefficients, numerator
from derive.expression import (
    Approximate,
    Call,
    Expr,
    Symbol,
    add,
    free_symbols,
    multiply,
)
from derive.kinds.path._frenet import Bent
from derive.kinds.path._sizes import positive_names, settled, told
from derive.kinds.work import Work

Integral: TypeAlias = Callable[[Scalar], Expr]  # a value of the parameter
Way: TypeAlias = Literal["steady", "integral", "quadrature", ""]  # "": no range, or symbols in the way
SIGMA = Symbol("sigma")
PANELS, NODES = 64, 10


@dataclass(frozen=True, slots=True)
class Long:
    """The board with the length, and how it was found."""

    work: Work
    way: Way


def measured(found: Bent) -> Long:
    """The length over the range of the parameter."""
    work, along = found.work, found.along
    if along.between is None:
        return Long(work, "")
    if along.L in work.known:
        return Long(work, "steady")
    low, high = along.between
    if found.steady:
        return Long(told(work, along.L, multiply(found.speed, high - low)), "steady")
    if (arc := _antiderivative(found)) is not None:
        begin, end = (work.scalar(each) for each in (low, high))
        work = work.line(SIGMA, value=_between(arc, begin, Scalar.symbol(along.s.name)))
        return Long(work.line(along.L, value=_between(arc, begin, end)), "integral")
    rate = work.final(found.speed)
    if free_symbols(rate) - {along.s.name} or any(map(free_symbols, map(work.problem.final, (low, high)))):
        return Long(work, "")
    ends = [value_of(work.problem.final(each), {}) for each in (low, high)]
    size = integral(lambda s: value_of(rate, {along.s.name: s}), ends[0], ends[1])
    return Long(work.line(along.L, value=Approximate(size), rule="in-numbers"), "quadrature")


def _between(arc: Integral, low: Scalar, high: Scalar) -> Expr:
    """The integral from one value of the parameter to another."""
    before = arc(low)
    return arc(high) if not normal(before) else arc(high) - before


def _antiderivative(found: Bent) -> Integral | None:
    """Of a polynomial, or of the root of a quadratic, by its place; None of anything else."""
    work, s = found.work, found.along.s
    rate = work.scalar(found.speed)
    if (powers := _polynomial(rate, s.name)) is not None:
        terms = [each / (k + 1) for k, each in enumerate(powers)]
        return lambda at: work.readable(
            sum((each * at ** (k + 1) for k, each in enumerate(terms)), Scalar.of(0))
        )
    powers = _polynomial(rate * rate, s.name)
    return None if powers is None or len(powers) != 3 else _of_root(powers, work)


def _of_root(powers: Sequence[Scalar], work: Work) -> Integral | None:
    """sqrt(A s^2 + B s + C) for A > 0 with u = s + B/(2 A): u sqrt(q)/2 + k ln(sqrt(A) u + sqrt(q))."""
    C, B, A = powers
    if sign_of(A, positive_names(work.problem)) != 1:
        return None
    side = settled(root(A), work.problem)
    factor = (C - B * B / (4 * A)) / (2 * side)

    def integral(at: Scalar) -> Expr:
        u = at + B / (2 * A)
        size = settled(root(A * at * at + B * at + C), work.problem)
        log = multiply(work.readable(factor), Call("log", (work.readable(side * u + size),)))
        return add(multiply(work.readable(u / 2), work.readable(size)), log) if u else log

    return integral


def _polynomial(value: Scalar, s: str) -> list[Scalar] | None:
    """The coefficients of a polynomial in s; None of anything else."""
    inner = (value.ring.letters(each) for each in value.generators() if each != s)
    if any(s in letters for letters in inner):
        return None
    if value.denominator is None:
        return coefficients(value, s)
    bottom = Scalar(value.ring, value.denominator)
    if bottom.diff(s):
        return None
    return [each / bottom for each in coefficients(numerator(value), s)]


def integral(of: Callable[[float], float], low: float, high: float) -> float:
    """By Gauss and Legendre, panel by panel."""
    import numpy as np

    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    half = (high - low) / PANELS / 2
    middles = low + half * (2 * np.arange(PANELS) + 1)
    values = [[of(float(middle + half * node)) for node in nodes] for middle in middles]
    return float(half * (np.array(values) @ weights).sum())
