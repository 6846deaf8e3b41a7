"""Cubic splines through points in many digits: all conditions of all pieces solved at once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import mpmath

from derive.audit.asked import Asked, Holds, Test
from derive.audit.points import ROUNDED, Number, Point, agree, shown
from derive.mechanics.paths import Via

SHARES = (mpmath.mpf(1) / 7, mpmath.mpf(5) / 8)  # of a piece


@dataclass(frozen=True, slots=True)
class Spline:
    """Of each coordinate the four coefficients of each piece, from the time at which it begins."""

    times: Sequence[Any]
    coefficients: Sequence[Sequence[Any]]

    def at(self, t: Any, order: int = 0) -> list[Any]:
        """The place, or a derivative."""
        k = max(sum(t >= each for each in self.times[:-1]) - 1, 0)
        return [_value(row[4 * k : 4 * k + 4], t - self.times[k], order) for row in self.coefficients]


def _value(coefficients: Sequence[Any], tau: Any, order: int) -> Any:
    powers = range(order, len(coefficients))
    return sum(coefficients[n] * mpmath.ff(n, order) * tau ** (n - order) for n in powers)


def solved(asked: Asked, point: Point) -> Spline:
    """The spline of a path through points."""
    shape: Via = asked.subject.shape
    times = [point.at(asked.formula(each)) for each in shape.times]
    places = [[point.at(asked.formula(part)) for part in each] for each in shape.places]
    still = 1 if shape.ends == "clamped" else 2
    return Spline(times, [_coefficients(times, column, still) for column in zip(*places, strict=True)])


def _coefficients(times: Sequence[Any], places: Sequence[Any], still: int) -> list[Any]:
    """The derivative of order `still` is zero at the ends."""
    n = len(times) - 1
    rows: list[list[Any]] = []
    right: list[Any] = []

    def condition(value: Any, *parts: tuple[int, Any, int, int]) -> None:
        row = [mpmath.mpf(0)] * (4 * n)
        for piece, tau, order, sign in parts:
            for power in range(order, 4):
                row[4 * piece + power] = sign * mpmath.ff(power, order) * tau ** (power - order)
        rows.append(row)
        right.append(value)

    steps = [high - low for low, high in pairwise(times)]
    for k, h in enumerate(steps):
        condition(places[k], (k, mpmath.mpf(0), 0, 1))
        condition(places[k + 1], (k, h, 0, 1))
        for order in (1, 2) if k else ():
            condition(mpmath.mpf(0), (k - 1, steps[k - 1], order, 1), (k, mpmath.mpf(0), order, -1))
    condition(mpmath.mpf(0), (0, mpmath.mpf(0), still, 1))
    condition(mpmath.mpf(0), (n - 1, steps[-1], still, 1))
    return list(mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix(right)))


def spline(asked: Asked, point: Point) -> Iterator[Test]:
    """Every result at moments of each piece; the length by quadrature."""
    found = solved(asked, point)
    for low, high in pairwise(found.times):
        for share in SHARES:
            yield from _at(asked, point, found, low + share * (high - low))
    if "length" in asked.results:
        with mpmath.workdps(20):
            whole = mpmath.quad(lambda t: _size(found.at(t, 1)), found.times)
        ours = point.at(asked.result("length"))
        yield Holds("length", agree(ours, whole, near=ROUNDED * 1000), f"it is {mpmath.nstr(whole, 10)}")


def _at(asked: Asked, point: Point, found: Spline, t: Any) -> Iterator[Test]:
    now = point.where(t=t)
    p, v, a = (found.at(t, order) for order in range(3))
    speed = _size(v)
    tangent = [each / speed for each in v]
    theirs = {"p": p, "v": v, "a": a, "t": tangent}
    along = sum(x * y for x, y in zip(tangent, a, strict=True))
    side = [x - along * y for x, y in zip(a, tangent, strict=True)]
    if "n" in asked.results:
        theirs["n"] = [each / _size(side) for each in side]
        if len(side) == 3:
            x, y, z = tangent
            p_n, q_n, r_n = theirs["n"]
            theirs["b"] = [y * r_n - z * q_n, z * p_n - x * r_n, x * q_n - y * p_n]
    else:
        yield Holds("curvature", _near(_size(side), 0), "it is bent, and has a normal")
    for name, value in theirs.items():
        ours = now.each(asked.result(name))
        same = isinstance(ours, Sequence) and all(map(_near, ours, value))
        yield Holds(name, same, f"it is {shown(value)}")
    kappa = _size(side) / speed**2
    yield Holds("curvature", _near(now.at(asked.result("curvature")), kappa), f"it is {shown(kappa)}")


def _size(vector: Sequence[Any]) -> Any:
    return mpmath.sqrt(sum(each**2 for each in vector))


def _near(ours: Number, theirs: Number) -> bool:
    return agree(ours, theirs, 1, ROUNDED)
