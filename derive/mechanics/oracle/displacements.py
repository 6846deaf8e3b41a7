"""Velocities and joint forces from nothing but where things are: differences in numbers of many digits.

The configuration is moved a little along every joint variable and a little along the motion; what frames and
centres of mass do meanwhile gives velocities and accelerations, and d'Alembert's principle the joint forces
(Goldstein, Poole and Safko, section 1.4). Nothing is known of joints, axes or rows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TypeAlias

from flint import arb, ctx

from derive.mechanics.oracle.values import Array

BITS = 240
STEP = 2.0**-80  # of differences; their error is about 1e-24

Configuration: TypeAlias = Mapping[str, arb]


@dataclass(frozen=True, slots=True)
class Placed:
    """A body in one configuration: mass, com (3, base frame), rotation R, and inertia about the com in the
    body's own axes (3 by 3 each)."""

    mass: Any
    com: Array
    R: Array
    inertia: Array

    @property
    def turned(self) -> Array:
        """The inertia (3 by 3) in the axes of the base."""
        return self.R @ self.inertia @ self.R.T


Place: TypeAlias = Callable[[Configuration], Sequence[Placed]]


@contextmanager
def many_digits(at: Mapping[str, float]) -> Iterator[Configuration]:
    """The point in numbers of as many digits as differences need."""
    with ctx.workprec(BITS):
        yield {name: arb(value) for name, value in at.items()}


@dataclass(frozen=True, slots=True)
class Course:
    """Of a frame along a motion, in the base (3 each): velocity and acceleration of its origin, angular
    velocity and acceleration."""

    v: Array
    a: Array
    omega: Array
    alpha: Array


def along(at: Configuration, names: Sequence[str]) -> tuple[Configuration, ...]:
    """A step before, now, and a step after on the way that the rates and accelerations of the point begin."""
    return tuple(
        {**at, **{q: at[q] + h * at[f"{q}_dot"] + h * h / 2 * at[f"{q}_ddot"] for q in names}}
        for h in (-STEP, 0, STEP)
    )


def course(behind: Array, now: Array, ahead: Array) -> Course:
    """Of a frame whose poses (4 by 4) are these."""
    rate, rise = _slope(ahead, behind), _bend(ahead, now, behind)
    R = now[:3, :3]
    moved = rate[:3, 3], rise[:3, 3], _vee(rate[:3, :3] @ R.T), _vee(rise[:3, :3] @ R.T)
    return Course(*(part.astype(float) for part in moved))


def joint_forces(place: Place, at: Configuration, names: Sequence[str], gravity: Array) -> Array:
    """tau (n): sum of m (a - g) . dc/dq_k + d(I omega)/dt . w_k - omega . dI/dq_k omega / 2 over the bodies,
    the last dI/dq_k in the body's own axes.

    `place` puts the bodies where the joint variables `names` say; their rates and accelerations stand in
    the point too.
    """
    import numpy as np

    rate, rise = (np.array([at[f"{name}_{dots}"] for name in names]) for dots in ("dot", "ddot"))
    moved = [{name: 1} for name in names] + [dict(zip(names, rate, strict=True))]
    shots = [place(_ahead(at, each, sign)) for each in moved for sign in (1, -1)]
    tau = np.zeros(len(names))
    for now, *pairs in zip(place(at), *shots, strict=True):
        *each, along = zip(pairs[::2], pairs[1::2], strict=True)
        shifts = np.array([_slope(a.com, b.com) for a, b in each])
        turns = np.array([_slope(a.R, b.R) for a, b in each])
        swells = np.array([_slope(a.turned, b.turned) for a, b in each])
        own = np.array([_slope(a.inertia, b.inertia) for a, b in each])
        spins = np.array([_vee(turn @ now.R.T) for turn in turns])
        omega, inertia = rate @ spins, now.turned
        acceleration = rise @ shifts + _bend(along[0].com, now.com, along[1].com)
        turning = np.tensordot(rise, turns, 1) + _bend(along[0].R, now.R, along[1].R)
        moment = inertia @ _vee(turning @ now.R.T) + np.tensordot(rate, swells, 1) @ omega
        inside = now.R.T @ omega
        forces = now.mass * shifts @ (acceleration - gravity) + spins @ moment - own @ inside @ inside / 2
        tau += forces.astype(float)
    return tau


def _ahead(at: Configuration, along: Mapping[str, Any], sign: int = 1) -> Configuration:
    """A step further (or back) in a direction."""
    return {**at, **{name: at[name] + sign * STEP * part for name, part in along.items()}}


def _slope(ahead: Array, behind: Array) -> Array:
    found: Array = (ahead - behind) / (2 * STEP)
    return found


def _bend(ahead: Array, now: Array, behind: Array) -> Array:
    found: Array = (ahead - 2 * now + behind) / STEP**2
    return found


def _vee(S: Array) -> Array:
    """The vector of the skew part of a matrix."""
    import numpy as np

    return np.array([S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]]) / 2
