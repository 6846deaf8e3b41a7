"""Joints by their screw axes as authors write them: `{axis: z, through: [0, 0, 0]}`, `{slide: x}`."""

from __future__ import annotations

from fractions import Fraction
from typing import Annotated, Any, TypeAlias

from pydantic import Discriminator, Field, Tag, field_validator

from derive.algebra.formulas.quantities import rational
from derive.expression import ZERO, Expr
from derive.kinds.fields import Length, OptionsModel, Point, Quantity
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Axis, Motion
from derive.mechanics.robot import JointType, ScrewRow
from derive.sheet.faults import NO_FORM
from derive.sheet.source import At
from derive.sheet.subjects.moves import AxisField, MoveField, move
from derive.sheet.subjects.registry import Known
from derive.sheet.written_pose import by_matrix

ORIGIN = (ZERO, ZERO, ZERO)
UNITS: dict[tuple[Fraction | int | None, ...], str] = {(1, 0, 0): "x", (0, 1, 0): "y", (0, 0, 1): "z"}


class _Directed(OptionsModel):
    @field_validator("axis", "slide", check_fields=False)
    @classmethod
    def _has_direction(cls, axis: Axis) -> Axis:
        """A letter where the direction is that of a coordinate axis."""
        if isinstance(axis, str):
            return axis
        parts = tuple(rational(entry) for entry in axis)
        if all(part == 0 for part in parts):
            raise ValueError("an axis of zero length has no direction")
        match UNITS.get(parts):
            case "x" | "y" | "z" as letter:
                return letter
            case _:
                return axis


class Turn(_Directed):
    """A turn about an axis in the base frame; with a pitch a helix."""

    axis: AxisField
    """The direction of the axis, in the base frame while all joints are at zero."""
    through: Point = ORIGIN
    """A point of the axis."""
    pitch: Length = ZERO
    """How far it moves along the axis in a radian."""


class Slide(_Directed):
    """A slide along a direction of the base frame."""

    slide: AxisField
    """The direction, in the base frame while all joints are at zero."""
    through: Point = ORIGIN
    """Where its axis is drawn."""


def _screw_form(value: Any) -> str | None:
    keys = value if isinstance(value, dict) else ()
    return next((f"={form}" for form in ("slide", "axis") if form in keys), None)


ScrewField: TypeAlias = Annotated[
    Annotated[Turn, Tag("=axis")] | Annotated[Slide, Tag("=slide")],
    Discriminator(
        _screw_form,
        custom_error_type=NO_FORM,
        custom_error_message="a screw is written {axis: z, through: [0, 0, 0]}, or {slide: x}",
    ),
]


def _home_form(value: Any) -> str:
    rows = value if isinstance(value, list) else ()
    return "=matrix" if rows and isinstance(rows[0], list) else "=motion"


HomeField: TypeAlias = Annotated[
    Annotated[Annotated[list[list[Quantity]], Field(max_length=20)], Tag("=matrix")]
    | Annotated[Annotated[list[MoveField], Field(max_length=20)], Tag("=motion")],
    Discriminator(_home_form),
]


def screw_row(given: Turn | Slide, by: Expr) -> ScrewRow:
    """The row as a value."""
    if isinstance(given, Slide):
        return ScrewRow(given.slide, given.through, by, slide=True)
    return ScrewRow(given.axis, given.through, by, given.pitch)


def joint_type(given: Turn | Slide) -> JointType:
    """A slide is prismatic; a turn is revolute, with a pitch helical."""
    if isinstance(given, Slide):
        return "prismatic"
    return "helical" if rational(given.pitch) != 0 else "revolute"


def home_pose(given: Any, at: At, known: Known) -> Motion | ByMatrix:
    """Where the end-effector stands at zero. Raises SheetErrors: a matrix that is no pose."""
    if given and isinstance(given[0], list):
        return by_matrix(given, "home", at, known)
    return Motion(tuple(move(entry) for entry in given))
