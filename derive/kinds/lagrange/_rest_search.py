"""That no state of rest is missing: Newton's method from random starts, on the equations as written."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import pi
from typing import TYPE_CHECKING, Any

from derive.algebra.fold import fold
from derive.algebra.numbers.floats import Point, number
from derive.derivation import Branch, Claim, Step
from derive.expression import Expr, Matrix
from derive.kinds.checks import random_points, route
from derive.kinds.function._newton import Arrays
from derive.kinds.lagrange._held import UNREAL, Still
from derive.kinds.problem import Problem

if TYPE_CHECKING:
    from numpy.typing import NDArray

STARTS, STEPS, NEAR = 8, 40, 1e-5


def none_is_missing(
    still: Still,
    problem: Problem,
    steps: Sequence[Step],
    branches: Sequence[Branch],
    free: Sequence[tuple[str, ...]],
) -> Iterator[Claim]:
    """No state of rest that Newton's method finds is missing, for one choice of the parameters; the equations
    are those of the page."""
    at = still.at(next(random_points(problem.symbols | still.letters, 1)))
    found = _zeros(steps, at, still.system.coordinates)
    if not found and branches:
        return
    listed = []
    for branch, loose in zip(branches, free, strict=True):
        try:
            listed.append({q: number(tree, at) for q, tree in branch.values.items() if q not in loose})
        except UNREAL:
            continue
    known = (any(_same(zero, each) for each in listed) for zero in found)
    yield route("none-is-missing", [*known] if branches else [not found])


def _same(zero: Mapping[str, float], listed: Mapping[str, float]) -> bool:
    """Full turns apart."""
    gaps = (abs(zero[q] - value) for q, value in listed.items())
    return all(min(gap % (2 * pi), -gap % (2 * pi)) < 100 * NEAR for gap in gaps)


def _zeros(steps: Sequence[Step], at: Point, names: Sequence[str]) -> list[dict[str, float]]:
    """Places where what is left of the equations vanishes, from a few starts that walk at once."""
    import numpy as np

    draw = np.random.default_rng(len(names))
    q = draw.uniform(-3, 3, (STARTS, len(names)))
    left = {int(step.name[5:]) - 1: step.chain[0] for step in steps if step.name.startswith("rest_")}
    (K,) = (step.chain[-1] for step in steps if step.name == "K")
    rows = K.rows if isinstance(K, Matrix) else ((K,),)

    def value(tree: Expr) -> NDArray[Any]:
        point = Arrays({**at, **{name: q[:, k] for k, name in enumerate(names)}})
        return np.broadcast_to(np.asarray(fold(tree, point), dtype=float), (len(q),))

    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            F = np.array([value(left[k]) if k in left else np.zeros(len(q)) for k in range(len(names))]).T
            J = np.array([[value(entry) for entry in row] for row in rows]).transpose(2, 0, 1)
            usable = np.isfinite(F).all(axis=1) & np.isfinite(J).all(axis=(1, 2))
            q, F, J = q[usable], F[usable], J[usable]
            if not len(q):
                return []
            step = (np.linalg.pinv(J, rcond=1e-10) @ F[..., None])[..., 0]
            q = q - step * np.minimum(
                1.0, 1.0 / np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-12)
            )
        still = (np.linalg.norm(step, axis=1) < NEAR**2) & (np.linalg.norm(F, axis=1) < NEAR**2)
    return [dict(zip(names, map(float, place), strict=True)) for place in q[still]]
