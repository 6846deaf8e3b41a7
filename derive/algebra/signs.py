"""The sign of a normal form, where the signs of its symbols decide it."""

from __future__ import annotations

from collections.abc import Collection

from flint import fmpq_mpoly

from derive.algebra.multivariate import grouped
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar


def sign_of(value: Scalar, positive: Collection[str] = ()) -> int | None:
    """1, -1 or 0 where all terms have one known sign; else None. `positive` are the symbols known to be
    positive."""
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


def signed(value: Scalar, positive: Collection[str]) -> Scalar:
    """The same value with |x| replaced by x or -x where the sign of x is known."""
    home = value.ring
    for place, root in enumerate(home.roots):
        if root.name.startswith("abs("):
            inside = Scalar(home, home.polynomial(root.radicand).sqrt())
            sign = sign_of(inside, positive)
            if sign is not None:
                value = _replaced(value, place, inside * sign)
    return value


def _replaced(value: Scalar, place: int, by: Scalar) -> Scalar:
    """With the square root at a place replaced, which stands to the first power at most."""

    def replaced(part: fmpq_mpoly) -> Scalar:
        groups = grouped(part, (place,)).items()
        return sum((Scalar(value.ring, rest) * by**power for (power,), rest in groups), Scalar.of(0))

    return replaced(value.numerator) / replaced(value.denominator or value.ring.one)
