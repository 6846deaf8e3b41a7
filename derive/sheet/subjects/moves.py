"""Moves as authors write them: `{rotate: x, by: alpha, about: world}`."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Discriminator, Tag, ValidationInfo, field_validator

from derive.algebra.formulas.likely_mistakes import Doubt
from derive.algebra.formulas.quantities import rational
from derive.expression import Expr
from derive.kinds.fields import Angle, Formula, Length, OptionsModel, StarredAngle, StarredLength, doubt
from derive.mechanics.motion import Axis, Move
from derive.sheet.faults import NO_FORM
from derive.sheet.subjects.quaternions import length_of, turn_of

Named: TypeAlias = Literal["x", "y", "z"]
Vector: TypeAlias = tuple[Formula, Formula, Formula]


def _axis_form(value: Any) -> str:
    return "=vector" if isinstance(value, list | tuple) else "=name"


def _move_form(value: Any) -> str | None:
    keys = value if isinstance(value, dict) else vars(value) if isinstance(value, OptionsModel) else ()
    return next((f"={move}" for move in ("translate", "rotate", "quaternion") if move in keys), None)


_BY_FORM = Discriminator(
    _move_form,
    custom_error_type=NO_FORM,
    custom_error_message="a move is written {rotate: z, by: theta} or {translate: x, by: a}",
)


AxisField: TypeAlias = Annotated[
    Annotated[Named, Tag("=name")] | Annotated[Vector, Tag("=vector")], Discriminator(_axis_form)
]


class _Along(OptionsModel):
    @field_validator("rotate", "translate", check_fields=False)
    @classmethod
    def _has_direction(cls, axis: Axis) -> Axis:
        if isinstance(axis, tuple) and all(rational(entry) == 0 for entry in axis):
            raise ValueError("an axis of zero length has no direction")
        return axis


class Rotate(_Along):
    """A rotation about an axis through the origin."""

    rotate: AxisField
    """The axis, by its letter or as [1, 1, 0]."""
    by: Angle
    """The angle."""


class Translate(_Along):
    """A translation along an axis."""

    translate: AxisField
    """The direction, by its letter or as [1, 1, 0]."""
    by: Length
    """The distance."""


class About(OptionsModel):
    """World (fixed) axes, or the current ones."""

    about: Literal["world", "current", "fixed"] = "current"
    """The axes that are meant: those of the world (fixed), or those that were moved before."""


class RotateAbout(Rotate, About):
    """A rotation about a world or current axis."""


class TranslateAbout(Translate, About):
    """A translation along a world or current axis."""


class Quaternion(OptionsModel):
    """A turn given by a quaternion, scalar part first."""

    quaternion: tuple[Formula, Formula, Formula, Formula]
    """The quaternion, its scalar part first."""

    @field_validator("quaternion")
    @classmethod
    def _has_length(
        cls, parts: tuple[Expr, Expr, Expr, Expr], info: ValidationInfo
    ) -> tuple[Expr, Expr, Expr, Expr]:
        if all(rational(part) == 0 for part in parts):
            raise ValueError("a quaternion of zeros turns nothing into nothing")
        if (length := length_of(parts)) is not None:
            message = f"this quaternion has the length {length:.6g}, not 1; it is divided by it"
            doubt(Doubt(message, 0, "nothing is to be done if only its direction is meant"), info)
        return parts


class QuaternionAbout(Quaternion, About):
    """A turn by a quaternion in the axes of the world or the current ones."""


class RotateJoint(_Along):
    """A rotation that may be a joint's."""

    rotate: AxisField
    """The axis, by its letter or as [1, 1, 0]."""
    by: StarredAngle
    """The angle; with a star, the variable of a revolute joint."""


class TranslateJoint(_Along):
    """A translation that may be a joint's."""

    translate: AxisField
    """The direction, by its letter or as [1, 1, 0]."""
    by: StarredLength
    """The distance; with a star, the variable of a prismatic joint."""


MoveField: TypeAlias = Annotated[
    Annotated[Rotate, Tag("=rotate")]
    | Annotated[Translate, Tag("=translate")]
    | Annotated[Quaternion, Tag("=quaternion")],
    _BY_FORM,
]
MoveAboutField: TypeAlias = Annotated[
    Annotated[RotateAbout, Tag("=rotate")]
    | Annotated[TranslateAbout, Tag("=translate")]
    | Annotated[QuaternionAbout, Tag("=quaternion")],
    _BY_FORM,
]
MoveJointField: TypeAlias = Annotated[
    Annotated[RotateJoint, Tag("=rotate")] | Annotated[TranslateJoint, Tag("=translate")],
    _BY_FORM,
]


def move(given: Rotate | Translate | Quaternion) -> Move:
    """The move as a value."""
    about: Literal["world", "current"] = "current"
    if isinstance(given, About) and given.about != "current":
        about = "world"
    if isinstance(given, Rotate):
        return Move("rotate", given.rotate, given.by, about)
    if isinstance(given, Quaternion):
        axis, angle = turn_of(given.quaternion)
        return Move("rotate", axis or "z", angle, about, given.quaternion if axis else None)
    return Move("translate", given.translate, given.by, about)


def joint_move(given: RotateJoint | TranslateJoint) -> Move:
    """The move as a value, its star left out."""
    if isinstance(given, RotateJoint):
        return Move("rotate", given.rotate, given.by.expr)
    return Move("translate", given.translate, given.by.expr)
