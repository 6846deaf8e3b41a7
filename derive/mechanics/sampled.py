"""Points at which every body of an arm is one that could exist, for what holds of real arms only."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping

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


def physical_points(oracle: Oracle, names: frozenset[str], count: int) -> Iterator[dict[str, float]]:
    """At most `count` values of the names for which each body is possible; none where one never is."""
    bodies = [link.body for link in oracle.robot.links if link.body]
    ranges = _ranges(bodies)
    draw = random.Random(" ".join(sorted(names)))
    found = 0
    for _ in range(MOST_TRIES):
        point = {name: draw.uniform(*ranges.get(name, ANY)) for name in sorted(names)}
        whole = oracle.at(point)
        if all(_possible(body, whole) for body in bodies):
            yield point
            found += 1
            if found == count:
                return


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
    if body.com == "center" and body.about == "origin":
        return True
    xx, yy, zz, xy, yz, xz = (number(part, point) for part in moments(body))
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return bool(np.linalg.eigvalsh(inertia).min() >= -1e-12)
