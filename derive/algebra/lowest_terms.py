"""Fractions of polynomials of a ring in lowest terms."""

from __future__ import annotations

from flint import fmpq_mpoly

from derive.algebra.ring import Ring


def lowest_terms(
    home: Ring, top: fmpq_mpoly, bottom: fmpq_mpoly | None
) -> tuple[fmpq_mpoly, fmpq_mpoly | None]:
    """(top, bottom), reduced: no square roots of numbers below, common factors cancelled, the leading
    coefficient of the bottom 1. A bottom of None is 1, and so it comes back."""
    top = home.reduce(top)
    if bottom is None or top == 0:
        return top, None
    top, bottom = _rational_bottom(home, top, home.reduce(bottom))
    common = top.gcd(bottom)
    if not common.is_constant():
        top, bottom = divmod(top, common)[0], divmod(bottom, common)[0]
    lead = bottom.leading_coefficient()
    return top / lead, None if bottom.is_constant() else bottom / lead


def _rational_bottom(home: Ring, top: fmpq_mpoly, bottom: fmpq_mpoly) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """Both multiplied by the conjugates of the bottom: 1/(a + b r) = (a - b r)/(a^2 - b^2 r^2)."""
    for place, root in enumerate(home.roots):
        along = bottom.derivative(place)
        if along != 0 and root.degree == 2 and home.polynomial(root.radicand).is_constant():
            conjugate = bottom - 2 * along * home.gen(root.name)
            top, bottom = home.reduce(top * conjugate), home.reduce(bottom * conjugate)
    return top, bottom
