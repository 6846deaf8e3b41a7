"""The arm angle of seven joints, by the velocities of the end-effector: how far the axis of the fourth joint
is turned, about the line between the points where the first two and the last two axes meet, from where it is
at right angles to z of the base."""

from __future__ import annotations

from typing import Any, TypeAlias

import mpmath

from derive.audit.subjects.robot.arm import Arm, entries, numbers

JOINTS, ELBOW = 7, 3
Vector: TypeAlias = Any  # of mpmath, 3 by 1


def arm_angle(arm: Arm) -> mpmath.mpf:
    """In radians, at the configuration of the arm."""
    p = mpmath.matrix(entries(arm.end[:3, 3]))
    spins = mpmath.matrix(numbers(arm.angular(arm.end[:3, :3])))
    slides = mpmath.matrix(numbers(arm.linear(arm.end[:3, 3])))
    axes = [(spins[:, k], p + cross(spins[:, k], slides[:, k])) for k in range(JOINTS)]
    line = meeting(*axes[-2:]) - meeting(*axes[:2])
    line /= mpmath.norm(line)
    level = cross(mpmath.matrix([0, 0, 1]), line)
    level /= mpmath.norm(level)
    axis = axes[ELBOW][0]
    return mpmath.atan2(inner(cross(level, axis), line), inner(level, axis))


def meeting(one: tuple[Vector, Vector], other: tuple[Vector, Vector]) -> Vector:
    """The point (3 by 1) that two axes have in common, each by its direction and a point."""
    (k, a), (m, b) = one, other
    normal = cross(k, m)
    return a + k * (inner(cross(b - a, m), normal) / inner(normal, normal))


def cross(a: Vector, b: Vector) -> Vector:
    return mpmath.matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def inner(a: Vector, b: Vector) -> mpmath.mpf:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
