"""An axis as the author sees it, `0.6*x2 - 0.8*y2`, read as its weights along the parent's axes."""

from __future__ import annotations

from collections.abc import Sequence

from derive.expression import ZERO, Expr, Product, Quotient, Sum, Symbol, add, free_symbols, multiply


class WeightsError(ValueError):
    """The expression is no combination of the axes."""


def weights(expr: Expr, axes: Sequence[str]) -> tuple[Expr, Expr, Expr]:
    """The factors of the three axes in a linear combination. Raises WeightsError."""
    x, y, z = (_factor(expr, axis, axes) for axis in axes)
    return x, y, z


def _factor(expr: Expr, axis: str, axes: Sequence[str]) -> Expr:
    match expr:
        case Symbol(name) if name in axes:
            return multiply() if name == axis else ZERO
        case Sum(terms):
            return add(*(_factor(term, axis, axes) for term in terms))
        case Product(factors):
            return _of_product(factors, axis, axes)
        case Quotient(top, bottom) if not free_symbols(bottom) & set(axes):
            above = _factor(top, axis, axes)
            return ZERO if above == ZERO else above / bottom
    if expr == ZERO:
        return ZERO
    raise WeightsError(f"this is no combination of {', '.join(axes)}")


def _of_product(factors: tuple[Expr, ...], axis: str, axes: Sequence[str]) -> Expr:
    with_axes = [factor for factor in factors if free_symbols(factor) & set(axes)]
    if len(with_axes) != 1:
        raise WeightsError(f"this is no combination of {', '.join(axes)}")
    inner = _factor(with_axes[0], axis, axes)
    return multiply(*(inner if factor is with_axes[0] else factor for factor in factors))
