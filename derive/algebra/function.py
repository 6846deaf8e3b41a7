"""A function of several variables, and the constraints its variables obey."""

from __future__ import annotations

from dataclasses import dataclass

from derive.expression import Expr


@dataclass(frozen=True, slots=True)
class Constraint:
    """left = right."""

    left: Expr
    right: Expr


@dataclass(frozen=True, slots=True)
class Function:
    """`values` holds one expression for a scalar function, or the components of a `vector` function."""

    variables: tuple[str, ...]
    values: tuple[Expr, ...]
    constraints: tuple[Constraint, ...] = ()
    vector: bool = False
