"""The matrix that a question is about: rows of the Jacobian of an arm, the derivatives of a task, or a matrix
given as such; at the configuration that is asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal_matrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, completed
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, free_symbols
from derive.kinds.fields import Evaluation, OptionsModel, Place, Quantity
from derive.kinds.problem import Problem
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._velocity.functions import FunctionTask, task_for
from derive.kinds.robot._velocity.task import RowName, Task
from derive.mechanics.matrices import GivenMatrix
from derive.mechanics.robot import Robot
from derive.names import named


class MapOptions(OptionsModel):
    """Which map of the rates is looked at; `evaluate` gives the configuration."""

    rows: tuple[RowName, ...] = ()
    """The velocities of an arm that are wanted."""
    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""
    task: tuple[Quantity, ...] = ()
    """Functions of the joint variables, in place of rows."""
    evaluate: Evaluation = None


@dataclass(frozen=True)
class LinearMap:
    """J (m by n) with its name; the variables its columns belong to, the velocities of its rows, what it
    rests on; and `numbers`, the same by a route that knows nothing of it."""

    problem: Problem
    name: Symbol
    J: ScalarMatrix
    variables: tuple[str, ...]
    velocities: tuple[Symbol, ...]
    sort: str  # "rows", "task", "matrix"
    place: Place
    numbers: Callable[[Point], Any]
    base: tuple[Derivation, ...] = ()
    functions: tuple[Expr, ...] = ()  # of a task

    @property
    def rates(self) -> tuple[Symbol, ...]:
        return tuple(Symbol(f"{name}_dot") for name in self.variables)

    @property
    def symbols(self) -> frozenset[str]:
        """Every name that is left in J at the configuration."""
        given = {name for name, _ in self.place}
        names = self.problem.symbols | {n for _, value in self.place for n in free_symbols(value)}
        return names - given - set(self.problem.where)

    @property
    def values(self) -> Names:
        """What names stand for there."""
        return _values(self.place, self.problem)

    def at(self, point: Point) -> Point:
        """A point with the values of the configuration and of `where`."""
        return completed(point, {**self.problem.where, **dict(self.place)})


def linear_map(subject: Robot | GivenMatrix, options: MapOptions, problem: Problem) -> LinearMap:
    """The matrix of a question. Raises NotDerivable: rows of a matrix that is given, a task beside rows."""
    place = options.evaluate or ()
    if isinstance(subject, GivenMatrix):
        for key in ("rows", "point", "task"):
            if getattr(options, key):
                raise NotDerivable(f"a matrix that is given has no {key}", key)
        return _given(subject, place, problem)
    return _of_arm(task_for(problem, options.rows, options.point, options.task), place, problem)


def _values(place: Place, problem: Problem) -> Names:
    return {**problem.names, **{Symbol(name): value for name, value in place}}


def _given(given: GivenMatrix, place: Place, problem: Problem) -> LinearMap:
    m, n = given.value.shape
    own = given.variables if len(given.variables) == n else tuple(f"q{j}" for j in range(1, n + 1))
    return LinearMap(
        problem,
        named("J", given.value, problem.taken),
        normal_matrix(given.value, _values(place, problem)),
        own,
        tuple(Symbol(f"v_{i}") for i in range(1, m + 1)),
        "matrix",
        place,
        lambda at: arrays(given.value, at),
    )


def _of_arm(task: Task, place: Place, problem: Problem) -> LinearMap:
    J = task.J if not place and not problem.names else normal_matrix(task.written, _values(place, problem))
    return LinearMap(
        problem,
        Symbol("J"),
        J,
        task.found.variables,
        task.velocities,
        "task" if isinstance(task, FunctionTask) else "rows",
        place,
        task.numbers,
        base=task.base,
        functions=task.functions if isinstance(task, FunctionTask) else (),
    )
