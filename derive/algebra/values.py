"""Scalars and matrices together: what the nodes of a tree do with values of either sort."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from operator import add
from typing import TypeAlias

from flint import fmpq_mpoly

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.roots_and_functions import absolute, root
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable

Value: TypeAlias = Scalar | ScalarMatrix
Combine: TypeAlias = Callable[[fmpq_mpoly, fmpq_mpoly], fmpq_mpoly]


def halved(parts: Sequence[fmpq_mpoly], combine: Combine) -> fmpq_mpoly:
    """Halves first: long sums are then copied a few times and not once for every term."""
    if len(parts) <= 2:
        return reduce(combine, parts)
    middle = len(parts) // 2
    return combine(halved(parts[:middle], combine), halved(parts[middle:], combine))


def total(values: list[Value]) -> Value:
    """The sum of scalars or of matrices; a matrix of one entry beside a scalar is one, as e^T n + b."""
    if any(isinstance(value, Scalar) for value in values):
        values = [v[0, 0] if isinstance(v, ScalarMatrix) and v.shape == (1, 1) else v for v in values]
    return reduce(add, values)


def product(values: list[Value]) -> Value:
    """The product of scalars and matrices in this order."""
    return reduce(times, values)


def times(left: Value, right: Value) -> Value:
    """The product of scalars, of matrices, or of one with the other."""
    if isinstance(left, ScalarMatrix):
        return left @ right if isinstance(right, ScalarMatrix) else left.scaled(right)
    return right.scaled(left) if isinstance(right, ScalarMatrix) else left * right


def raised(base: Value, power: int) -> Value:
    """An integer power of a scalar or a square matrix. Raises ZeroDivisionError for a negative one of what
    has no inverse."""
    if isinstance(base, Scalar):
        return base**power
    if power < 0:
        return raised(base.inverse(), -power)
    return reduce(ScalarMatrix.__matmul__, [base] * power, ScalarMatrix.identity(base.shape[0]))


def joined(rows: list[list[Value]]) -> ScalarMatrix:
    """Blocks joined into one matrix; a zero beside blocks stands for a block of zeros as high and as wide
    as they are, a row of zeros only for one as high as the row above it."""
    heights: list[int] = []
    for row in rows:
        blocks = [v.shape[0] for v in row if isinstance(v, ScalarMatrix)]
        empty = not blocks and not any(map(bool, row))
        heights.append(max(blocks, default=heights[-1] if empty and heights else 1))
    columns = zip(*rows, strict=True)
    widths = [max((v.shape[1] for v in each if isinstance(v, ScalarMatrix)), default=1) for each in columns]
    strips = [
        ScalarMatrix.beside([_block(v, (height, width)) for v, width in zip(row, widths, strict=True)])
        for row, height in zip(rows, heights, strict=True)
    ]
    return ScalarMatrix.stacked(strips)


def _block(value: Value, shape: tuple[int, int]) -> ScalarMatrix:
    if isinstance(value, ScalarMatrix):
        return value
    if shape != (1, 1) and value != 0:
        raise NotDerivable("a scalar beside a block of a matrix")
    return ScalarMatrix.of([[value] * shape[1]] * shape[0])


def scalar_of(value: Value) -> Scalar:
    """A scalar; a matrix of one entry is one. Raises NotDerivable for any other matrix."""
    if not isinstance(value, ScalarMatrix):
        return value
    if value.shape != (1, 1):
        raise NotDerivable("a matrix stands where a scalar is needed")
    return value[0, 0]


def length(value: Value) -> Scalar:
    """|x| of a scalar or of a column."""
    if isinstance(value, Scalar):
        return absolute(value)
    return root(scalar_of(value.T @ value))


def matrix_of(value: Value) -> ScalarMatrix:
    """A matrix as it is, a scalar as one of shape (1, 1)."""
    return value if isinstance(value, ScalarMatrix) else ScalarMatrix.of([[value]])


MATRIX_FUNCTIONS: dict[str, Callable[..., Value]] = {
    "transpose": lambda a: a.T,
    "inverse": lambda a: a.inverse(),
    "cross": lambda a, b: a.cross(b),
    "det": lambda a: a.det(),
    "adj": lambda a: a.adjugate(),
}
