"""The signs of normal forms at a point."""

from __future__ import annotations

import math
from collections.abc import Mapping

from derive.algebra.angles import Form
from derive.algebra.generators import PI, RADIAN
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar, as_fraction
from derive.errors import NotDerivable

ZERO = 1e-9  # as against the size of the terms: a sign that rounding could turn is none


def sign_at(of: Scalar, point: Mapping[str, float]) -> int:
    """1 or -1. Raises NotDerivable for what is as good as zero, KeyError for what has no value there."""
    values = _generators(of.ring, point, set(of.generators()))
    total = 1
    for polynomial in (of.numerator, of.denominator):
        if polynomial is not None:
            terms = [
                float(as_fraction(k))
                * math.prod(values[n] ** int(e) for n, e in zip(of.ring.names, powers, strict=True) if e)
                for powers, k in polynomial.terms()
            ]
            value = math.fsum(terms)
            if abs(value) <= ZERO * math.fsum(map(abs, terms)):
                raise NotDerivable("a sign that is not known")
            total *= 1 if value > 0 else -1
    return total


def _generators(home: Ring, point: Mapping[str, float], used: set[str]) -> dict[str, float]:
    """The values of the generators in use and of those their radicands need."""
    values: dict[str, float] = {
        name: _atom(name, point) for name in home.symbols if name in used or name in point
    }
    for form in home.angles:
        try:
            at = _angle(form, point)
        except KeyError:
            continue
        values |= {f"cos({form})": math.cos(at), f"sin({form})": math.sin(at)}
    for each in reversed(home.roots):
        try:
            inside = math.fsum(
                float(k) * math.prod(values[name] ** power for name, power in powers)
                for powers, k in each.radicand
            )
        except KeyError:
            continue
        values[each.name] = math.sqrt(max(inside, 0.0))
    return values


def _angle(form: Form, point: Mapping[str, float]) -> float:
    return math.fsum(
        float(n) * math.prod(_part(part, point) for part in atom.split("*")) for atom, n in form.parts
    )


def _part(part: str, point: Mapping[str, float]) -> float:
    name, _, power = part.partition("^")
    return _atom(name, point) ** int(power or 1)


def _atom(name: str, point: Mapping[str, float]) -> float:
    return {PI: math.pi, RADIAN: 1.0}[name] if name in (PI, RADIAN) else point[name]
