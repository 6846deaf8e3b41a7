"""Paths: where a point goes, as a function of a parameter, as its author describes it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import Expr, Matrix
from derive.mechanics.motion import Axis, Move
from derive.mechanics.robot import Robot

Place: TypeAlias = tuple[Expr, ...]  # two coordinates or three


@dataclass(frozen=True, slots=True)
class Line:
    """Straight from one place to another."""

    start: Place
    end: Place


@dataclass(frozen=True, slots=True)
class Arc:
    """Part of a circle, or of a helix where there is a `pitch`, the way along the axis a turn.

    `start` is the place where it begins, or else (not `placed`) the direction to it from the center. Without
    a `radius` that is how far the place is away. In the plane there is no axis. It turns by `angle`,
    counterclockwise as seen from the tip of the axis.
    """

    center: Place
    radius: Expr | None
    axis: Axis | None
    start: Place
    placed: bool
    angle: Expr
    pitch: Expr | None = None
    turns: Expr | None = None  # of a helix


@dataclass(frozen=True, slots=True)
class Curve:
    """Coordinates as functions of a parameter between two values of it, if these are given."""

    parameter: str
    value: Matrix  # a column
    between: tuple[Expr, Expr] | None


@dataclass(frozen=True, slots=True)
class Via:
    """Places that are passed at these times, the first and the last its ends, by a cubic spline: at rest at
    the ends, or without acceleration there where they are natural."""

    places: tuple[Place, ...]
    times: tuple[Expr, ...]
    ends: Literal["clamped", "natural"] = "clamped"


Shape: TypeAlias = Line | Arc | Curve | Via


@dataclass(frozen=True, slots=True)
class Timing:
    """How the parameter goes from rest to rest: by a polynomial in a time, or with a trapezoidal velocity by
    two of the time, the greatest velocity and the acceleration along the path."""

    law: Literal["cubic", "quintic", "trapezoidal"]
    time: Expr | None
    v_max: Expr | None
    a_max: Expr | None


@dataclass(frozen=True, slots=True)
class Oriented:
    """An orientation: by moves or by a matrix; `angles` where it was given by those of a convention."""

    moves: tuple[Move, ...] = ()
    matrix: Matrix | None = None
    angles: tuple[Expr, Expr, Expr] | None = None


@dataclass(frozen=True, slots=True)
class Turned:
    """How a body turns while it goes along a path: from one orientation to another, in proportion to the
    parameter."""

    start: Oriented
    end: Oriented
    by: Literal["axis-angle", "euler-angles", "slerp"]
    convention: str


@dataclass(frozen=True, slots=True)
class Path:
    """A path of a point, how it goes along it in time, and how a body turns meanwhile, if these are given."""

    shape: Shape
    timing: Timing | None = None
    turned: Turned | None = None

    @property
    def along(self) -> bool:
        """Whether its limits are along it, and not, as those of a function, of its parameter."""
        return not isinstance(self.shape, Curve)

    @property
    def size(self) -> int:
        """How many coordinates it has, 2 or 3."""
        match self.shape:
            case Line(start=place) | Arc(center=place):
                return len(place)
            case Curve(value=value):
                return len(value.rows)
            case Via(places=places):
                return len(places[0])

    @property
    def defines(self) -> frozenset[str]:
        """The name of the parameter, which the answer uses as its author does."""
        return frozenset({self.shape.parameter}) if isinstance(self.shape, Curve) else frozenset()


@dataclass(frozen=True, slots=True)
class Carried:
    """A path along which the end-effector of an arm is carried: the names of both belong to one sheet."""

    path: Path
    arm: Robot

    @property
    def shape(self) -> Shape:
        """That of the path."""
        return self.path.shape

    @property
    def timing(self) -> Timing | None:
        """That of the path."""
        return self.path.timing

    @property
    def along(self) -> bool:
        """As of the path."""
        return self.path.along

    @property
    def variables(self) -> tuple[str, ...]:
        """The joint variables, in order."""
        return self.arm.variables

    @property
    def defines(self) -> frozenset[str]:
        """The parameter of the path."""
        return self.path.defines
