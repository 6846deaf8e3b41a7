"""One polynomial from one end to the other: put back at both ends, its peaks found among its extremes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import mpmath
import sympy

from derive.audit.asked import Asked, Same, Test
from derive.audit.points import Point, floating
from derive.audit.putting_back import put_back
from derive.expression import ZERO

TIME = sympy.Symbol("t")
SMALL = mpmath.mpf(10) ** -20


def cubic_trajectory(asked: Asked, point: Point) -> Iterator[Test]:
    """Place and velocity at both ends."""
    yield from _polynomial(asked, point, 2)


def quintic_trajectory(asked: Asked, point: Point) -> Iterator[Test]:
    """And the acceleration."""
    yield from _polynomial(asked, point, 3)


def _polynomial(asked: Asked, point: Point, order: int) -> Iterator[Test]:
    """The linear system for all coefficients, a row for each thing that is prescribed at an end."""
    start, end, time = ends(asked)
    last = floating(point.at(time))
    rows = [_row(moment, rate, 2 * order) for moment in (mpmath.mpf(0), last) for rate in range(order)]
    right = [floating(point.at(each)) for each in (*start[:order], *end[:order])]
    a = list(mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix(right)))
    for k, coefficient in enumerate(a):
        yield put_back(
            f"a_{k}", point, asked.result(f"a_{k}"), coefficient, f"it is {mpmath.nstr(coefficient)}"
        )
    now = floating(point.at(TIME))
    yield Same("q", mpmath.polyval(a[::-1], now))
    way = floating(point.at(end[0] - start[0]))
    for rate, name in ((1, "v_peak"), (2, "a_peak")):
        if name in asked.results:
            sign = mpmath.sign(way) * mpmath.sign(last) ** rate
            yield Same(name, sign * _largest(_derived(a[::-1], rate), last))


def _row(moment: mpmath.mpf, rate: int, size: int) -> list[mpmath.mpf]:
    """A derivative of 1, t, t^2, ... at a moment."""
    return [mpmath.ff(k, rate) * moment ** (k - rate) if k >= rate else mpmath.mpf(0) for k in range(size)]


def _derived(coefficients: list[mpmath.mpf], rate: int) -> list[mpmath.mpf]:
    """Of a polynomial, highest power first."""
    for _ in range(rate):
        powers = range(len(coefficients) - 1, 0, -1)
        coefficients = [k * each for k, each in zip(powers, coefficients, strict=False)]
    return coefficients


def _largest(polynomial: list[mpmath.mpf], last: mpmath.mpf) -> mpmath.mpf:
    """Its largest size between 0 and `last`: at an end or where its slope vanishes."""
    slope = _derived(polynomial, 1)
    inside = mpmath.polyroots(slope, maxsteps=200, extraprec=200) if len(slope) > 1 else []
    shares = [mpmath.re(t) / last for t in inside if abs(mpmath.im(t)) <= SMALL * abs(last)]
    times = [mpmath.mpf(0), last, *(share * last for share in shares if 0 <= share <= 1)]
    return max(abs(mpmath.polyval(polynomial, t)) for t in times)


def ends(asked: Asked) -> tuple[Sequence[sympy.Expr], Sequence[sympy.Expr], sympy.Expr]:
    """Place, velocity and acceleration at the start and at the end, and the time between."""
    journey = asked.subject.journey
    start = (journey.start, journey.start_velocity, journey.start_acceleration)
    end = (journey.end, journey.end_velocity, journey.end_acceleration)
    time = asked.formula(asked.subject.time or ZERO)
    return [*map(asked.formula, start)], [*map(asked.formula, end)], time
