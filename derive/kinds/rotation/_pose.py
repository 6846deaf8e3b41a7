"""The pose of a rotation that is given as such: about the origin."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.kinds.pose._given import Given, PoseOptions
from derive.kinds.problem import Problem
from derive.kinds.values_at import point_of
from derive.mechanics.oracle.poses import turn
from derive.mechanics.poses import homogeneous
from derive.mechanics.rotations import GivenRotation
from derive.names import free

if TYPE_CHECKING:
    from numpy.typing import NDArray

ROUNDED = 2e-3  # numbers of three digits


def given(options: PoseOptions, problem: Problem, rotation_only: bool) -> Given:
    """R, which rests on nothing. Raises NotDerivable where `evaluate` makes it no rotation."""
    subject: GivenRotation = problem.subject
    _require_rotation(subject, options, problem)

    def seen(at: Point) -> NDArray[Any]:
        import numpy as np

        T = np.eye(4)
        T[:3, :3] = arrays(subject.matrix, placed(subject, at))
        return T

    name = Symbol(free(problem.taken, "R", "R_0"))
    return Given(
        problem,
        name,
        name,
        homogeneous(normal_matrix(subject.matrix), (0, 0, 0)),
        (),
        seen,
        lambda at: placed(subject, at),
        every=True,
        named=bool(subject.names),
    )


def placed(given: GivenRotation, at: Point) -> Point:
    """The point, where the names of entries are moved to those of a rotation: the first three values say the
    vector about which it turns, by its length."""
    import numpy as np

    if not given.names:
        return at
    vector = np.array([at[name] for name in given.names[:3]])
    angle = float(np.linalg.norm(vector))
    R = turn(vector / angle, angle)
    return {**at, **dict(zip(given.names, map(float, R.ravel()), strict=True))}


def _require_rotation(given: GivenRotation, options: PoseOptions, problem: Problem) -> None:
    import numpy as np

    at = point_of(dict(options.evaluate or ()), problem.where)
    if given.names and options.evaluate:
        if missing := {*given.names} - at.keys():
            said = f"no value for {min(missing)}: the entries of a rotation depend on each other"
            raise NotDerivable(f"{said}, so give all nine", "evaluate")
        R = np.array([at[name] for name in given.names]).reshape(3, 3)
        if np.abs(R.T @ R - np.eye(3)).max() > ROUNDED or np.linalg.det(R) < 0:
            said = "these numbers are no rotation: R^T R is not the identity, or det R is not 1"
            raise NotDerivable(said, "evaluate")
