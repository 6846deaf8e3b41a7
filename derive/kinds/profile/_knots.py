"""The points of a cubic spline, the linear system for the velocities there, and the pieces between them
(Siciliano et al., section 4.2.2; Craig, section 7.3)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import number as value_of
from derive.algebra.scalar import Scalar
from derive.expression import Approximate, Degrees, Expr, Matrix, Number, free_symbols
from derive.kinds.profile._pieces import Span
from derive.kinds.work import Work

SHORT = 9  # characters of a fraction that is still read
Ends = Literal["clamped", "natural"]


@dataclass(frozen=True, slots=True)
class Knots:
    """The points with their times, what the velocity is where it is given, and the working they are in."""

    times: tuple[Expr, ...]
    places: tuple[Expr, ...]
    velocities: tuple[Expr | None, ...]
    ends: Ends
    working: Work

    @property
    def spans(self) -> int:
        """How many pieces there are."""
        return len(self.times) - 1

    def scalars(self, trees: Sequence[Expr]) -> list[Scalar]:
        """Their normal forms in the symbols of the sheet."""
        return [self.working.scalar(tree) for tree in trees]


def system(knots: Knots) -> tuple[ScalarMatrix, ScalarMatrix]:
    """A v = b: a row for every point, a velocity that is given or an acceleration that is the same on both
    sides; none at a natural end."""
    t, q = knots.scalars(knots.times), knots.scalars(knots.places)
    h = [t[k + 1] - t[k] for k in range(knots.spans)]
    slope = [(q[k + 1] - q[k]) / h[k] for k in range(knots.spans)]
    rows, right = [], []
    last = knots.spans
    for k, given in enumerate(knots.velocities):
        row = [Scalar.of(0)] * (last + 1)
        if given is not None:
            row[k], value = Scalar.of(1), knots.working.scalar(given)
        elif k == 0:
            row[0], row[1], value = Scalar.of(2), Scalar.of(1), slope[0] * 3
        elif k == last:
            row[-2], row[-1], value = Scalar.of(1), Scalar.of(2), slope[-1] * 3
        else:
            row[k - 1], row[k], row[k + 1] = h[k], (h[k - 1] + h[k]) * 2, h[k - 1]
            value = (slope[k - 1] * h[k] + slope[k] * h[k - 1]) * 3
        rows.append(row)
        right.append(value)
    return ScalarMatrix.of(rows), ScalarMatrix.column(right)


def span_of(knots: Knots, velocities: Sequence[Scalar], k: int) -> Span:
    """The cubic between two points with the velocities there (Craig, section 7.3)."""
    t, q = knots.scalars(knots.times[k : k + 2]), knots.scalars(knots.places[k : k + 2])
    h = t[1] - t[0]
    slope, before, after = (q[1] - q[0]) / h, velocities[k], velocities[k + 1]
    upper = (slope * 3 - before * 2 - after) / h, (before + after - slope * 2) / (h * h)
    coefficients = (q[0], before, *upper)
    return Span(knots.times[k], knots.times[k + 1], tuple(map(knots.working.readable, coefficients)))


def plain(A: ScalarMatrix, knots: Knots) -> Matrix:
    """The matrix of the system as it is written."""
    return Matrix(tuple(tuple(knots.working.problem.readable(entry) for entry in row) for row in A.rows))


def read(expr: Expr, decimals: bool) -> Expr:
    """A fraction that is too long to be read, rounded; where the author typed decimals, any that does not
    end. Degrees stay as they are: a rounded number has no unit."""
    if free_symbols(expr) or isinstance(expr, Degrees):
        return expr
    endless = isinstance(expr, Number) and not expr.decimal and expr.value.denominator > 1
    return Approximate(value_of(expr, {})) if len(text(expr)) > SHORT or (decimals and endless) else expr
