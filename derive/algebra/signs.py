"""The sign of a normal form, where the signs of its symbols decide it."""

from __future__ import annotations

from collections.abc import Collection

from flint import fmpq_mpoly

from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar


def sign_of(value: Scalar, positive: Collection[str] = ()) -> int | None:
    """1, -1 or 0; None where it is not known. `positive` are symbols known to be positive."""
    if not value:
        return 0
    top = _sign(value.numerator, value.ring, positive)
    if top is None or value.denominator is None:
        return top
    bottom = _sign(value.denominator, value.ring, positive)
    return None if bottom is None else top * bottom


def _sign(polynomial: fmpq_mpoly, home: Ring, positive: Collection[str]) -> int | None:
    """Of a sum whose terms all have the same known sign."""
    roots = {root.name for root in home.roots}
    found = set()
    for exponents, coefficient in polynomial.terms():
        powers = zip(home.names, map(int, exponents), strict=True)
        if any(power % 2 and name not in positive and name not in roots for name, power in powers):
            return None
        found.add(1 if coefficient > 0 else -1)
    return found.pop() if len(found) == 1 else None
