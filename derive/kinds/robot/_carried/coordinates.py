"""Which coordinates of the end-effector a path gives, by their names and the rows of the Jacobian."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.kinds.path._moving import Driven
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._velocity.task import task_of
from derive.mechanics.inverse.goal import reference_column
from derive.mechanics.paths import Carried, Curve
from derive.mechanics.poses import rotation_part
from derive.mechanics.task import ROWS, moving_rows
from derive.names import free

if TYPE_CHECKING:
    from numpy.typing import NDArray

WANTED = {"vx": "ax", "vy": "ay", "vz": "az", "wx": "alphax", "wy": "alphay", "wz": "alphaz"}


@dataclass(frozen=True, slots=True)
class Coordinates:
    """The `names` of the coordinates, each with the row of the Jacobian that is its rate."""

    problem: Problem  # of the arm
    rows: tuple[str, ...]
    names: tuple[str, ...]
    column: int = 0  # of the axis whose angle in the plane is the last coordinate

    @property
    def velocities(self) -> tuple[Symbol, ...]:
        return tuple(map(Symbol, self.rows))

    @property
    def accelerations(self) -> tuple[Symbol, ...]:
        return tuple(Symbol(WANTED[row]) for row in self.rows)

    def seen(self, at: dict[str, float]) -> NDArray[Any]:
        """Those of the arm in numbers."""
        import numpy as np

        T = oracle_of(self.problem).tool(at)
        return np.array([self._one(T, row) for row in self.rows])

    def gap(self, driven: Driven, t: float, q: Any, point: Point) -> NDArray[Any]:
        """How far the arm is from the path, an angle without whole turns."""
        import numpy as np

        variables = self.problem.subject.variables
        there = {**point, **dict(zip(variables, map(float, q), strict=True))}
        found: NDArray[Any] = self.seen(there) - driven.place(t)
        if self.rows[-1][0] == "w":
            found[-1] = np.remainder(found[-1] + np.pi, 2 * np.pi) - np.pi
        return found

    def _one(self, T: NDArray[Any], row: str) -> float:
        axis = ROWS.index(row)
        if axis < 3:
            return float(T[axis, 3])
        first, second = (k for k in range(3) if k != axis - 3)
        return atan2(T[second, self.column], T[first, self.column])


def coordinates_of(problem: Problem, carried: Problem) -> Coordinates:
    """Of an arm that moves in a plane two, and the angle there as a third; else three. Raises NotDerivable
    where the path has more, or fewer, than the arm moves."""
    way: Carried = carried.subject
    whole = task_of(problem, ROWS)
    linear, angular = moving_rows(whole.J)
    size, rows = way.path.size, linear
    if isinstance(way.shape, Curve) and size == len(linear) + 1 == 3 and len(angular) == 1:
        rows = (*linear, *angular)
    if len(rows) != size:
        raise NotDerivable(
            f"the path has {size} coordinates, but those of the end-effector that change are {len(linear)}",
            "path",
        )
    if size > len(problem.subject.variables):
        raise NotDerivable(
            f"{len(problem.subject.variables)} joints cannot follow {size} coordinates", "path"
        )
    taken = {*carried.taken, *problem.taken, "t"}
    names = []
    for row in rows:
        letter = row[1] if row[0] == "v" else "phi"
        names.append(free(taken, letter, f"{letter}_e"))
        taken.add(names[-1])
    R = rotation_part(chain_of(problem).T_tool)
    column = reference_column(R, ROWS.index(rows[-1]) - 3) if rows[-1][0] == "w" else 0
    return Coordinates(problem, rows, tuple(names), column)
