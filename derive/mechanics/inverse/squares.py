"""Squaring and adding: the sum of squares of coordinates holds fewer joint variables than each of them.

For the two links of an elbow this is the law of cosines; for a sliding joint it gives its length.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from operator import add

from derive.algebra.angles import Form
from derive.algebra.scalar import Scalar
from derive.mechanics.inverse.equation import Equation
from derive.mechanics.inverse.trigonometric import Row, row_of


@dataclass(frozen=True, slots=True)
class Part:
    """known = unknown: an equation with everything that is known on one side."""

    equation: Equation
    known: Scalar
    unknown: Scalar


@dataclass(frozen=True, slots=True)
class Elbow:
    """The sum of the squares of the known sides is a cos q + b sin q + constant: `row` holds a, b, and the
    negative of the constant alone, without the squares."""

    angle: Form
    parts: tuple[Part, ...]
    row: Row


@dataclass(frozen=True, slots=True)
class Reach:
    """The sum of the squares of the known sides is square d^2 + linear d + constant."""

    slide: str
    parts: tuple[Part, ...]
    square: Scalar
    linear: Scalar
    constant: Scalar


def split(equation: Equation, value: Scalar, unknown: frozenset[str]) -> Part:
    """right - left, sorted into what holds unknown generators and what does not."""
    home = value.ring
    outer = home.grouped(value.numerator, unknown).get((0,) * len(unknown), home.zero)
    return Part(equation, -Scalar(home, outer), Scalar(home, value.numerator - outer))


def subsets(parts: Sequence[Part]) -> Iterator[tuple[Part, ...]]:
    """All three coordinates, then two of them; those without unknowns apart."""
    moving = [part for part in parts if part.unknown]
    for size in (3, 2):
        yield from combinations(moving, size)


def elbow(angle: Form, parts: tuple[Part, ...], unknown: frozenset[str]) -> Elbow | None:
    """The sum of squares as an equation in one angle."""
    total = _total(parts)
    own = {f"cos({angle})", f"sin({angle})"}
    if set(total.generators()) & (unknown - own):
        return None
    row = row_of(total, angle, parts[0].equation)
    return Elbow(angle, parts, row) if row else None


def reach(slide: str, parts: tuple[Part, ...], unknown: frozenset[str]) -> Reach | None:
    """The sum of squares as an equation in one displacement."""
    total = _total(parts)
    if set(total.generators()) & (unknown - {slide}):
        return None
    home = total.ring
    found = home.grouped(total.numerator, (slide,))
    if not set(found) <= {(2,), (1,), (0,)} or (2,) not in found:
        return None
    square, linear, constant = (Scalar(home, found.get((n,), home.zero)) for n in (2, 1, 0))
    return Reach(slide, parts, square, linear, constant)


def _total(parts: tuple[Part, ...]) -> Scalar:
    return reduce(add, (part.unknown * part.unknown for part in parts))
