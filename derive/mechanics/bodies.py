"""The body of a link: mass, centre of mass, and moments of inertia of the usual shapes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import ZERO, Expr, add, multiply, number, squared

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
    between the origins of this frame and the one before. `inertia` is about the com."""

    mass: Expr
    com: tuple[Expr, Expr, Expr] | Literal["center"]
    inertia: Inertia


def moments(body: Body) -> tuple[Expr, Expr, Expr, Expr, Expr, Expr]:
    """Ixx, Iyy, Izz, Ixy, Iyz, Ixz of a body about its com (Beer and Johnston, inside back cover)."""
    match body.inertia:
        case Moments(values):
            return values
        case PointMass():
            return (ZERO,) * 6
        case Sphere(r):
            round_ = _times("2/5", body.mass, squared(r))
            return round_, round_, round_, ZERO, ZERO, ZERO
        case Box((a, b, c)):
            pairs = ((b, c), (a, c), (a, b))
            diagonal = [_times("1/12", body.mass, add(squared(p), squared(q))) for p, q in pairs]
            return diagonal[0], diagonal[1], diagonal[2], ZERO, ZERO, ZERO
        case Rod(length, axis):
            return _about(axis, ZERO, _times("1/12", body.mass, squared(length)))
        case Cylinder(r, h, axis):
            across = add(_times("1/4", body.mass, squared(r)), _times("1/12", body.mass, squared(h)))
            return _about(axis, _times("1/2", body.mass, squared(r)), across)


def _about(axis: AxisName, along: Expr, across: Expr) -> tuple[Expr, Expr, Expr, Expr, Expr, Expr]:
    x, y, z = (along if name == axis else across for name in ("x", "y", "z"))
    return x, y, z, ZERO, ZERO, ZERO


def _times(fraction: str, *factors: Expr) -> Expr:
    return multiply(number(fraction), *factors)
