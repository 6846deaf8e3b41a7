"""The rows of a robot as authors write them, with the bodies they carry."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from derive.expression import ONE, ZERO, Expr
from derive.kinds.fields import (
    Angle,
    InertiaMoment,
    Length,
    Mass,
    OptionsModel,
    Point,
    Quantity,
    StarredAngle,
    StarredLength,
    StarredQuantity,
)
from derive.mechanics.bodies import Body, Box, Cylinder, Inertia, Moments, PointMass, Rod, Sphere
from derive.mechanics.drives import Friction, Motor
from derive.sheet.faults import NO_FORM
from derive.sheet.subjects.moves import MoveJointField, Named
from derive.sheet.subjects.screws import ScrewField

SHAPES = ("box", "rod", "cylinder", "sphere")


class BoxShape(OptionsModel):
    """Sides along x, y, z."""

    box: tuple[Length, Length, Length]
    """The sides along x, y and z."""


class RodShape(OptionsModel):
    """A thin rod along an axis."""

    rod: Length
    """The length."""
    axis: Named
    """The axis along which it lies."""


class RoundSection(OptionsModel):
    """Radius and length."""

    radius: Length
    """The radius."""
    length: Length
    """The length."""


class CylinderShape(OptionsModel):
    """A cylinder about an axis."""

    cylinder: RoundSection
    """Its radius and length."""
    axis: Named
    """The axis about which it is round."""


class SphereShape(OptionsModel):
    """A solid sphere."""

    sphere: Length
    """The radius."""


def _inertia_form(value: Any) -> str | None:
    if isinstance(value, list) and value and isinstance(value[0], list):
        return "=matrix"
    if isinstance(value, list):
        return "=six" if len(value) > 3 else "=three"
    if isinstance(value, dict):
        return next((f"={shape}" for shape in SHAPES if shape in value), None)
    return "=point" if value == "point" else None


def _com_form(value: Any) -> str | None:
    if isinstance(value, list):
        return "=point"
    return "=center" if value == "center" else None


M: TypeAlias = InertiaMoment
Row: TypeAlias = tuple[M, M, M]
InertiaField: TypeAlias = Annotated[
    Annotated[tuple[M, M, M], Tag("=three")]
    | Annotated[tuple[M, M, M, M, M, M], Tag("=six")]
    | Annotated[tuple[Row, Row, Row], Tag("=matrix")]
    | Annotated[BoxShape, Tag("=box")]
    | Annotated[RodShape, Tag("=rod")]
    | Annotated[CylinderShape, Tag("=cylinder")]
    | Annotated[SphereShape, Tag("=sphere")]
    | Annotated[Literal["point"], Tag("=point")],
    Discriminator(
        _inertia_form,
        custom_error_type=NO_FORM,
        custom_error_message="an inertia is point, [Ixx, Iyy, Izz], a matrix or a shape as {rod: L, axis: x}",
    ),
]
ComField: TypeAlias = Annotated[
    Annotated[Point, Tag("=point")] | Annotated[Literal["center"], Tag("=center")],
    Discriminator(
        _com_form,
        custom_error_type=NO_FORM,
        custom_error_message="a center of mass is center, or a point as [-L/2, 0, 0]",
    ),
]


class MotorField(OptionsModel):
    """A rotor's inertia about its axis, and how many times as fast as the joint it turns."""

    inertia: InertiaMoment
    """The moment of inertia of the rotor about its axis."""
    ratio: Quantity = ONE
    """How many times as fast as the joint the rotor turns."""


class FrictionField(OptionsModel):
    """Friction in a joint: viscous * rate + coulomb * sign(rate)."""

    viscous: Quantity = ZERO
    """What the rate is multiplied with."""
    coulomb: Quantity = ZERO
    """What acts against the motion whatever the rate."""


class Carried(OptionsModel):
    """The body of a link, in the link's own frame; what its joint adds, and the limits of it, its `range`."""

    mass: Mass | None = None
    """The mass of the link."""
    com: ComField | None = None
    """Its centre of mass in the link's own frame; center is the middle between the origins of this frame and
    the one before."""
    inertia: InertiaField | None = None
    """About the centre of mass: [Ixx, Iyy, Izz], these with Ixy, Iyz, Ixz (entries of the matrix, signs
    included), the matrix, a shape of the same density, or point."""
    about: Literal["com", "origin"] = "com"
    """About which point the inertia is given."""
    motor: MotorField | None = None
    """The rotor that drives the joint."""
    friction: FrictionField | None = None
    """The friction in the joint."""
    range: tuple[Quantity, Quantity] | None = None
    """The limits of the joint, as [-90 deg, 90 deg]."""


class DHLink(Carried):
    """A Denavit-Hartenberg row."""

    theta: StarredAngle
    """The angle about z; with a star, the variable of a revolute joint, as theta1* or theta1* + 90 deg."""
    d: StarredLength
    """The distance along z; with a star, the variable of a prismatic joint, as d3*."""
    a: Length
    """The distance along x, the length of the link."""
    alpha: Angle
    """The angle about x, the twist of the link."""


class FreeLink(Carried):
    """A row that follows no convention: moves about current axes."""

    motion: Annotated[list[MoveJointField], Field(min_length=1, max_length=20)]
    """The moves, of which one has the starred variable of the joint."""


class ScrewLink(Carried):
    """A joint by its axis in the base frame while all joints are at zero."""

    screw: ScrewField
    """The axis of the joint."""
    variable: StarredQuantity
    """The starred variable of the joint, as theta1*."""


def _link_form(value: Any) -> str:
    keys = value if isinstance(value, dict) else ()
    return next((f"={form}" for form in ("motion", "screw") if form in keys), "=row")


LinkField: TypeAlias = Annotated[
    Annotated[DHLink, Tag("=row")]
    | Annotated[FreeLink, Tag("=motion")]
    | Annotated[ScrewLink, Tag("=screw")],
    Discriminator(_link_form),
]
BODY_KEYS = {
    "mass": "add mass: m",
    "com": "add com: center, or the point of the link's own frame, as [-L/2, 0, 0]",
    "inertia": "add inertia: point, or [Ixx, Iyy, Izz], or a shape such as {rod: L, axis: x}",
}


def lacking(given: Carried) -> list[str]:
    """The keys that are missing of a body that is given in part."""
    values = {"mass": given.mass, "com": given.com, "inertia": given.inertia}
    missing = [key for key, value in values.items() if value is None]
    return missing if len(missing) < len(values) else []


def body(given: Carried) -> Body | None:
    """The body of a link, None where none is given or part of it is missing."""
    if given.mass is None or given.com is None or given.inertia is None:
        return None
    return Body(given.mass, given.com, _inertia(given.inertia), given.about)


def whole_matrix(given: Carried) -> tuple[tuple[Expr, Expr, Expr], ...]:
    """The rows of an inertia that is given as a matrix; none of any other."""
    match given.inertia:
        case ((_, _, _), (_, _, _), (_, _, _)) as rows:
            return rows
    return ()


def motor(given: Carried) -> Motor | None:
    """The motor of a link's joint, None where none is given."""
    return Motor(given.motor.inertia, given.motor.ratio) if given.motor else None


def friction(given: Carried) -> Friction | None:
    """The friction in a link's joint, None where none is given."""
    return Friction(given.friction.viscous, given.friction.coulomb) if given.friction else None


def _inertia(given: InertiaField) -> Inertia:
    match given:
        case BoxShape(box=sides):
            return Box(sides)
        case RodShape(rod=length, axis=axis):
            return Rod(length, axis)
        case CylinderShape(cylinder=section, axis=axis):
            return Cylinder(section.radius, section.length, axis)
        case SphereShape(sphere=radius):
            return Sphere(radius)
        case ((ixx, ixy, ixz), (_, iyy, iyz), (_, _, izz)):
            return Moments((ixx, iyy, izz, ixy, iyz, ixz))
        case (ixx, iyy, izz):
            return Moments((ixx, iyy, izz, ZERO, ZERO, ZERO))
        case (ixx, iyy, izz, ixy, iyz, ixz):
            return Moments((ixx, iyy, izz, ixy, iyz, ixz))
        case _:
            return PointMass()
