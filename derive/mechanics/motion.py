"""A motion: rotations and translations made one after the other, about world or current axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import Expr, free_symbols

Axis: TypeAlias = Literal["x", "y", "z"] | tuple[Expr, Expr, Expr]


@dataclass(frozen=True, slots=True)
class Move:
    """One elementary motion: by an angle (rad) or a length (m) about or along an axis; a turn may be given by
    a `quaternion`, its scalar part first."""

    kind: Literal["rotate", "translate"]
    axis: Axis
    by: Expr
    about: Literal["world", "current"] = "current"
    quaternion: tuple[Expr, Expr, Expr, Expr] | None = None


@dataclass(frozen=True, slots=True)
class Motion:
    """Moves in the order in which they are made."""

    moves: tuple[Move, ...]

    @property
    def variables(self) -> tuple[str, ...]:
        """The names its moves are by, in the order of the product: world moves stand to the left."""
        found: tuple[str, ...] = ()
        for move in self.moves:
            names = tuple(sorted(free_symbols(move.by)))
            found = names + found if move.about == "world" else found + names
        return tuple(dict.fromkeys(found))
