"""The body of a link: mass, centre of mass, and moments of inertia of the usual shapes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.expression import ZERO, Expr, add, multiply, number

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


Six: TypeAlias = tuple[Expr, Expr, Expr, Expr, Expr, Expr]


def moments(body: Body) -> Six:
    """Ixx, Iyy, Izz, Ixy, Iyz, Ixz of a body about its com (Beer and Johnston, inside back cover)."""
    if body.about == "com":
        return given_moments(body)
    pairs = zip(given_moments(body), steiner(body), strict=True)
    xx, yy, zz, xy, yz, xz = (given + (-shift if shift != ZERO else ZERO) for given, shift in pairs)
    return xx, yy, zz, xy, yz, xz


def steiner(body: Body) -> Six:
    """m (c^T c 1 - c c^T) as six elements: what the inertia about the origin has more than that about
    the com. Raises ValueError for a com without coordinates."""
    if body.com == "center":
        raise ValueError("the com has no coordinates yet")
    x, y, z = body.com
    xx, yy, zz = (_times("1", body.mass, _square_sum(*pair)) for pair in ((y, z), (x, z), (x, y)))
    xy, yz, xz = (_times("-1", body.mass, p, q) for p, q in ((x, y), (y, z), (x, z)))
    return xx, yy, zz, xy, yz, xz


def _square_sum(p: Expr, q: Expr) -> Expr:
    return add(*(part**2 for part in (p, q) if part != ZERO))


def given_moments(body: Body) -> Six:
    """The six elements as the sheet has them, or those of its shape about its com."""
    match body.inertia:
        case Moments(values):
            return values
        case PointMass():
            return (ZERO,) * 6
        case Sphere(r):
            round_ = _times("2/5", body.mass, r**2)
            return round_, round_, round_, ZERO, ZERO, ZERO
        case Box((a, b, c)):
            pairs = ((b, c), (a, c), (a, b))
            diagonal = [_times("1/12", body.mass, p**2 + q**2) for p, q in pairs]
            return diagonal[0], diagonal[1], diagonal[2], ZERO, ZERO, ZERO
        case Rod(length, axis):
            return _about(axis, ZERO, _times("1/12", body.mass, length**2))
        case Cylinder(r, h, axis):
            across = _times("1/4", body.mass, r**2) + _times("1/12", body.mass, h**2)
            return _about(axis, _times("1/2", body.mass, r**2), across)


def _about(axis: AxisName, along: Expr, across: Expr) -> tuple[Expr, Expr, Expr, Expr, Expr, Expr]:
    x, y, z = (along if name == axis else across for name in ("x", "y", "z"))
    return x, y, z, ZERO, ZERO, ZERO


def _times(fraction: str, *factors: Expr) -> Expr:
    return multiply(number(fraction), *factors)
