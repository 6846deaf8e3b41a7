"""Sines and cosines of angles that are scalars, as pairs (cosine, sine)."""

from __future__ import annotations

from derive.algebra.angles import RADIAN, Form
from derive.algebra.fixed import form_trig
from derive.algebra.kernels import root
from derive.algebra.pairs import Pair
from derive.algebra.scalar import Scalar, as_fraction
from derive.errors import NotDerivable


def trig_of(angle: Scalar) -> Pair:
    """(cosine, sine) of an angle that is a polynomial."""
    return form_trig(linear_form(angle))


def linear_form(angle: Scalar) -> Form:
    """An angle as a linear form; each monomial is an atom of it."""
    if angle.denominator is not None:
        raise NotDerivable("an angle that is a fraction of symbols")
    parts = {}
    for exponents, coefficient in angle.numerator.terms():
        powers = [(n, e) for n, e in zip(angle.ring.names, exponents, strict=True) if e]
        atom = "*".join(n if e == 1 else f"{n}^{e}" for n, e in powers) or RADIAN
        parts[atom] = as_fraction(coefficient)
    return Form.of(parts)


def of_direction(y: Scalar, x: Scalar) -> Pair:
    """(cosine, sine) of atan2(y, x)."""
    length = root(x * x + y * y)
    return x / length, y / length
