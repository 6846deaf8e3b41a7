"""A linear system as equations in the Laplace domain."""

from __future__ import annotations

from dataclasses import dataclass

from derive.control.delays import Delay
from derive.expression import Expr, Symbol


@dataclass(frozen=True, slots=True)
class Equation:
    """left = right."""

    left: Expr
    right: Expr


@dataclass(frozen=True, slots=True)
class System:
    """Equations linear in their signals; `disturbance` is zero in the transfer function.

    `motor` says in words' terms which motor it is ("armature", "angle"), empty for any other. `delays` are
    those in whose place the equations have fractions.
    """

    equations: tuple[Equation, ...]
    input: Symbol
    output: Symbol
    disturbance: Symbol | None = None
    motor: tuple[str, ...] = ()
    delays: tuple[Delay, ...] = ()
