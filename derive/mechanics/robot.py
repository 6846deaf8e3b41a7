"""An open chain as an exercise gives it: rows of Denavit-Hartenberg parameters or free motions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import ZERO, Expr, Symbol, free_symbols, walk
from derive.mechanics.bodies import Body, coordinates, extent
from derive.mechanics.drives import Friction, Motor
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Axis, Motion, Move

JointType: TypeAlias = Literal["revolute", "prismatic", "helical", "fixed"]
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
class ScrewRow:
    """A joint by its axis in the base frame, all joints at zero: a turn by `by` about the axis `through` a
    point, `pitch` metres along it a radian; or a slide by `by` along it."""

    axis: Axis
    through: tuple[Expr, Expr, Expr]
    by: Expr
    pitch: Expr = ZERO
    slide: bool = False


Row: TypeAlias = DHRow | FreeRow | ScrewRow


@dataclass(frozen=True, slots=True)
class Link:
    """Row i, the body it carries, and the motor and friction of its joint. `variable` is the starred
    name, None for a fixed row; `range` holds the limits of the joint, in rad or m."""

    row: Row
    joint: JointType
    variable: str | None
    body: Body | None = None
    motor: Motor | None = None
    friction: Friction | None = None
    range: tuple[Expr, Expr] | None = None


@dataclass(frozen=True, slots=True)
class Robot:
    """An open chain from base to tool. `gravity` is the acceleration in the base frame (m/s^2); `home` is
    where the end-effector stands while all joints of a chain of screws are at zero."""

    name: str
    convention: Convention
    links: tuple[Link, ...]
    base: tuple[Move, ...] = ()
    tool: tuple[Move, ...] = ()
    gravity: tuple[Expr, Expr, Expr] | None = None
    home: Motion | ByMatrix | None = None

    @property
    def by_screws(self) -> bool:
        """Whether the joints are given by their axes in the base frame."""
        return any(isinstance(link.row, ScrewRow) for link in self.links)

    @property
    def ends_in_tool(self) -> bool:
        """Whether the end-effector has a frame of its own after the last row."""
        return bool(self.tool) or self.home is not None

    @property
    def variables(self) -> tuple[str, ...]:
        """The joint variables in order."""
        return tuple(link.variable for link in self.links if link.variable)

    @property
    def ranges(self) -> dict[str, tuple[Expr, Expr]]:
        """The limits of the joints that have some, by their variables."""
        return {link.variable: link.range for link in self.links if link.variable and link.range}

    @property
    def coupled(self) -> bool:
        """Whether a joint variable stands in more than one place of the rows, the base and the tool."""
        nodes = (node for tree in self.motions() for node in walk(tree) if isinstance(node, Symbol))
        return sum(node.name in self.variables for node in nodes) > len(self.variables)

    @property
    def shifting(self) -> bool:
        """Whether a joint variable stands in the com or the inertia of a body."""
        bodies = [link.body for link in self.links if link.body]
        trees = (tree for body in bodies for tree in (*extent(body.inertia), *coordinates(body)))
        return any(not free_symbols(tree).isdisjoint(self.variables) for tree in trees)

    def motions(self) -> Iterator[Expr]:
        """What the rows, the base and the tool turn and slide by."""
        for link in self.links:
            match link.row:
                case DHRow(theta, d, a, alpha):
                    yield from (theta, d, a, alpha)
                case FreeRow(made):
                    yield from (move.by for move in made)
                case ScrewRow(by=by):
                    yield by
        yield from (move.by for move in (*self.base, *self.tool))
