"""Moments of inertia of bodies: those of the usual shapes, and about other points."""

from __future__ import annotations

from typing import TypeAlias

from derive.expression import ZERO, Expr, add, multiply, number
from derive.mechanics.bodies import AxisName, Body, Box, Cylinder, Moments, PointMass, Rod, Sphere

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
