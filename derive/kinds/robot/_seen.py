"""Joint axes as they are seen: by what stays in its place while a joint of the oracle moves."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import number_rows
from derive.derivation import Claim, Phrase, Said
from derive.errors import NotReal
from derive.expression import Matrix, free_symbols
from derive.kinds.checks import random_points, route
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.mechanics.chain import Chain
from derive.mechanics.oracle.sweep import cross

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

MOVE = 0.5  # of a joint
STILL, TRIES = 1e-9, 20  # below that nothing moves; points that are tried


def motion(problem: Problem, found: Chain, i: int, here: Mapping[str, float]) -> Array:
    """The displacement (4 by 4, in the base) of what joint i carries against what carries it."""
    import numpy as np

    name = found.joint(i).variable
    oracle = oracle_of(problem)
    (base, before), (carried, after) = (
        oracle.poses(oracle.at(at))[i - 1 : i + 1] for at in (here, {**here, name: here[name] + MOVE})
    )
    D: Array = base @ np.linalg.inv(carried) @ after @ np.linalg.inv(before)
    return D


def axis_seen(problem: Problem, found: Chain, i: int, here: Mapping[str, float]) -> tuple[Array, Array]:
    """The direction of a joint that turns and a point on its axis (3 each)."""
    import numpy as np

    D = motion(problem, found, i, here)
    S = D[:3, :3] - D[:3, :3].T
    w = np.array([S[2, 1], S[0, 2], S[1, 0]])
    return w / np.linalg.norm(w), meeting([D])


def meeting(motions: Sequence[Array]) -> Array:
    """The point (3) that all these displacements leave where it is."""
    import numpy as np

    rows = np.vstack([D[:3, :3] - np.eye(3) for D in motions])
    return np.array(np.linalg.lstsq(rows, np.concatenate([-D[:3, 3] for D in motions]), rcond=None)[0])


def apart(z: Array, d: Array) -> float:
    """How far d points away from a direction."""
    return math.hypot(*cross(z, d))


def sorts(problem: Problem, J: Matrix, joints: Sequence[int], said: Sequence[Phrase | None]) -> Claim:
    """That each joint is of the sort it is said to be, and of one, by its column of a Jacobian (6 by n): one
    that turns has an angular velocity w, one that slides none, and a pitch is w v/w w, v being that of any
    point."""
    told = {key: listed for each in said if each for key, listed in each.about.items()}
    turning, sliding, helical = (_numbers(told.get(key, ())) for key in ("turning", "sliding", "helical"))
    symbols, oracle = problem.symbols | free_symbols(J), oracle_of(problem)
    for point in random_points(symbols - problem.where.keys(), TRIES):
        with suppress(NotReal):
            columns = dict(zip(joints, zip(*number_rows(J, oracle.at(point)), strict=True), strict=True))
            return route("joint-sorts", _sorts(columns, turning, sliding, helical))
    raise NotReal("no values of the symbols were found for which this is real, so nothing was verified")


def _numbers(said: Said) -> tuple[int, ...]:
    return tuple(each for each in said if isinstance(each, int)) if isinstance(said, tuple) else ()


def _sorts(
    columns: Mapping[int, Sequence[float]],
    turning: Sequence[int],
    sliding: Sequence[int],
    helical: Sequence[int],
) -> Iterator[bool]:
    import numpy as np

    yield {*turning, *sliding} <= columns.keys() and {*turning}.isdisjoint(sliding)
    for i in (*turning, *sliding):
        v, w = np.array(columns[i][:3]), np.array(columns[i][3:])
        yield bool(np.linalg.norm(w) > STILL) == (i in turning)
        yield bool(abs(w @ v) > STILL) == (i in helical)
