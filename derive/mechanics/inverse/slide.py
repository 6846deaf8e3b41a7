"""An equation in one displacement alone: it is linear there."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.scalar import Scalar
from derive.mechanics.inverse.equation import Equation


@dataclass(frozen=True, slots=True)
class Slide:
    """slope d = value."""

    slide: str
    slope: Scalar
    value: Scalar
    equation: Equation


def slide_of(difference: Scalar, name: str, equation: Equation) -> Slide | None:
    """From slope d - value; None where it is not of that form."""
    home = difference.ring
    found = home.grouped(difference.numerator, (name,))
    if not set(found) <= {(1,), (0,)} or (1,) not in found:
        return None
    slope, rest = (Scalar(home, found.get((n,), home.zero)) for n in (1, 0))
    return Slide(name, slope, -rest, equation)
