"""The array of Routh of a polynomial with exact coefficients, its two special cases included.

Ogata, Modern Control Engineering, section 5.6; Dorf and Bishop, Modern Control Systems, section 6.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, TypeAlias

from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomials import coefficients, numerator
from derive.control.rational import Polynomial
from derive.errors import NotDerivable

Origin: TypeAlias = Literal["coefficients", "formula", "derivative", "epsilon"]
ZERO = Scalar.of(0)
MOST_TERMS = 150  # of an entry


@dataclass(frozen=True, slots=True)
class Row:
    """The row of s^power. `origin` says where its entries are from: where all were zero, from the derivative
    of the polynomial of the row above; where the first alone was zero, it is a small positive number."""

    power: int
    entries: tuple[Scalar, ...]
    origin: Origin

    @property
    def polynomial(self) -> Polynomial:
        """What the row stands for: its entries at s^power, s^(power - 2), ...; highest power first."""
        found = [ZERO] * (self.power + 1)
        for place, entry in enumerate(self.entries[: self.power // 2 + 1]):
            found[2 * place] = entry
        return tuple(found)


def routh(polynomial: Sequence[Scalar], epsilon: str) -> tuple[Row, ...]:
    """The rows of s^n to s^0 of coefficients, highest power first; `epsilon` is the small number's name.

    Raises NotDerivable where the entries grow too long.
    """
    degree = len(polynomial) - 1
    width = degree // 2 + 1
    rows = [Row(degree, _padded(polynomial[0::2], width), "coefficients")]
    for power in range(degree - 1, -1, -1):
        first = power == degree - 1
        entries = _padded(polynomial[1::2], width) if first else _next(rows[-2], rows[-1])
        _require_short(entries)
        rows.append(_settled(entries, power, rows[-1], "coefficients" if first else "formula", epsilon))
    return tuple(rows)


def leading(entry: Scalar, epsilon: str) -> Scalar:
    """The term an entry comes down to where epsilon is very small, without its power of epsilon."""
    if epsilon not in entry.generators():
        return entry
    below = Scalar(entry.ring, entry.denominator) if entry.denominator is not None else Scalar.of(1)
    return _lowest(numerator(entry), epsilon) / _lowest(below, epsilon)


def sign_changes(signs: Sequence[float]) -> int:
    """How often a first column changes its sign."""
    return sum(a * b < 0 for a, b in pairwise(signs))


def _require_short(entries: Sequence[Scalar]) -> None:
    terms = max(len(entry.numerator) for entry in entries)
    if terms > MOST_TERMS:
        raise NotDerivable(
            f"an entry of the array has {terms} terms, and at most {MOST_TERMS} are written out; "
            "give some of the symbols values under where:"
        )


def _padded(entries: Sequence[Scalar], width: int) -> tuple[Scalar, ...]:
    return (*entries, *[ZERO] * (width - len(entries)))


def _next(above: Row, below: Row) -> tuple[Scalar, ...]:
    """r_ij = (r_(i-1)1 r_(i-2)(j+1) - r_(i-2)1 r_(i-1)(j+1)) / r_(i-1)1."""
    a, b = (*above.entries, ZERO), (*below.entries, ZERO)
    columns = range(1, len(above.entries) + 1)
    return tuple(a[j] if not b[j] else (b[0] * a[j] - a[0] * b[j]) / b[0] for j in columns)


def _settled(entries: tuple[Scalar, ...], power: int, above: Row, origin: Origin, epsilon: str) -> Row:
    """The row, made fit to go on with."""
    if entries[0]:
        return Row(power, entries, origin)
    if any(entries):
        return Row(power, (Scalar.symbol(epsilon), *entries[1:]), "epsilon")
    slopes = (entry * max(power + 1 - 2 * place, 0) for place, entry in enumerate(above.entries))
    return Row(power, tuple(slopes), "derivative")


def _lowest(polynomial: Scalar, name: str) -> Scalar:
    return next(part for part in coefficients(polynomial, name) if part)


def remainder(polynomial: Sequence[Scalar], by: Sequence[Scalar]) -> Polynomial:
    """What is left of a polynomial divided by another whose first coefficient is not zero."""
    left = list(polynomial)
    while len(left) >= len(by):
        factor = left[0] / by[0]
        left = [a - factor * b for a, b in zip(left, [*by, *[ZERO] * len(left)], strict=False)][1:]
    return tuple(left)
