"""The inertia of a body about its center of mass: as given, or by integration over the solid."""

from __future__ import annotations

from functools import cache

import numpy as np
import sympy

from derive.audit.subjects.robot.displacements import Reader
from derive.audit.subjects.robot.series import Array
from derive.mechanics.bodies import Body, Box, Cylinder, Moments, PointMass, Rod, Sphere

x, y, z = sympy.symbols("x y z", real=True)
a, b, c, r, h = sympy.symbols("a b c r h", positive=True)
rho, phi, theta = sympy.symbols("rho phi theta", nonnegative=True)
ORDER = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))


def inertia(body: Body, read: Reader) -> Array:
    """I (3 by 3) about the com along the axes of the link's frame, as series."""
    m = read.formula(body.mass)
    I = sympy.zeros(3)
    match body.inertia:
        case Moments(values):
            for (i, j), value in zip(ORDER, values, strict=True):
                I[i, j] = I[j, i] = read.formula(value)
        case PointMass():
            pass
        case Box(sides):
            I = box().subs(dict(zip((a, b, c), map(read.formula, sides), strict=True)), simultaneous=True) * m
        case Sphere(radius):
            I = sphere().subs(r, read.formula(radius)) * m
        case Rod(length, axis):
            I = turned(rod().subs(h, read.formula(length)) * m, axis)
        case Cylinder(radius, length, axis):
            sizes = {r: read.formula(radius), h: read.formula(length)}
            I = turned(cylinder().subs(sizes, simultaneous=True) * m, axis)
    if body.about == "origin" and body.com != "center":
        at = sympy.Matrix([read.formula(part) for part in body.com])
        I = I - m * (at.dot(at) * sympy.eye(3) - at * at.T)
    return np.array([[read.exact(I[i, j]) for j in range(3)] for i in range(3)], dtype=object)


def turned(about_z: sympy.Matrix, axis: str) -> sympy.Matrix:
    """The inertia of a body whose own z axis lies along another one."""
    k = "xyz".index(axis)
    order = [(k + 1) % 3, (k + 2) % 3, k]
    P = sympy.zeros(3)
    for own, there in enumerate(order):
        P[there, own] = 1
    return P * about_z * P.T


@cache
def box() -> sympy.Matrix:
    """Of mass 1, with sides a, b, c."""
    return _integrated({}, ((x, -a / 2, a / 2), (y, -b / 2, b / 2), (z, -c / 2, c / 2)), 1)


@cache
def rod() -> sympy.Matrix:
    """Of mass 1 and length h along z."""
    return _integrated({x: 0, y: 0}, ((z, -h / 2, h / 2),), 1)


@cache
def cylinder() -> sympy.Matrix:
    """Of mass 1, radius r and height h along z, in cylindrical coordinates."""
    polar = {x: rho * sympy.cos(phi), y: rho * sympy.sin(phi)}
    return _integrated(polar, ((rho, 0, r), (phi, 0, 2 * sympy.pi), (z, -h / 2, h / 2)), rho)


@cache
def sphere() -> sympy.Matrix:
    """Of mass 1 and radius r, in spherical coordinates."""
    out = rho * sympy.sin(theta)
    ball = {x: out * sympy.cos(phi), y: out * sympy.sin(phi), z: rho * sympy.cos(theta)}
    limits = ((rho, 0, r), (theta, 0, sympy.pi), (phi, 0, 2 * sympy.pi))
    return _integrated(ball, limits, rho**2 * sympy.sin(theta))


def _integrated(
    place: dict[sympy.Symbol, sympy.Expr], limits: tuple[tuple[sympy.Expr, ...], ...], element: sympy.Expr
) -> sympy.Matrix:
    """The mean of |p|^2 1 - p p^T over a solid, p in its coordinates, `element` that of its volume."""
    p = sympy.Matrix([x, y, z]).subs(place)
    moments = (p.dot(p) * sympy.eye(3) - p * p.T) * element
    volume = sympy.integrate(element, *limits)
    return moments.applyfunc(lambda entry: sympy.integrate(entry, *limits) / volume)
