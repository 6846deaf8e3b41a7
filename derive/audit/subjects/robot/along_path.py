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
from derive.audit.splines import solved
from derive.audit.subjects.path import parameter, place
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.rates import along, nearest
from derive.audit.subjects.robot.series import Array, values
from derive.audit.subjects.robot.task import Task
from derive.mechanics.paths import Via

SHARES = (mpmath.mpf(13) / 100, mpmath.mpf(45) / 100, mpmath.mpf(9) / 10)  # of the whole time
TRIES, TABLED = 40, 6
INTEGRATED = mpmath.mpf(10) ** -6
ORDERS = ("q", "qdot", "qddot")


def joint_motion(asked: Asked, point: Point) -> Iterator[Test]:
    """q, its rates and its accelerations as they are written, put back into the arm at moments, at a point
    where it reaches the path; of a table at some of its times. Raises ZeroDivisionError where no point that
    was tried is one."""
    if "t" in asked.results:
        yield from _listed_rows(asked)
        return
    given = asked.evaluate or {}
    fixed = {name: asked.formula(value) for name, value in given.items() if name != "t"}
    for k in range(TRIES):
        here = Point(1000 * k + point.seed, False, point.angles, point.assumptions, fixed)
        with suppress(ZeroDivisionError):
            yield from list(_at(asked, here))
            return
    raise ZeroDivisionError


def _at(asked: Asked, point: Point) -> Iterator[Test]:
    if asked.evaluated and "t" in (asked.evaluate or {}):
        yield from _in_numbers(asked)
    for now, *wanted in _moments(replace(asked, subject=asked.options.path), point):
        yield from _moves(_arm(asked, now), wanted, ROUNDED)


def _moves(arm: Arm, wanted: Sequence[Any], near: mpmath.mpf) -> Iterator[Test]:
    """Whether the arm is at the place that is wanted, with its velocity and acceleration."""
    task = Task(arm)
    linear = tuple(row for row in task.moving if row[0] == "v")
    rows = linear if len(linear) == len(wanted[0]) else (*linear, task.moving[-1])
    J = task.rows(rows)
    qdot, qddot = (_of(arm, end) for end in ("dot", "ddot"))
    moved = _seen(arm, rows), list(values(J) @ qdot), list(values(J) @ qddot + along(J, qdot) @ qdot)
    for name, ours, its in zip(ORDERS, moved, wanted, strict=True):
        yield Holds(name, _same(ours, its, near), f"the path has {shown(its)}")


def _moments(asked: Asked, point: Point, times: Sequence[Any] = ()) -> Iterator[tuple[Any, ...]]:
    """Points with a time, some of the whole where none are given, and how the path goes and turns then."""
    if isinstance(asked.subject.shape, Via):
        found = solved(asked, point)
        begin, whole = found.times[0], found.times[-1] - found.times[0]
        for time in times or [begin + whole * share for share in SHARES]:
            yield point.where(t=time), *(found.at(time, order) for order in range(3))
        return
    s = parameter(asked)
    p, between = place(asked, s, point)
    v = p.diff(s)
    low, high = (point.at(each) for each in between or (sympy.Integer(0), sympy.Integer(1)))
    moved = None
    if asked.subject.timing is not None:
        speed = sympy.sqrt(sum(each**2 for each in v))
        moved = law(asked, point, low, high, point.at(speed) if asked.subject.along else mpmath.mpf(1))
    begin, whole = (0, moved.whole) if moved else (low, high - low)
    for time in times or [begin + whole * share for share in SHARES]:
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


def _listed_rows(asked: Asked) -> Iterator[Test]:
    """Rows of the table: on the path, with the least rates that give its velocity."""
    times, *rows = (asked.result(name) for name in ("t", *ORDERS))
    some = range(0, len(times), max(1, len(times) // TABLED))
    there = replace(asked, subject=asked.options.path)
    found = _moments(there, asked.here, [mpmath.mpf(times[k]) for k in some])
    for k, (now, *wanted) in zip(some, found, strict=True):
        names = (f"{each}{end}" for end in ("", "_dot", "_ddot") for each in asked.subject.variables)
        listed = dict(zip(names, (value for row in rows for value in row[k]), strict=True))
        arm = Arm(asked, now.where(**listed))
        yield from _moves(arm, wanted, INTEGRATED)
        task = Task(arm)
        J = task.rows_in(tuple(row for row in task.moving if row[0] == "v")[: len(wanted[1])])
        if len(J) == len(wanted[1]):
            least = nearest(J, [[each] for each in wanted[1]])
            yield Holds("qdot", _same(list(_of(arm, "dot")), least, INTEGRATED), "others are less")
    yield Holds("t", list(times) == sorted(times), "the times do not rise")


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


def _same(ours: Sequence[Number], theirs: Sequence[Number], near: mpmath.mpf = ROUNDED) -> bool:
    return all(agree(a, b, 1, near) for a, b in zip(ours, theirs, strict=True))
