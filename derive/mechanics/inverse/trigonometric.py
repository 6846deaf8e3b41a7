"""a cos q + b sin q = c, alone and in pairs: what an equation says about one angle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from derive.algebra.angles import Form
from derive.algebra.scalar import Scalar
from derive.mechanics.inverse.equation import Equation

Kind = Literal["direction", "difference", "determinant"]


@dataclass(frozen=True, slots=True)
class Row:
    """a cos q + b sin q = c, and the equation that says so."""

    a: Scalar
    b: Scalar
    c: Scalar
    equation: Equation

    def negated(self) -> Row:
        return Row(-self.a, -self.b, -self.c, self.equation)

    @property
    def terms(self) -> int:
        return sum(len(part.numerator) for part in (self.a, self.b, self.c))


@dataclass(frozen=True, slots=True)
class OneEquation:
    """Two angles satisfy one equation where a^2 + b^2 > c^2, one where they are equal, else none."""

    angle: Form
    row: Row


@dataclass(frozen=True, slots=True)
class TwoEquations:
    """One angle satisfies two equations, where the determinant of their coefficients is not zero.

    direction: cos and sin each stand alone; difference: the coefficients are (k1, -k2) and (k2, k1), so
    that the angle is a difference of two directions; determinant: by Cramer's rule.
    """

    angle: Form
    first: Row
    second: Row
    kind: Kind

    @property
    def determinant(self) -> Scalar:
        return self.first.a * self.second.b - self.first.b * self.second.a

    @property
    def shared(self) -> bool:
        """Whether cosine and sine, each alone, have the same factor up to a number."""
        ratio = self.second.b / self.first.a if self.first.a and self.second.b else None
        return ratio is not None and ratio.constant is not None


def row_of(value: Scalar, angle: Form, equation: Equation) -> Row | None:
    """The coefficients where an expression is a cos q + b sin q - c; None where it is not of that form."""
    home = value.ring
    parts = home.grouped(value.numerator, (f"cos({angle})", f"sin({angle})"))
    if not set(parts) <= {(1, 0), (0, 1), (0, 0)} or not {(1, 0), (0, 1)} & set(parts):
        return None
    a, b, c = (Scalar(home, parts.get(key, home.zero)) for key in ((1, 0), (0, 1), (0, 0)))
    return Row(a, b, -c, equation)


def pair_of(angle: Form, rows: tuple[Row, Row]) -> TwoEquations:
    """Two equations in the order and with the signs in which they are solved most plainly."""
    first, second = rows
    if first.a == 0 or second.b == 0:
        first, second = second, first
    if first.b == 0 and second.a == 0:
        return TwoEquations(angle, first, second, "direction")
    for one, two in ((first, second), (second, first)):
        for other in (two, two.negated()):
            if other.a == -one.b and other.b == one.a:
                return TwoEquations(angle, one, other, "difference")
    return TwoEquations(angle, first, second, "determinant")
