"""The joints over time held to the arm and the path in numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any

from derive.algebra.numbers.floats import Point
from derive.derivation import Table
from derive.expression import Approximate
from derive.kinds.checks import close
from derive.kinds.path._moving import Driven
from derive.kinds.robot._carried.coordinates import Coordinates
from derive.kinds.robot._carried.sampled import Sampled
from derive.mechanics.robot import Robot

STEP = 1e-3  # of the whole time
SURE, NEAR = 1e-7, 1e-4  # of places, and of rates by differences, relative
SHARES = (0.07, 0.43, 0.91)
Joints = Callable[[float], Sequence[Sequence[float]]]  # q, its rates and accelerations at a time


def carries(where: Coordinates, driven: Driven, joints: Joints, point: Point) -> Iterator[bool]:
    """Whether the arm is on the path at moments, and rates and accelerations are those of its variables."""
    import numpy as np

    begin, end = driven.ends or (0.1, 1.1)
    robot: Robot = where.problem.subject
    turning = np.array([link.joint == "revolute" for link in robot.links if link.variable])
    h = STEP * (end - begin)
    for t in _apart(driven, begin, end):
        found = [joints(t + k * h) for k in (-2, -1, 0, 1, 2)]
        now = np.array(found[2])
        yield on_path(where, driven, t, now[0], point)
        turns = np.array([each[0] for each in found])
        turns[:, turning] = np.unwrap(turns[:, turning], axis=0)
        a, b, c, d, e = turns
        rates, changes = (
            (a - 8 * b + 8 * d - e) / (12 * h),
            (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h),
        )
        yield close(now[1], rates, NEAR)
        yield close(now[2], changes, NEAR)


def on_path(where: Coordinates, driven: Driven, t: float, q: Any, point: Point) -> bool:
    """Whether the arm in numbers is where the path is."""
    gap = where.gap(driven, t, q, point)
    return close(gap, 0 * gap, SURE)


def rows_follow(where: Coordinates, driven: Driven, found: Sampled, point: Point) -> Iterator[bool]:
    """Whether what is listed and drawn is on the path, with rates that give its velocity."""
    import numpy as np

    begin, end = driven.ends or (0.0, 1.0)
    h = STEP * (end - begin)
    robot: Robot = where.problem.subject
    for t, q, rate in zip(found.times[1:-1:7], found.values[0][1:-1:7], found.values[1][1:-1:7], strict=True):
        yield on_path(where, driven, float(t), q, point)
        if not any(abs(t - joint) < 2 * h for joint in driven.joints) and begin + h < t < end - h:
            moved = [_seen(where, robot, q + k * h * rate, point) for k in (-1, 1)]
            went = [driven.place(float(t) + k * h) for k in (-1, 1)]
            ours, theirs = moved[1] - moved[0], went[1] - went[0]
            if where.rows[-1][0] == "w":
                ours[-1] = np.remainder(ours[-1] + np.pi, 2 * np.pi) - np.pi
            yield close(ours / (2 * h), theirs / (2 * h), 100 * NEAR)


def goes_through(table: Table, found: Sampled) -> bool:
    """Whether a table has one time after the other, from the first of the motion to the last."""
    times = [float(row[0].value) for row in table.rows if isinstance(row[0], Approximate)]
    ends = [times[0], times[-1]] == [found.times[0], found.times[-1]]
    return len(times) == len(table.rows) and ends and all(one < next_ for one, next_ in pairwise(times))


def _seen(where: Coordinates, robot: Robot, q: Any, point: Point) -> Any:
    return where.seen({**point, **dict(zip(robot.variables, map(float, q), strict=True))})


def _apart(driven: Driven, begin: float, end: float) -> Iterator[float]:
    """Moments within each piece of the law."""
    ends = [begin, *driven.joints, end]
    for low, high in pairwise(ends):
        for share in SHARES:
            t = low + share * (high - low)
            if min(t - low, high - t) > 3 * STEP * (end - begin):
                yield t
