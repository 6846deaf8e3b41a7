"""What a spherical wrist determines where its outer axes coincide: a sum or difference of two angles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix, trig_of
from derive.algebra.scalar import Scalar
from derive.expression import Degrees, Expr, Matrix, Symbol, add, atan2, negate, number


@dataclass(frozen=True, slots=True)
class Case:
    """The middle angle at which it happens, first + sign * last, and the value of that."""

    middle: Degrees
    joints: tuple[str, str, str]
    sign: int
    value: Expr

    @property
    def determined(self) -> Expr:
        first, _, last = map(Symbol, self.joints)
        return add(first, last if self.sign > 0 else negate(last))


def cases(made: Matrix, known: Matrix, joints: tuple[str, str, str], even: bool) -> Iterator[Case]:
    """`made` is the wrist's rotation in its angles, `known` its entries by name; `even` where the middle
    angle is known by its cosine."""
    for degrees in (0, 180) if even else (90, -90):
        middle = Degrees(number(degrees).value)
        R = normal_matrix(made, {Symbol(joints[1]): middle})
        found = _combination(R, known, joints)
        if found:
            yield Case(middle, joints, *found)


def _combination(R: ScalarMatrix, known: Matrix, joints: tuple[str, str, str]) -> tuple[int, Expr] | None:
    """The sum or difference of the outer angles that stands in R by its cosine and sine, with few signs."""
    first, last = Scalar.symbol(joints[0]), Scalar.symbol(joints[2])
    found = []
    for sign in (1, -1):
        c, s = trig_of(first + last * sign)
        for (sine, minuses), (cosine, more) in product(_entries(R, known, s), _entries(R, known, c)):
            found.append((minuses + more, sign, atan2(sine, cosine)))
    return min(found, key=lambda each: each[0])[1:] if found else None


def _entries(R: ScalarMatrix, known: Matrix, value: Scalar) -> Iterator[tuple[Expr, int]]:
    """The names of the entries that have this value, with their signs."""
    for i, j in product(range(3), repeat=2):
        if R[i, j] == value:
            yield known.rows[i][j], 0
        elif R[i, j] == -value:
            yield negate(known.rows[i][j]), 1
