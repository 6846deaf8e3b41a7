"""Torques by the motion of each body, from base to tip, in the base frame (Newton and Euler)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from derive.algebra.numbers.floats import Point
from derive.mechanics.oracle.displacements import Placed
from derive.mechanics.oracle.values import Array
from derive.mechanics.robot import Link

NEAR = 0.25  # how far a joint is moved to see what its axis is


@dataclass(frozen=True, slots=True)
class Axis:
    """Of a joint, in the frame before it: a direction (3), as long as the joint moves for a unit of its
    variable, and a point (3)."""

    direction: Array
    point: Array


def axis_of(local: Callable[[float], Array], turns: bool) -> Axis:
    """Told from what the joint does: `local` is T (4 by 4) of its row that much further. The points that stay
    where they are, or go along it only, make up the axis."""
    import numpy as np

    ahead, behind = local(NEAR), local(-NEAR)
    R = ahead[:3, :3] @ behind[:3, :3].T
    p = ahead[:3, 3] - R @ behind[:3, 3]
    if not turns:
        return Axis(p / (2 * NEAR), np.zeros(3))
    twice_sin = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    size = float(np.linalg.norm(twice_sin))
    angle, k = np.arctan2(size, np.trace(R) - 1), twice_sin / size
    return Axis(k * angle / (2 * NEAR), (p - k * (k @ p) + cross(k, p) / np.tan(angle / 2)) / 2)


@dataclass(frozen=True, slots=True)
class Still:
    """Where an arm is: poses[i] (4 by 4) of frame i, from 0; axes and bodies of the links; and the
    acceleration of what falls (3)."""

    poses: Sequence[Array]
    axes: Sequence[Axis | None]
    bodies: Sequence[Placed | None]
    gravity: Array


def torques_of_bodies(links: Sequence[Link], arm: Still, at: Point) -> Array:
    """tau (n) of an arm each of whose variables moves its own row alone."""
    import numpy as np

    w = alpha = acc = np.zeros(3)
    reference = arm.poses[0][:3, 3]
    joints: list[tuple[int, Array, Array, bool]] = []
    loads: list[tuple[int, Array, Array, Array]] = []
    for i, (link, axis, body) in enumerate(zip(links, arm.axes, arm.bodies, strict=True)):
        if axis is not None:
            R, o = arm.poses[i][:3, :3], arm.poses[i][:3, 3]
            z, point = R @ axis.direction, R @ axis.point + o
            rate, rise = at[f"{link.variable}_dot"], at[f"{link.variable}_ddot"]
            revolute = link.joint == "revolute"
            joints.append((i, z, point, revolute))
            if revolute:
                acc, reference = carried(acc, w, alpha, point - reference), point
                alpha = alpha + z * rise + cross(w, z * rate)
                w = w + z * rate
            else:
                there = arm.poses[i + 1][:3, 3]
                acc = carried(acc, w, alpha, there - reference) + 2 * cross(w, z * rate) + z * rise
                reference = there
        if body is not None:
            I, a = body.turned, carried(acc, w, alpha, body.com - reference)
            loads.append((i, body.com, body.mass * (a - arm.gravity), I @ alpha + cross(w, I @ w)))
    return np.array(
        [
            sum(z @ (N + cross(c - o, F) if turns else F) for i, c, F, N in loads if i >= first)
            for first, z, o, turns in joints
        ],
        dtype=float,
    )


def carried(acc: Array, w: Array, alpha: Array, r: Array) -> Array:
    """The acceleration of a point of a body, r away from one that has the acceleration `acc`."""
    found: Array = acc + cross(alpha, r) + cross(w, cross(w, r))
    return found


def cross(u: Array, v: Array) -> Array:
    """u x v (3); NumPy's own takes many times as long."""
    import numpy as np

    a, b, c = u
    d, e, f = v
    return np.array((b * f - c * e, c * d - a * f, a * e - b * d))
