"""Joints on a path: at moments of the motion the arm is there, and moves as the path does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import mpmath
import sympy

from derive.audit.asked import EVALUATED, Asked, Holds, Test
from derive.audit.laws import law
from derive.audit.points import ROUNDED, Number, Point, Value, agree, shown
from derive.audit.subjects.path import parameter, place
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.rates import along
from derive.audit.subjects.robot.series import Array, values
from derive.audit.subjects.robot.task import Task

SHARES = (mpmath.mpf(13) / 100, mpmath.mpf(45) / 100, mpmath.mpf(9) / 10)  # of the whole time
TRIES = 40
ORDERS = ("q", "qdot", "qddot")


def joint_motion(asked: Asked, point: Point) -> Iterator[Test]:
    """q, its rates and its accelerations as they are written, put back into the arm at moments, at a point
    where it reaches the path. Raises ZeroDivisionError where none of those tried is one."""
    for k in range(TRIES):
        here = Point(1000 * k + point.seed, False, point.angles, point.assumptions)
        with suppress(ZeroDivisionError):
            yield from list(_at(asked, here))
            return
    raise ZeroDivisionError


def _at(asked: Asked, point: Point) -> Iterator[Test]:
    if asked.evaluated:
        yield from _in_numbers(asked)
    for now, *wanted in _moments(replace(asked, subject=asked.options.path), point):
        arm = _arm(asked, now)
        task = Task(arm)
        linear = tuple(row for row in task.moving if row[0] == "v")
        rows = linear if len(linear) == len(wanted[0]) else (*linear, task.moving[-1])
        J = task.rows(rows)
        qdot, qddot = (_of(arm, end) for end in ("dot", "ddot"))
        theirs = (values(J) @ qdot, values(J) @ qddot + along(J, qdot) @ qdot)
        yield Holds("q", _same(_seen(arm, rows), wanted[0]), f"the path is at {shown(wanted[0])}")
        for name, ours, its in zip(ORDERS[1:], theirs, wanted[1:], strict=True):
            yield Holds(name, _same(list(ours), its), f"the path has {shown(its)}")


def _moments(asked: Asked, point: Point) -> Iterator[tuple[Any, ...]]:
    """Points with a time, and place, velocity and acceleration of the path then."""
    s = parameter(asked)
    p, between = place(asked, s, point)
    v = p.diff(s)
    low, high = (point.at(each) for each in between or (sympy.Integer(0), sympy.Integer(1)))
    moved = None
    if asked.subject.timing is not None:
        speed = sympy.sqrt(sum(each**2 for each in v))
        moved = law(asked, point, low, high, point.at(speed) if asked.subject.along else mpmath.mpf(1))
    for share in SHARES:
        time = moved.whole * share if moved else low + (high - low) * share
        at, rate, change = moved.at(time) if moved else (time, mpmath.mpf(1), mpmath.mpf(0))
        there = point.where(**{s.name: at})
        first, second = there.vector(list(v)), there.vector(list(v.diff(s)))
        velocity = [each * rate for each in first]
        rises = [a * change + b * rate**2 for a, b in zip(first, second, strict=True)]
        yield point.where(t=time), there.vector(list(p)), velocity, rises


def _arm(asked: Asked, now: Point) -> Arm:
    """With the joints as the results say, rates after what they rest on. Raises ZeroDivisionError out of
    reach."""
    for name, end in zip(ORDERS, ("", "_dot", "_ddot"), strict=True):
        try:
            found = now.each(asked.result(name))
        except ValueError:
            raise ZeroDivisionError from None
        if not isinstance(found, Sequence) or any(not mpmath.isfinite(_real(each)) for each in found):
            raise ZeroDivisionError
        variables = (f"{each}{end}" for each in asked.subject.variables)
        now = now.where(**dict(zip(variables, found, strict=True)))
    return Arm(asked, now)


def _in_numbers(asked: Asked) -> Iterator[Test]:
    """The numbers where the author wants them are what the results come to there, one after the other."""
    arm = _arm(asked, asked.here)
    for name, end in zip(ORDERS, ("", "_dot", "_ddot"), strict=True):
        ours = arm.point.each(asked.result(EVALUATED + name))
        theirs = [arm.point[f"{each}{end}"] for each in arm.robot.variables]
        turns = [link.joint == "revolute" and not end for link in arm.robot.links if link.variable]
        gaps = [
            _turn(a - b) if turn else a - b for a, b, turn in zip(_listed(ours), theirs, turns, strict=True)
        ]
        yield Holds(EVALUATED + name, _same(gaps, [0 * gap for gap in gaps]), f"it is {shown(theirs)}")


def _turn(angle: Number) -> Number:
    """Whole turns apart."""
    return angle - 2 * mpmath.pi * mpmath.nint(angle / (2 * mpmath.pi))


def _listed(value: Value) -> Sequence[Any]:
    return value if isinstance(value, Sequence) else ()


def _real(value: Any) -> Any:
    if isinstance(value, mpmath.mpc):
        raise ZeroDivisionError
    return value


def _of(arm: Arm, end: str) -> Array:
    import numpy as np

    return np.array([arm.point[f"{name}_{end}"] for name in arm.robot.variables], dtype=object)


def _seen(arm: Arm, rows: Sequence[str]) -> list[Number]:
    """The coordinates of the end-effector; as an angle, that of its first axis in the plane."""
    T = values(arm.end)
    found = [T["xyz".index(row[1]), 3] for row in rows if row[0] == "v"]
    if rows[-1][0] == "w":
        turn = "xyz".index(rows[-1][1])
        first, second = (k for k in range(3) if k != turn)
        axis = next(j for j in range(3) if agree(T[turn, j], 0))
        found.append(mpmath.atan2(T[second, axis], T[first, axis]))
    return found


def _same(ours: Sequence[Number], theirs: Sequence[Number]) -> bool:
    return all(agree(a, b, 1, ROUNDED) for a, b in zip(ours, theirs, strict=True))
