"""Workspaces within the ranges of joints: the arm on a grid of its joint variables, every row by itself; the
extremes of its distances, and how many cells of space it comes to."""

from __future__ import annotations

import math
from collections.abc import Iterator

import mpmath
import numpy as np
from numpy.typing import NDArray

from derive.audit.asked import Asked, Beyond, Holds, Test
from derive.audit.points import Number, Point, floating
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.series import Array, values
from derive.audit.subjects.robot.task import Task

Grid = NDArray[np.float64]
Ends = tuple[float, float]
SEEDS, APART = 200, 0.25
COUNT = {1: 401, 2: 101, 3: 29}  # values of a joint
CELLS = {"area": 24, "volume": 8}  # across the widest direction
NEAR = 0.02  # relative
HOLLOW, SOLID = ("annulus", "shell"), ("disc", "a ball")


def within(asked: Asked, lengths: Point) -> Iterator[Test]:
    """r_min, r_max, area and volume where every slide has an end."""
    said = str(asked.results["description"])
    here = _in_order(asked, lengths)
    links = asked.subject.links
    if asked.subject.coupled or here is None or any(x.joint == "prismatic" and not x.range for x in links):
        yield Beyond("description", "no search where a slide has no end")
        return
    limits = {
        link.variable: _limits(asked, here, link.variable, link.range) for link in links if link.variable
    }
    middle = {name: low + 0.55 * (high - low) for name, (low, high) in limits.items()}
    moving = [name for name in limits if _moves(asked, here, middle, name, limits[name])]
    turning = [link.variable for link in links if link.variable in moving and link.joint == "revolute"]
    carried = moving[moving.index(turning[0]) :] if turning else []
    if turning:
        r = _distances(asked, here, middle, carried, limits, "axes meet" in said)
        for name, extreme in (("r_max", r.max()), ("r_min", r.min())):
            told = _real(asked.ours(name, here))
            yield Holds(name, abs(told - extreme) <= NEAR * r.max(), f"a grid finds {extreme:.6g}")
        hollow = r.min() > NEAR * r.max()
        swept = "along the slide" in said  # by a disc or a circle
        wrong = not swept and any(word in said for word in (SOLID if hollow else HOLLOW))
        yield Holds("description", not wrong, f"the smallest distance is {r.min():.3g}")
    else:
        yield Holds("description", any(word in said for word in ("segment", "rectangle", "box")), said)
    for name in ("area", "volume"):
        if name in asked.results:
            told = _real(asked.ours(name, here))
            least, most = _size(_places(asked, here, middle, moving, limits), name)
            told_of = f"cells that hold a place come to between {least:.4g} and {most:.4g}"
            yield Holds(name, 0.95 * least <= told <= 1.05 * most, told_of)
    if "description" in asked.evaluated:
        yield Holds("evaluated description", asked.evaluated["description"] == said, said)


def _in_order(asked: Asked, lengths: Point) -> Point | None:
    """Lengths with which every range, where it is in letters, ends well after it begins."""
    ranges = [[asked.formula(end) for end in each] for each in asked.subject.ranges.values()]
    apart = [APART if any(end.free_symbols for end in each) else 0 for each in ranges]
    for k in range(SEEDS):
        here = Point(lengths.seed + k, False, lengths.angles, lengths.assumptions)
        wide = [_real(here.at(high)) - _real(here.at(low)) for low, high in ranges]
        if all(width > least for width, least in zip(wide, apart, strict=True)):
            return here
    return None


def _limits(asked: Asked, here: Point, name: str, ends: object) -> tuple[float, float]:
    if not ends:
        return -math.pi, math.pi
    low, high = (
        float(mpmath.re(floating(here.at(asked.formula(end))))) for end in asked.subject.ranges[name]
    )
    return low, high


def _poses(asked: Asked, here: Point, at: dict[str, float]) -> list[Grid]:
    """Base, rows and tool, each by itself (4 by 4)."""
    arm = _arm(asked, here, at)
    return [_floats(each) for each in (arm.base, *arm.local, arm.tool)]


def _arm(asked: Asked, here: Point, at: dict[str, float]) -> Arm:
    return Arm(asked, here.where(**{name: mpmath.mpf(value) for name, value in at.items()}), 0)


def _floats(T: Array) -> Grid:
    return np.array(values(T), dtype=float)


def _places(
    asked: Asked, here: Point, middle: dict[str, float], moving: list[str], limits: dict[str, Ends]
) -> Grid:  # fmt: skip
    """The end-effector (N by 3) with these joints on a grid of their ranges."""
    fixed = _poses(asked, here, middle)
    found = np.eye(4)[None]
    for i, T in enumerate(fixed):
        name = asked.subject.links[i - 1].variable if 0 < i < len(fixed) - 1 else None
        own = T[None]
        if name in moving:
            grid = np.linspace(*limits[name], COUNT[len(moving)])
            own = np.array([_floats(_arm(asked, here, {**middle, name: x}).row(i - 1)) for x in grid])
        found = (found[:, None] @ own[None]).reshape(-1, 4, 4)
    return np.array(found[:, :3, 3])


def _moves(asked: Asked, here: Point, middle: dict[str, float], name: str, ends: Ends) -> bool:
    ours, other = (
        np.linalg.multi_dot(_poses(asked, here, {**middle, name: at}))[:3, 3]
        for at in (middle[name], ends[0])
    )
    return bool(np.linalg.norm(ours - other) > 1e-9)


def _distances(
    asked: Asked, here: Point, middle: dict[str, float], carried: list[str],
    limits: dict[str, Ends], meeting: bool,
) -> Grid:  # fmt: skip
    """From the first axis that turns, or where it meets the second, the slides before it at rest."""
    from derive.audit.subjects.robot.reach import center_of

    at = here.where(**{name: mpmath.mpf(value) for name, value in middle.items()})
    center, axis = center_of(Task(Arm(asked, at, 1)), meeting)
    away = _places(asked, here, middle, carried, limits) - np.array([float(mpmath.re(x)) for x in center])
    if axis is not None:
        z = np.array([float(mpmath.re(x)) for x in axis])
        away = away - (away @ z)[:, None] * z
    return np.array(np.linalg.norm(away, axis=1))


def _size(places: Grid, name: str) -> tuple[float, float]:
    """Of the cells that hold a place, without those at the border and with them."""
    k = 2 if name == "area" else 3
    shifted = places - places.mean(axis=0)
    _, _, axes = np.linalg.svd(shifted[:: max(1, len(shifted) // 20_000)], full_matrices=False)
    seen = shifted @ axes[:k].T
    low, high = seen.min(axis=0), seen.max(axis=0)
    width = float((high - low).max()) / CELLS[name]
    index = np.floor((seen - low) / width).astype(int) + 1
    taken = np.zeros(index.max(axis=0) + 2, dtype=bool)
    taken[tuple(index.T)] = True
    inside = taken.copy()
    for axis in range(k):
        inside &= np.roll(taken, 1, axis) & np.roll(taken, -1, axis)
    return float(inside.sum()) * width**k, float(taken.sum()) * width**k


def _real(value: Number) -> float:
    return float(mpmath.re(floating(value)))
