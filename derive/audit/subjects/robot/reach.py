"""How far an arm reaches: the distance squared of its end from the first axis, or from the shoulder, has its
largest and its smallest value where its slopes vanish. Newton's method finds such places from many starts."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import mpmath
import numpy as np

from derive.audit.asked import Asked, Beyond, Holds, Test
from derive.audit.points import Irrational, Number, Point, floating, shown
from derive.audit.subjects.robot.arm import Arm, entries
from derive.audit.subjects.robot.dexterous import dexterous
from derive.audit.subjects.robot.limits import within
from derive.audit.subjects.robot.sections import in_section, on_two_axes, stays
from derive.audit.subjects.robot.series import Array, Series, values
from derive.audit.subjects.robot.task import Task

STARTS = 16
MOST_STRAIGHT, NEARBY = 4, mpmath.mpf("0.05")  # joints; rad
STEPS = 25
NEAR = mpmath.mpf(10) ** -12
DIGITS = 25


def workspace(asked: Asked, point: Point) -> Iterator[Test]:
    """r_min and r_max: attained, and passed nowhere."""
    if point.exact:
        raise Irrational
    said = str(asked.results["description"])
    if asked.options.kind == "dexterous":
        yield from dexterous(asked, Point(point.seed, False, point.angles, _positive(asked)))
        if "r_max" not in asked.results or "rings" in asked.results or "radius" in said:
            return
    if "one point" in said:
        yield from stays(asked, point)
        return
    if "rho2" in asked.results:
        yield from in_section(asked, point)
        return
    if "a sphere" in said:
        yield from on_two_axes(asked, Point(point.seed, False, point.angles, _positive(asked)))
        return
    if asked.subject.ranges or "r_min" not in asked.results or "r_max" not in asked.results:
        yield from within(asked, Point(point.seed, False, point.angles, _positive(asked)))
        return
    lengths = Point(point.seed, False, point.angles, _positive(asked))
    r_min, r_max = (abs(floating(asked.ours(name, lengths))) for name in ("r_min", "r_max"))
    about_a_point = "ball" in said or "shell" in said
    if asked.subject.coupled or "swung" in said or not (about_a_point or "axis" in said):
        yield Beyond("description", f"no search for {said}")
        return
    found: list[Number] = []
    with mpmath.workdps(DIGITS):
        for start in _starts(asked, lengths):
            found += _still(asked, start, about_a_point)
    sizes = [mpmath.sqrt(max(0, square)) for square in found]
    near = mpmath.sqrt(NEAR) * max(1, r_max)
    for name, told, extreme in (("r_max", r_max, max(sizes)), ("r_min", r_min, min(sizes))):
        yield Holds(name, abs(told - extreme) <= near, f"a search finds {shown(extreme)}")
    shape = "line" if r_max - r_min <= near else "solid" if r_min <= near else "hollow"
    yield Holds("description", _shape(said) == shape, f"r_min is {shown(r_min)}, r_max {shown(r_max)}")
    if "description" in asked.evaluated:
        yield Holds("evaluated description", asked.evaluated["description"] == said, said)


def _shape(said: str) -> str:
    """What is said of the region: a circle, or the side of a cylinder; with a hole or without."""
    if "circle" in said or "side" in said:
        return "line"
    return "hollow" if any(word in said for word in ("hollow", "annulus", "shell")) else "solid"


def _positive(asked: Asked) -> dict[str, str]:
    """Lengths are; a hole is as the formulas of the answer say only then."""
    names = {
        symbol.name
        for name in ("r_min", "r_max")
        if name in asked.results
        for symbol in asked.result(name).free_symbols
    }
    return {**dict.fromkeys(names, "positive"), **asked.assumptions}


def _starts(asked: Asked, lengths: Point) -> Iterator[Point]:
    """Configurations anywhere, and near those with joints at half turns, where links may be in line."""
    yield from (_moved(asked, lengths, k) for k in range(STARTS))
    names = asked.subject.variables
    for turns in product((0, 1), repeat=len(names) - 1) if 1 < len(names) <= MOST_STRAIGHT else ():
        angles = [mpmath.pi * turn + NEARBY for turn in turns]
        yield lengths.where(**dict(zip(names[1:], angles, strict=True)))


def _moved(asked: Asked, lengths: Point, k: int) -> Point:
    """The same arm in another configuration."""
    other = Point(900 + k, False, lengths.angles)
    return lengths.where(**{name: other[name] for name in asked.subject.variables})


def _still(asked: Asked, start: Point, ball: bool) -> Iterator[Number]:
    """The distance squared at the start, and where Newton's method from there ends."""
    center, axis = center_of(Task(Arm(asked, start, 1)), ball)
    q = mpmath.matrix([start[name] for name in asked.subject.variables])
    for _ in range(STEPS):
        there = start.where(**dict(zip(asked.subject.variables, q, strict=True)))
        square = _square(Task(Arm(asked, there, 2)), center, axis)
        yield square.value
        n = range(len(q))
        slope = mpmath.matrix([square.diff(i).value for i in n])
        if mpmath.norm(slope) < NEAR**2:
            return
        H = mpmath.matrix([[square.diff(i).diff(j).value for j in n] for i in n])
        step = _least(H, slope)
        q -= step / max(1, mpmath.norm(step))


def _least(H: mpmath.matrix, slope: mpmath.matrix) -> mpmath.matrix:
    """Newton's step, with none along what changes nothing, as a turn of the whole arm."""
    sizes, directions = mpmath.eigsy(H)
    most, step = max(map(abs, sizes)), 0 * slope
    for k, size in enumerate(sizes):
        if abs(size) > NEAR * most:
            direction = directions[:, k]
            step += direction * ((direction.T * slope)[0] / size)
    return step


def center_of(task: Task, ball: bool) -> tuple[Array, Array | None]:
    """The shoulder, the point of the first axis that is nearest to the second; or a point of the first axis,
    and its direction."""
    J_v, J_w = values(task.whole[:3]), values(task.whole[3:])
    p = np.array(entries(task.place), dtype=object)
    turning = [i for i in range(task.arm.n) if any(J_w[:, i])]
    lines = [(p + np.cross(J_w[:, i], J_v[:, i]), J_w[:, i]) for i in turning]
    if not ball:
        return lines[0]
    (o_1, w_1), (o_2, w_2) = lines[:2]
    across = w_2 - w_1 * (w_1 @ w_2)
    return o_1 + w_1 * (((o_2 - o_1) @ (w_1 - w_2 * (w_1 @ w_2))) / (across @ across)), None


def _square(task: Task, center: Array, axis: Array | None) -> Series:
    """The distance squared from the center, or from the axis."""
    r = task.place - center
    whole: Series = r @ r
    return whole if axis is None else whole - (r @ axis) * (r @ axis)
