"""Whether three axes make a right-handed orthonormal frame, decided exactly in the normal form."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import TYPE_CHECKING, TypeAlias

from derive.expression import Expr, Symbol

if TYPE_CHECKING:
    from derive.algebra.scalar import Scalar

Vector: TypeAlias = Sequence["Scalar"]
LETTERS = "xyz"


def failed_product(axes: Sequence[tuple[Expr, Expr, Expr]], where: Mapping[str, Expr]) -> str:
    """The first product that fails, in words ("x . y is 1/2, not 0"); empty if all is well."""
    from derive.algebra.normal import normal

    names: dict[Expr, Expr] = {Symbol(name): value for name, value in where.items()}
    vectors = [[normal(entry, names) for entry in axis] for axis in axes]
    for letter, vector in zip(LETTERS, vectors, strict=True):
        if (length := _dot(vector, vector)) != 1:
            return f"{letter} . {letter}{_said(length)}, not 1"
    for i, j in combinations(range(3), 2):
        if product := _dot(vectors[i], vectors[j]):
            return f"{LETTERS[i]} . {LETTERS[j]}{_said(product)}, not 0"
    x, y, z = vectors
    return "" if _cross(x, y) == list(z) else "x cross y is -z, not z"


def _said(product: Scalar) -> str:
    value = product.constant
    if value is None:
        return " depends on symbols"
    return f" = {value}" if value.denominator < 1000 else f" = {float(value):.8g}"


def _dot(a: Vector, b: Vector) -> Scalar:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> list[Scalar]:
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
