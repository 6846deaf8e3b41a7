"""What is known at both ends of a polynomial in time, and the coefficients that follow from it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import factorial, perm
from typing import Any

from derive.algebra.readable.writing import positive_first
from derive.derivation import Step
from derive.expression import ONE, ZERO, Degrees, Expr, Matrix, Symbol, add, column, multiply, number
from derive.kinds.problem import Problem
from derive.mechanics.profile import Journey, Profile
from derive.names import named

t = Symbol("t")
RATES = ("q", "qdot", "qddot")


@dataclass(frozen=True, slots=True)
class Ends:
    """What is known at both ends by name, zero where it is zero: place, velocity, acceleration."""

    start: tuple[Expr, ...]
    end: tuple[Expr, ...]
    T: Symbol
    values: Mapping[Expr, Expr]
    rates: Mapping[Expr, int | None]  # how often a named value is differentiated; None for the time

    @property
    def order(self) -> int:
        """How many conditions hold at each end."""
        return len(self.start)

    @property
    def way(self) -> Expr:
        """From the start to the end."""
        return self.end[0] - self.start[0]

    @property
    def at_rest(self) -> bool:
        return all(each == ZERO for each in (*self.start[1:], *self.end[1:]))


def ends_of(journey: Journey, profile: Profile, order: int, problem: Problem) -> Ends:
    """Names for what is given; a zero stays a zero."""
    values: dict[Expr, Expr] = {}
    rates: dict[Expr, int | None] = {}

    def name(rate: int, where: str, value: Expr) -> Expr:
        if value == ZERO:
            return ZERO
        symbol = named(f"{('q', 'v', 'alpha')[rate]}_{where}", value, problem.taken)
        values[symbol], rates[symbol] = value, rate
        return symbol

    starts = (journey.start, journey.start_velocity, journey.start_acceleration)[:order]
    stops = (journey.end, journey.end_velocity, journey.end_acceleration)[:order]
    start = tuple(name(rate, "0", value) for rate, value in enumerate(starts))
    end = tuple(name(rate, "f", value) for rate, value in enumerate(stops))
    time = profile.time or ONE
    T = named("t_f", time, problem.taken)
    values[T], rates[T] = time, None
    return Ends(start, end, T, values, rates)


def power(k: int) -> Expr:
    return ONE if k == 0 else t if k == 1 else t ** number(k)


def term(coefficient: Expr, k: int) -> Expr:
    """a t^k, a minus sign in front of all."""
    if isinstance(coefficient, Degrees) and coefficient.value < 0:
        return multiply(number(-1), Degrees(-coefficient.value), power(k))
    return multiply(coefficient, power(k))


def _raised(base: Expr, k: int) -> Expr:
    return ONE if k == 0 else base if k == 1 else base ** number(k)


def laws(order: int) -> Iterator[Step]:
    """q and its derivatives by the coefficients."""
    for rate in range(order):
        terms = [
            multiply(number(perm(k, rate)), Symbol(f"a_{k}"), power(k - rate)) for k in range(rate, 2 * order)
        ]
        yield Step(f"law_{rate}", (Symbol(RATES[rate]), add(*terms)), "in-numbers")


def system(ends: Ends) -> Step:
    """The conditions at the end, for the coefficients that those at the start leave open."""
    order, T = ends.order, ends.T
    rows, right = [], []
    for rate in range(order):
        rows.append(
            tuple(multiply(number(perm(k, rate)), _raised(T, k - rate)) for k in range(order, 2 * order))
        )
        known = [
            multiply(number(Fraction(perm(k, rate), factorial(k))), ends.start[k], _raised(T, k - rate))
            for k in range(rate, order)
        ]
        right.append(add(ends.end[rate], *(-term for term in known if term != ZERO)))
    unknown = column(Symbol(f"a_{k}") for k in range(order, 2 * order))
    return Step("system", (Matrix(tuple(rows)) * unknown, column(right)))


def upper(ends: Ends) -> tuple[Expr, ...]:
    """The coefficients the end decides, as books print them (Craig, section 7.3)."""
    T, way = ends.T, ends.way
    v_0, v_f = ends.start[1], ends.end[1]
    if ends.order == 2:
        return (
            _over(T, 2, (3, way), (-2, v_0, T), (-1, v_f, T)),
            _over(T, 3, (-2, way), (1, v_0, T), (1, v_f, T)),
        )
    a_0, a_f = ends.start[2], ends.end[2]
    if ends.at_rest:
        return _over(T, 3, (10, way)), _over(T, 4, (-15, way)), _over(T, 5, (6, way))
    T2 = T**2
    return (
        _over(T, 3, (20, way), (-12, v_0, T), (-8, v_f, T), (-3, a_0, T2), (1, a_f, T2), half=True),
        _over(T, 4, (-30, way), (16, v_0, T), (14, v_f, T), (3, a_0, T2), (-2, a_f, T2), half=True),
        _over(T, 5, (12, way), (-6, v_0, T), (-6, v_f, T), (-1, a_0, T2), (1, a_f, T2), half=True),
    )


def _over(T: Symbol, k: int, *terms: tuple[Any, ...], half: bool = False) -> Expr:
    """A sum of multiples over (twice) a power of the time; zeros left out."""
    kept = [(n, *factors) for n, *factors in terms if ZERO not in factors]
    if half and not any(n % 2 for n, *_ in kept):
        kept, half = [(n // 2, *factors) for n, *factors in kept], False
    top = positive_first([multiply(number(n), *factors) for n, *factors in kept])
    if top == ZERO:
        return ZERO
    return top / (multiply(number(2), _raised(T, k)) if half else _raised(T, k))
