"""Ratios of polynomials in s, their roots, and what the JSON tells of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import mpmath
import sympy

from derive.audit.algebra import cancelled
from derive.audit.asked import Asked, Holds, Test
from derive.audit.budget import spend
from derive.audit.points import ROUNDED, Point, floating
from derive.audit.putting_back import put_back
from derive.audit.subjects.system.plant import S, numbered

NEAR_ROOT = 1e-7
A_ROOT = 20  # operations for each step to a root
PLACES = 2  # values of s


def lowest(ratio: sympy.Expr) -> tuple[sympy.Poly, sympy.Poly]:
    """Numerator and denominator without common factors, among the roots that are in them."""
    top, bottom = cancelled(ratio)
    return sympy.Poly(top, S), sympy.Poly(bottom, S)


def roots(polynomial: sympy.Poly) -> list[mpmath.mpc]:
    """Each as often as it counts; multiple ones are divided out exactly."""
    if polynomial.degree() < 1:
        return []
    spend(A_ROOT * polynomial.degree() ** 2)
    found = []
    for factor, times in polynomial.sqf_list()[1]:
        for root in factor.nroots(n=40, maxsteps=500):
            re, im = root.as_real_imag()
            found += [mpmath.mpc(str(re), str(im))] * times
    return found


def same_roots(told: Any, wanted: Sequence[mpmath.mpc]) -> bool:
    """Whether the JSON has just these roots."""
    if not isinstance(told, list) or len(told) != len(wanted):
        return False
    left = list(wanted)
    for each in map(as_complex, told):
        nearest = min(left, key=lambda root: abs(root - each))
        if abs(nearest - each) > NEAR_ROOT * max(1, abs(nearest)):
            return False
        left.remove(nearest)
    return True


def as_complex(told: Any) -> mpmath.mpc:
    """A number, or `{"re": .., "im": ..}`."""
    if isinstance(told, Mapping):
        return mpmath.mpc(told["re"], told["im"])
    return mpmath.mpc(told)


def in_numbers(name: str, told: Any, ratio: sympy.Expr, asked: Asked) -> Iterator[Test]:
    """A transfer function as `{"num": .., "den": ..}`, where the author wants numbers; with its roots where
    everything is a number. `ratio` is what it should be, in s and the names that are left."""
    point: Point = asked.here
    there = numbered(ratio, point)
    num, den = ([point.at(asked.read(k)) for k in told[part]] for part in ("num", "den"))
    for k in range(PLACES):
        s = sympy.Rational(7 + 4 * k, 5)
        ours = mpmath.polyval(list(map(floating, num)), floating(point.at(s))) / mpmath.polyval(
            list(map(floating, den)), floating(point.at(s))
        )
        yield put_back(name, point, ours, there.subs(S, s), "its value at a point is another", ROUNDED)
    if "poles" in told:
        top, bottom = lowest(there)
        yield Holds(name, same_roots(told["poles"], roots(bottom)), "its poles are others")
        yield Holds(name, same_roots(told["zeros"], roots(top)), "its zeros are others")
