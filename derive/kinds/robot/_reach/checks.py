"""A workspace checked by a search over the joints, with poses in NumPy."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from itertools import product
from typing import Any

from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim
from derive.expression import Expr
from derive.kinds.checks import SECOND_ROUTE, random_points
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.regions import Region
from derive.mechanics.chain import Chain
from derive.mechanics.reach import moving_joints

SMALL = 1e-6
NEAR = 1e-2  # a search creeps where links of 2, 2 and 4 are folded
SWEEPS = 40  # of a search joint by joint


def second_route(
    problem: Problem, found: Chain, point: Tracked, region: Region, bounds: Mapping[int, Expr]
) -> tuple[Claim, ...]:
    """The largest distance (1) and the smallest (-1) by a search over the joints, one after the other; of a
    torus the largest alone."""
    signs = (1,) if region.kind == "torus" else (1, -1)
    return tuple(_reached(problem, found, point, region, bounds[sign], sign) for sign in signs)


def _reached(problem: Problem, found: Chain, point: Tracked, region: Region, bound: Expr, sign: int) -> Claim:
    import numpy as np

    turning = [
        i for i in moving_joints(found, point.position, point.last) if found.joint(i).type == "revolute"
    ]
    names = [found.joint(i).variable for i in turning]
    holds = True
    for at in random_points(problem.symbols, 2):
        known = dict(oracle_of(problem).at(at))
        axis = np.array(numeric.matrix_numbers(found.axis(turning[0]), known)).ravel()

        def distance(here: dict[str, float], axis: Any = axis) -> float:
            return _distance(problem, point, region, here, axis)

        search = _scan if region.kind == "torus" else _search
        best = search(distance, known, names, sign)
        beyond = sign * (best - numeric.number(bound, known))  # the search comes near, and never further
        size = numeric.number(region.largest[-1], known)
        holds &= -NEAR * size < beyond < SMALL * size
    return Claim("largest-distance" if sign > 0 else "smallest-distance", SECOND_ROUTE, holds)


def _distance(problem: Problem, point: Tracked, region: Region, here: dict[str, float], axis: Any) -> float:
    """From the center; in the plane of a planar arm, from the first axis where that is what counts."""
    import numpy as np

    oracle = oracle_of(problem)
    T = oracle.tool(here) if point.frame > len(problem.subject.links) else oracle.poses(here)[point.frame]
    p = T[:3, :3] @ np.array([numeric.number(x, here) for x in point.offset]) + T[:3, 3]
    d = p - np.array(numeric.matrix_numbers(region.center, here)).ravel()
    if region.kind in ("planar", "torus"):
        d = d - axis * (axis @ d)
    return float(np.linalg.norm(d))


def _search(
    distance: Callable[[dict[str, float]], float], at: dict[str, float], names: list[str], sign: int
) -> float:
    """The square of the distance is a + b cos q + c sin q in each joint: its extreme in closed form."""
    here = dict(at)
    for _ in range(SWEEPS):
        before = dict(here)
        for name in names:
            zero, half, quarter = (distance({**here, name: q}) ** 2 for q in (0.0, math.pi, math.pi / 2))
            a, b = (zero + half) / 2, (zero - half) / 2
            c = quarter - a
            if math.hypot(b, c) > 1e-12:
                here[name] = math.atan2(sign * c, sign * b)
        if all(abs(here[name] - before[name]) < 1e-10 for name in names):
            break
    return distance(here)


def _scan(
    distance: Callable[[dict[str, float]], float], at: dict[str, float], names: list[str], sign: int
) -> float:
    """The extreme by ever finer steps around the best so far; the first joint swings everything about the
    axis and is left where it is."""
    here, step = dict(at), math.pi / 4
    while step > 1e-5:
        tried = product(range(-4, 5), repeat=len(names) - 1)
        places = [{**here, **_moved(here, names[1:], [k * step for k in ks])} for ks in tried]
        here = max(places, key=lambda each: sign * distance(each))
        step /= 3
    return distance(here)


def _moved(here: dict[str, float], names: list[str], by: list[float]) -> dict[str, float]:
    return {name: here[name] + step for name, step in zip(names, by, strict=True)}
