"""A motion: rotations and translations made one after the other, about world or current axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import Expr

Axis: TypeAlias = Literal["x", "y", "z"] | tuple[Expr, Expr, Expr]


@dataclass(frozen=True, slots=True)
class Move:
    """One elementary motion: by an angle (rad) or a length (m) about or along an axis."""

    kind: Literal["rotate", "translate"]
    axis: Axis
    by: Expr
    about: Literal["world", "current"] = "current"


@dataclass(frozen=True, slots=True)
class Motion:
    """Moves in the order in which they are made."""

    moves: tuple[Move, ...]
