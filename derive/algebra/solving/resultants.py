"""Eliminating one variable, an angle or a symbol, from two polynomials."""

from __future__ import annotations

from flint import fmpq_mpoly

from derive.algebra.roots_and_functions import in_single_angles
from derive.algebra.scalar import Scalar, common_ring
from derive.algebra.solving.half_angles import half_angles

MOST = 20_000  # terms of the one times those of the other, times their degrees


def resultant(one: Scalar, two: Scalar, name: str) -> Scalar | None:
    """The resultant of two polynomials by one variable (Cox, Little and O'Shea, Ideals, Varieties, and
    Algorithms, chapter 3), for an angle in the tangent of its half: it vanishes wherever both do for some
    value of the name. None where it would be out of all proportion."""
    one, two = in_single_angles(one), in_single_angles(two)
    home = common_ring((one, two))
    p, q = one.into(home).numerator, two.into(home).numerator
    if name in home.index:
        place = home.index[name]
        if _size(p, q, place) > MOST:
            return None
        return Scalar(home, home.reduce(p.resultant(q, name)))
    halves = half_angles(home, (name,))
    if len(halves.places) != 1:
        return None
    f, g = halves.of(p).part, halves.of(q).part
    if _size(f, g, 0) > MOST:
        return None
    found = f.resultant(g, f"t{halves.places[0]}")
    return Scalar(home, home.reduce(found.project_to_context(home.context)))


def _size(p: fmpq_mpoly, q: fmpq_mpoly, place: int) -> int:
    return len(p) * len(q) * (int(p.degrees()[place]) + int(q.degrees()[place]) + 1)
