"""Values as they were typed, with their units."""

from __future__ import annotations

from derive.expression import ZERO, Degrees, Expr, Measured, Number


def measured(value: Expr, unit: str = "") -> Expr:
    """A value with its unit, or with the one that its author gave it."""
    unit = unit or unit_of(value)
    return Measured(value, unit) if unit and value != ZERO else value


def unit_of(value: Expr) -> str:
    """The unit of a number; what degrees are divided by."""
    return value.unit if isinstance(value, Number | Degrees) and value.value else ""
