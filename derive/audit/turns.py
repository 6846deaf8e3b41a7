"""One turn about an axis, put back: the rotation is made of its axis and angle, vector or quaternion."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias

import mpmath
import numpy as np
import sympy

from derive.audit.asked import Asked, Holds, Test
from derive.audit.points import NEAR, ROUNDED, Number, Point, floating
from derive.audit.putting_back import array, flat, put_back, rounded

Array: TypeAlias = np.ndarray[Any, Any]
Pose: TypeAlias = "sympy.Matrix | Array"  # T (4 by 4), of expressions or of numbers
ONE, ZERO = sympy.Integer(1), sympy.Integer(0)
IDENTITY = np.diag([ONE] * 3)
DIFFER = "its rotation is not the one of the sheet"


def inverse(asked: Asked, point: Point, T: Pose) -> Iterator[Test]:
    """T T^-1 = 1."""
    product_ = array(T, point) @ array(asked.result("T"), point)
    yield put_back("T", point, product_, sympy.eye(4), "T times it is not the identity")


def cross_matrix(v: Sequence[Number]) -> Array:
    """S(v) (3 by 3), with S(v) w = v x w."""
    x, y, z = v
    return np.array([[0 * x, -z, y], [z, 0 * y, -x], [-y, x, 0 * z]], dtype=object)


def rotation(axis: Sequence[Number], c: Number, s: Number) -> Array:
    """R (3 by 3) about a unit vector in numbers: 1 + s S + (1 - c) S^2."""
    S = cross_matrix(axis)
    R: Array = np.eye(3, dtype=int) + s * S + (1 - c) * (S @ S)
    return R


def axis_angle(asked: Asked, point: Point, T: Pose) -> Iterator[Test]:
    """The rotation by the angle, from 0 to pi, about the unit axis."""
    R, angle = array(T, point)[:3, :3], asked.result("angle")
    yield Holds("angle", _up_to_pi(angle, point), "an angle from 0 to pi")
    if asked.results["axis"] == "any":
        yield put_back("angle", point, [R, angle], [IDENTITY, ZERO], "the rotation of the sheet does turn")
        yield Holds("axis", True, "")
        return
    axis = flat(asked.result("axis"), point)
    near = ROUNDED if rounded(asked.result("axis")) else NEAR
    yield put_back("axis", point, sum(part**2 for part in axis), ONE, "a unit vector", near)
    yield put_back("angle", point, rotation(axis, *point.turn(angle)), R, DIFFER, near)


def rotation_vector(asked: Asked, point: Point, T: Pose) -> Iterator[Test]:
    """The rotation about it by its length, which is at most pi."""
    r, R = asked.result("r"), array(T, point)[:3, :3]
    near = ROUNDED if rounded(r) else NEAR
    size = mpmath.sqrt(sum(floating(part) ** 2 for part in flat(r, point)))
    yield Holds("r", bool(size <= mpmath.pi + ROUNDED), "no longer than pi")
    unit = [floating(part) / (size or 1) for part in flat(r, point)]
    yield put_back("r", point, rotation(unit, mpmath.cos(size), mpmath.sin(size)), R, DIFFER, near)


def quaternion(asked: Asked, point: Point, T: Pose) -> Iterator[Test]:
    """q v q* of the three axes: 1 + 2 w S + 2 S^2."""
    near = ROUNDED if rounded(asked.result("q")) else NEAR
    w, *v = flat(asked.result("q"), point)
    yield put_back("q", point, w**2 + sum(part**2 for part in v), ONE, "a unit quaternion", near)
    S = cross_matrix(v)
    again = np.eye(3, dtype=int) + 2 * w * S + 2 * (S @ S)
    yield put_back("q", point, again, array(T, point)[:3, :3], DIFFER, near)


def _up_to_pi(angle: sympy.Expr, point: Point) -> bool:
    """Whether it is an angle from 0 to pi: asked at 60 digits."""
    return bool(-ROUNDED <= floating(point.in_digits().at(angle)) <= mpmath.pi + ROUNDED)
