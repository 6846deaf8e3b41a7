"""The body of a link as an exercise gives it: mass, centre of mass, and inertia or the shape that has it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import Expr

AxisName: TypeAlias = Literal["x", "y", "z"]


@dataclass(frozen=True, slots=True)
class Moments:
    """Ixx, Iyy, Izz, Ixy, Iyz, Ixz: elements of the inertia matrix about the com, signs included."""

    values: tuple[Expr, Expr, Expr, Expr, Expr, Expr]


@dataclass(frozen=True, slots=True)
class Box:
    """A solid cuboid; sides along x, y, z of the link's frame."""

    sides: tuple[Expr, Expr, Expr]


@dataclass(frozen=True, slots=True)
class Rod:
    """A thin rod along an axis."""

    length: Expr
    axis: AxisName


@dataclass(frozen=True, slots=True)
class Cylinder:
    """A solid cylinder about an axis."""

    radius: Expr
    length: Expr
    axis: AxisName


@dataclass(frozen=True, slots=True)
class Sphere:
    """A solid sphere."""

    radius: Expr


@dataclass(frozen=True, slots=True)
class PointMass:
    """No extent, no inertia about its own centre."""


Inertia: TypeAlias = Moments | Box | Rod | Cylinder | Sphere | PointMass


@dataclass(frozen=True, slots=True)
class Body:
    """What dynamics needs of a link. `com` is in the link's own frame (m); "center" is the middle
    between the origins of this frame and the one before. `inertia` is about the com, or, with a com
    in coordinates, about the origin of the frame."""

    mass: Expr
    com: tuple[Expr, Expr, Expr] | Literal["center"]
    inertia: Inertia
    about: Literal["com", "origin"] = "com"


def coordinates(body: Body) -> tuple[Expr, ...]:
    """Those of the com; none where it is "center"."""
    return () if body.com == "center" else body.com


def extent(inertia: Inertia) -> tuple[Expr, ...]:
    """What stands in it: moments, or the lengths of a shape."""
    match inertia:
        case Moments(values) | Box(values):
            return values
        case Cylinder(radius, length):
            return radius, length
        case Rod(size) | Sphere(size):
            return (size,)
        case PointMass():
            return ()
