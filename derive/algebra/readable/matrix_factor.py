"""The factor that all entries of a matrix share, written once in front of it."""

from __future__ import annotations

from functools import reduce

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.rationals import as_fraction, measure
from derive.algebra.readable.form import readable, readable_matrix
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.expression import Expr, Product


def factored_matrix(matrix: ScalarMatrix, style: Style = Style()) -> Expr:
    """The matrix, or `factor * matrix` where a monomial of symbols divides every entry."""
    factor = common_factor(matrix)
    if factor is None:
        return readable_matrix(matrix, style)
    rest = matrix.map(lambda entry: entry / factor)
    return Product((readable(factor, style), readable_matrix(rest, style)))


def common_factor(matrix: ScalarMatrix) -> Scalar | None:
    """The greatest monomial, its number included, that leaves whole coefficients in every entry.

    None where it is a mere number, or where an entry is a fraction.
    """
    entries = [entry for entry in matrix.entries if entry]
    if len(entries) < 2 or any(entry.denominator is not None for entry in entries):
        return None
    powers = reduce(_least, (_least_powers(entry) for entry in entries))
    if not any(powers):
        return None
    number = measure(as_fraction(k) for entry in entries for k in entry.numerator.coeffs())
    home = matrix.ring
    return Scalar(home, home.context.from_dict({powers: 1})) * number


def _least_powers(entry: Scalar) -> tuple[int, ...]:
    return reduce(_least, (tuple(map(int, powers)) for powers, _ in entry.numerator.terms()))


def _least(a: tuple[int, ...], b: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(map(min, a, b))
