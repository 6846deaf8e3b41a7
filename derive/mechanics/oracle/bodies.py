"""Bodies in numbers: where the com is, and moments of inertia by quadrature over the solid.

A solid of even density is taken apart into points: Gauss' rule along its sides, its axis and its radius,
where a ring or a shell has a share of the mass in proportion to its size, and points spread evenly around a
circle. Three points of Gauss are exact up to the fifth power, and no more than the fourth is needed.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import product
from math import cos, pi, sin, sqrt
from typing import Any, TypeAlias

from derive.algebra.numbers.floats import number
from derive.mechanics.bodies import AxisName, Body, Box, Cylinder, Moments, PointMass, Rod, Sphere
from derive.mechanics.oracle.poses import crossing
from derive.mechanics.oracle.values import Array, Value

GAUSS = tuple(
    ((1 + sign * sqrt(3 / 5)) / 2, weight) for sign, weight in ((-1, 5 / 18), (0, 4 / 9), (1, 5 / 18))
)
AROUND = tuple((2 * pi * k / 8, 1 / 8) for k in range(8))
Grain: TypeAlias = tuple[float, float, float, float]  # a share of the mass, and where it is


def com_of(body: Body, before: Array, T: Array, point: Any, value: Value = number) -> Array:
    """The com (3, base frame) of the link at T, the one before it at `before`."""
    import numpy as np

    if body.com == "center":
        return np.array((before[:3, 3] + T[:3, 3]) / 2)
    return np.array(T[:3, :3] @ np.array([value(x, point) for x in body.com]) + T[:3, 3])


def inertia_of(body: Body, point: Any, value: Value = number) -> Array:
    """I about the com in the link's own axes (3 by 3). What is given about the origin is m S(c)^T S(c) more,
    the inertia of the whole mass at the com."""
    import numpy as np

    match body.inertia:
        case Moments(six):
            xx, yy, zz, xy, yz, xz = (value(x, point) for x in six)
            I = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        case PointMass():
            I = np.zeros((3, 3))
        case solid:
            I = value(body.mass, point) * _unit_mass(solid, point, value)
    if body.about == "com" or body.com == "center":
        return I
    S = crossing(np.array([value(x, point) for x in body.com]))
    return np.array(I - value(body.mass, point) * S.T @ S)


def _unit_mass(solid: Box | Rod | Cylinder | Sphere, point: Any, value: Value) -> Array:
    """The inertia (3 by 3) of a solid of mass 1 about its middle: the integral of r^2 1 - r r^T."""
    import numpy as np

    match solid:
        case Box(sides):
            shape, sizes = "box", [value(side, point) for side in sides]
        case Rod(length, axis):
            shape, sizes = "rod", _along(axis, value(length, point), 0)
        case Cylinder(radius, length, axis):
            shape, sizes = f"cylinder {axis}", _along(axis, value(length, point), value(radius, point))
        case Sphere(radius):
            shape, sizes = "sphere", [value(radius, point)] * 3
    scale = np.array(sizes)
    spread = _spread(shape) * np.outer(scale, scale)
    return np.array(np.trace(spread) * np.eye(3) - spread)


def _along(axis: AxisName, length: Any, across: Any) -> list[Any]:
    return [length if name == axis else across for name in "xyz"]


@cache
def _spread(shape: str) -> Array:
    """The integral of r r^T (3 by 3) over a solid of mass 1 whose sides, length and radius are 1."""
    import numpy as np

    grains = np.array([*_grains(shape)])
    places = grains[:, 1:]
    return np.array(places.T @ (grains[:, :1] * places))


def _grains(shape: str) -> Iterator[Grain]:
    """The solid in points."""
    match shape.split():
        case ["box" | "rod"]:
            for (x, p), (y, q), (z, r) in product(GAUSS, repeat=3):
                yield p * q * r, x - 1 / 2, y - 1 / 2, z - 1 / 2
        case ["cylinder", axis]:  # a ring at s has the share 2 s ds
            turned = "xyz".index(axis) - 2  # from an axis along z
            for (s, p), (u, q), (h, r) in product(GAUSS, AROUND, GAUSS):
                place = (s * cos(u), s * sin(u), h - 1 / 2)
                x, y, z = (place[(k - turned) % 3] for k in range(3))
                yield 2 * s * p * q * r, x, y, z
        case ["sphere"]:  # a shell at s has the share 3 s^2 ds, evenly in height
            for (s, p), (u, q), (h, r) in product(GAUSS, AROUND, GAUSS):
                z = s * (2 * h - 1)
                across = sqrt(s * s - z * z)
                yield 3 * s * s * p * q * r, across * cos(u), across * sin(u), z
