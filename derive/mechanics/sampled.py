"""Points at which every body of an arm is one that could exist, for what holds of real arms only."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from itertools import islice
from typing import Any

from derive.algebra.numbers.floats import number
from derive.expression import Expr, free_symbols
from derive.mechanics.bodies import Body, Moments
from derive.mechanics.moments import given_moments, moments
from derive.mechanics.oracle import Oracle

Range = tuple[float, float]
ANY: Range = (0.2, 0.9)
MOMENT: Range = (2.0, 3.0)  # well above m c^2, so that they are moments about any point
PRODUCT: Range = (-0.1, 0.1)
MOST_TRIES = 60
MANY_AXES = 2000


def physical_points(oracle: Oracle, names: frozenset[str], count: int) -> Iterator[dict[str, float]]:
    """At most `count` values of the names for which each body is possible; none where one never is."""
    bodies = _bodies(oracle)
    drawn = (
        point
        for point in islice(_drawn(bodies, names), MOST_TRIES)
        if all(_possible(body, oracle.at(point)) for body in bodies)
    )
    yield from islice(drawn, count)


def impossible(oracle: Oracle, names: frozenset[str], count: int) -> Iterator[bool]:
    """Whether, at so many values of the names, some body has a negative mass, or a negative moment about one
    of many axes through its com."""
    import numpy as np

    bodies = _bodies(oracle)
    for point in islice(_drawn(bodies, names), count):
        whole = oracle.at(point)
        inertias = [_inertia(body, whole) for body in bodies]
        axes = np.random.default_rng(len(bodies)).normal(size=(MANY_AXES, 3))
        moments_about = ((axes @ each * axes).sum(axis=1) for each in inertias if each is not None)
        masses = (number(body.mass, whole) for body in bodies)
        yield min(masses) < 0 or any(each.min() < 0 for each in moments_about)


def _bodies(oracle: Oracle) -> list[Body]:
    return [link.body for link in oracle.robot.links if link.body]


def _drawn(bodies: list[Body], names: frozenset[str]) -> Iterator[dict[str, float]]:
    ranges = _ranges(bodies)
    draw = random.Random(" ".join(sorted(names)))
    while True:
        yield {name: draw.uniform(*ranges.get(name, ANY)) for name in sorted(names)}


def _ranges(bodies: list[Body]) -> Mapping[str, Range]:
    """Products of inertia small, moments large."""
    found: dict[str, Range] = {}
    for body in bodies:
        if isinstance(body.inertia, Moments):
            six: tuple[Expr, ...] = given_moments(body)
            found |= {name: PRODUCT for part in six[3:] for name in free_symbols(part)}
            found |= {name: MOMENT for part in six[:3] for name in free_symbols(part)}
    return found


def _possible(body: Body, point: Mapping[str, float]) -> bool:
    """No negative mass, and an inertia about the com that is not negative in any direction."""
    import numpy as np

    if number(body.mass, point) < 0:
        return False
    inertia = _inertia(body, point)
    return inertia is None or bool(np.linalg.eigvalsh(inertia).min() >= -1e-12)


def _inertia(body: Body, point: Mapping[str, float]) -> Any:
    """That about the com; None where it is not told about the com."""
    import numpy as np

    if body.com == "center" and body.about == "origin":
        return None
    xx, yy, zz, xy, yz, xz = (number(part, point) for part in moments(body))
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
