"""Sines and cosines of angles that are scalars, as pairs (cosine, sine)."""

from __future__ import annotations

from fractions import Fraction
from functools import reduce

from derive.algebra.angles import PI, RADIAN, Form
from derive.algebra.fixed import fixed_trig
from derive.algebra.kernels import root
from derive.algebra.scalar import Scalar, as_fraction, trig
from derive.errors import NotDerivable


def trig_of(angle: Scalar) -> tuple[Scalar, Scalar]:
    """(cosine, sine) of an angle that is a polynomial: fixed parts apart, the rest a linear form."""
    turns, form = linear_form(angle)
    pair = trig(form) if form.parts else (Scalar.of(1), Scalar.of(0))
    return added(pair, fixed_trig(turns)) if turns else pair


def linear_form(angle: Scalar) -> tuple[Fraction, Form]:
    """(multiple of pi, the rest) of an angle; each monomial is an atom of the form."""
    if angle.denominator is not None:
        raise NotDerivable("an angle that is a fraction of symbols")
    turns, parts = Fraction(0), {}
    for exponents, coefficient in angle.numerator.terms():
        powers = [(n, e) for n, e in zip(angle.ring.names, exponents, strict=True) if e]
        if powers == [(PI, 1)]:
            turns = as_fraction(coefficient)
        else:
            atom = "*".join(n if e == 1 else f"{n}^{e}" for n, e in powers) or RADIAN
            parts[atom] = as_fraction(coefficient)
    return turns, Form.of(parts)


def added(a: tuple[Scalar, Scalar], b: tuple[Scalar, Scalar]) -> tuple[Scalar, Scalar]:
    """The addition theorem on (cosine, sine) pairs."""
    return a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]


def multiple(pair: tuple[Scalar, Scalar], n: int) -> tuple[Scalar, Scalar]:
    base = pair if n >= 0 else (pair[0], -pair[1])
    return reduce(added, [base] * abs(n), (Scalar.of(1), Scalar.of(0)))


def of_direction(y: Scalar, x: Scalar) -> tuple[Scalar, Scalar]:
    """(cosine, sine) of atan2(y, x)."""
    length = root(x * x + y * y)
    return x / length, y / length
