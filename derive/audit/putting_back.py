"""Answers put back into what they answer: two sides that must be one at a point."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import sympy

from derive.audit.asked import Holds
from derive.audit.points import NEAR, ROUNDED, Number, Point, Value, agree, floating


def put_back(
    name: str, point: Point, left: Any, right: Any, said: str, near: mpmath.mpf | None = None
) -> Holds:
    """Whether two values (or lists or matrices of them) are one at the point; `said` where they are not.

    Each is of SymPy expressions or of numbers. Where floats are in them they agree to the digits of floats.
    """
    one, other = flat(left, point), flat(right, point)
    scale = max((abs(floating(each)) for each in (*one, *other)), default=mpmath.mpf(1)) or 1
    close = near or (ROUNDED if rounded(left) or rounded(right) else NEAR)
    same = len(one) == len(other)
    return Holds(name, same and all(agree(a, b, scale, close) for a, b in zip(one, other, strict=True)), said)


def vanishes(
    name: str, point: Point, exprs: Iterable[sympy.Expr], values: Mapping[sympy.Symbol, sympy.Expr], said: str
) -> Holds:
    """Whether expressions vanish with these values of their symbols, as far as their terms are sure."""
    there = placed(point, values)
    near = ROUNDED if rounded(list(values.values())) else NEAR
    same = all(agree(there.at(expr), Fraction(0), _size(expr, there) or 1, near) for expr in exprs)
    return Holds(name, same, "" if same else said)


def placed(point: Point, values: Mapping[sympy.Symbol, sympy.Expr]) -> Point:
    """The point with these values of symbols; one that stands for itself is left as it is."""
    return point.where(**{key.name: value for key, value in values.items() if value != key})


def _size(expr: sympy.Expr, there: Point) -> mpmath.mpf:
    """That of its terms all together, were it multiplied out."""
    if expr.is_Add:
        return mpmath.fsum(_size(term, there) for term in expr.args)
    if expr.is_Mul:
        return mpmath.fprod(_size(factor, there) for factor in expr.args)
    if expr.is_Pow and expr.exp.is_Integer and expr.exp > 0:
        return _size(expr.base, there) ** int(expr.exp)
    return abs(floating(there.at(expr)))


def rounded(exprs: Any) -> bool:
    """Whether there is a float in what was read."""
    if isinstance(exprs, list | tuple):
        return any(map(rounded, exprs))
    return isinstance(exprs, sympy.MatrixBase | sympy.Basic) and bool(exprs.has(sympy.Float))


def flat(value: Any, point: Point) -> list[Number]:
    """The numbers of a value in a row."""
    if isinstance(value, list | tuple):
        return [each for part in value for each in flat(part, point)]
    if isinstance(value, np.ndarray):
        return flat(value.tolist(), point)
    if isinstance(value, sympy.MatrixBase):
        return flat(list(value), point)
    return [point.at(value) if isinstance(value, sympy.Basic) else value]


def told(matrix: sympy.Matrix, point: Point) -> Value:
    """The numbers of a matrix as the JSON has them: rows, or a flat list of one column."""
    return point.each(list(matrix) if matrix.cols == 1 else matrix)


def array(exprs: Any, point: Point) -> np.ndarray[Any, Any]:
    """A matrix of expressions in numbers; one of numbers as it is."""
    return exprs if isinstance(exprs, np.ndarray) else np.array(point.each(exprs), dtype=object)


def is_real(value: Number) -> bool:
    """Whether a number has no imaginary part but for what the digits leave."""
    return not isinstance(value, mpmath.mpc) or bool(abs(value.imag) <= NEAR * max(1, abs(value)))
