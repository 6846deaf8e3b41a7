"""What a motion along one coordinate is asked to do: distances and limits, or places and times."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import ZERO, Expr

Sort: TypeAlias = Literal["length", "angle", ""]  # what moves; "" where nothing typed says it


@dataclass(frozen=True, slots=True)
class Units:
    """What follows a number: of a place, a velocity and an acceleration, and of a time."""

    motion: tuple[str, str, str] = ("", "", "")
    time: str = ""


NO_UNITS = Units()


@dataclass(frozen=True, slots=True)
class Axis:
    """A distance to be covered from rest to rest within a velocity, and an acceleration unless it is None."""

    distance: Expr
    v_max: Expr
    a_max: Expr | None


@dataclass(frozen=True, slots=True)
class Via:
    """A place to be passed at a time; `velocity` where it is prescribed."""

    time: Expr
    place: Expr
    velocity: Expr | None = None


@dataclass(frozen=True, slots=True)
class Journey:
    """From one place to another; None stands for what was not given.

    Velocities and accelerations at the ends are zero unless given. `cruise`, `acceleration` and `blend` say
    how a linear segment with parabolic blends is made: its velocity, its acceleration, or their duration.
    """

    start: Expr
    end: Expr
    start_velocity: Expr
    end_velocity: Expr
    start_acceleration: Expr
    end_acceleration: Expr
    via: tuple[Via, ...] = ()
    cruise: Expr | None = None
    acceleration: Expr | None = None
    blend: Expr | None = None
    v_max: Expr | None = None
    a_max: Expr | None = None

    @property
    def begins_at_rest(self) -> bool:
        """Whether no velocity is given at the start."""
        return self.start_velocity == ZERO

    @property
    def ends_at_rest(self) -> bool:
        """Whether none is given at the end."""
        return self.end_velocity == ZERO


@dataclass(frozen=True, slots=True)
class JointPath:
    """Axes that go together along a path: each a function of the parameter, between two values of it, within
    limits of velocity (none where the list is empty) and acceleration."""

    parameter: str
    places: tuple[Expr, ...]
    between: tuple[Expr, Expr]
    v_max: tuple[Expr, ...]
    a_max: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Profile:
    """Axes to be moved within limits, a journey, or a path; `time` is the whole duration where given."""

    axes: tuple[Axis, ...] = ()
    journey: Journey | None = None
    time: Expr | None = None
    sort: Sort = ""
    units: Units = NO_UNITS
    path: JointPath | None = None

    @property
    def defines(self) -> frozenset[str]:
        """The parameter of the path, which the answer uses as its author does."""
        return frozenset({self.path.parameter}) if self.path else frozenset()
