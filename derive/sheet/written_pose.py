"""Poses and rotations written out as matrices: their shape, and that they are rigid."""

from __future__ import annotations

from itertools import combinations

from derive.algebra.formulas.quantities import rational
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.expression import Expr, Matrix
from derive.mechanics.frames import ByMatrix
from derive.mechanics.lines import dot
from derive.sheet.nearest import Axes, nearest_rotation, typed_places
from derive.sheet.source import At
from derive.sheet.subjects.registry import Known

SIZES = "give 4 rows of 4 (a homogeneous transform) or 3 of 3 (a rotation)"


def by_matrix(matrix: list[list[Expr]], whose: str, at: At, known: Known) -> ByMatrix:
    """A transform (4 rows) or a rotation (3) written out. Raises SheetErrors where it is neither."""
    size = len(matrix)
    if size not in (3, 4):
        raise at.error(f"a matrix of {size} rows", (), SIZES)
    for index, row in enumerate(matrix):
        if len(row) != size:
            raise at.error(f"a row of {len(row)} in a matrix of {size} rows", (index,), SIZES)
    rows = tuple(tuple(row) for row in matrix)
    _require_last_row(rows, at)
    columns = [(rows[0][j], rows[1][j], rows[2][j]) for j in range(3)]
    exact, places = orthonormal(columns, "columns", whose, at, known)
    turned = [(exact[0][i], exact[1][i], exact[2][i], *rows[i][3:]) for i in range(3)]
    return ByMatrix(Matrix((*turned, *rows[3:])), places)


def _require_last_row(rows: tuple[tuple[Expr, ...], ...], at: At) -> None:
    if len(rows) == 4 and [rational(entry) for entry in rows[3]] != [0, 0, 0, 1]:
        message = "the last row of a homogeneous transform is 0, 0, 0, 1"
        raise at.error(message, (3,), "write [0, 0, 0, 1]")


def orthonormal(axes: Axes, what: str, whose: str, at: At, known: Known) -> tuple[Axes, int]:
    """The axes and 0; or those of the nearest rotation, and the places to which the ones typed were rounded.

    Raises SheetErrors with the product that fails, where they are no rotation.
    """
    if product := _failed_product(axes, known):
        nearest, places = nearest_rotation(axes, known.where)
        if nearest:
            return nearest, places
        message = f"the {what} of {whose} are not right-handed and orthonormal: {product}"
        hint = "check the signs and that every axis has length 1"
        hint += "; rounded numbers need three digits or more" if typed_places(axes) else ""
        raise at.error(message, (), hint)
    return axes, 0


def _failed_product(axes: Axes, known: Known) -> str:
    """The first product that fails, decided exactly: "x . y = 1/2, not 0"; empty if all is well."""
    x, y, z = (ScalarMatrix.column([normal(entry, known.values) for entry in axis]) for axis in axes)
    every = dict(zip("xyz", (x, y, z), strict=True))
    for a, b in (*((letter, letter) for letter in every), *combinations(every, 2)):
        product = dot(every[a], every[b])
        if product != (wanted := int(a == b)):
            return f"{a} . {b}{_said(product)}, not {wanted}"
    return "" if x.cross(y) == z else "x cross y is -z, not z"


def _said(product: Scalar) -> str:
    value = product.constant
    if value is None:
        return " depends on symbols"
    return f" = {value}" if value.denominator < 1000 else f" = {float(value):.8g}"
