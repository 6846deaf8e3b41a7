"""An open chain as an exercise gives it: rows of Denavit-Hartenberg parameters or free motions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import ZERO, Expr, Symbol, negate
from derive.mechanics.bodies import Body
from derive.mechanics.motion import Move

JointType: TypeAlias = Literal["revolute", "prismatic", "fixed"]
Convention: TypeAlias = Literal["standard", "modified"]


@dataclass(frozen=True, slots=True)
class DHRow:
    """theta, d, a, alpha of one row (rad, m, m, rad), the joint variable included in its column."""

    theta: Expr
    d: Expr
    a: Expr
    alpha: Expr


@dataclass(frozen=True, slots=True)
class FreeRow:
    """A row that follows no DH convention: moves about current axes."""

    moves: tuple[Move, ...]


@dataclass(frozen=True, slots=True)
class Link:
    """Row i and the body it carries. `variable` is the starred name, None for a fixed row."""

    row: DHRow | FreeRow
    joint: JointType
    variable: str | None
    body: Body | None = None


@dataclass(frozen=True, slots=True)
class Robot:
    """An open chain from base to tool. `gravity` is the acceleration in the base frame (m/s^2)."""

    name: str
    convention: Convention
    links: tuple[Link, ...]
    base: tuple[Move, ...] = ()
    tool: tuple[Move, ...] = ()
    gravity: tuple[Expr, Expr, Expr] | None = None

    @property
    def variables(self) -> tuple[str, ...]:
        """The joint variables in order."""
        return tuple(link.variable for link in self.links if link.variable)


def gravity_of(robot: Robot) -> tuple[Expr, Expr, Expr]:
    """The acceleration of gravity in the base frame; g downwards along z where the sheet is silent."""
    return robot.gravity or (ZERO, ZERO, negate(Symbol("g")))
