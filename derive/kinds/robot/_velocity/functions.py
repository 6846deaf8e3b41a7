"""A task that is given as functions of the joint variables: its Jacobian holds their derivatives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.arrays import arrays
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, column, free_symbols
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._point import PointOn, tracked
from derive.kinds.robot._velocity.task import J, RowName, Task, task_of
from derive.kinds.work import Work

STEP = 1e-5  # of a joint variable, for differences
R = Symbol("r")


@dataclass(frozen=True, slots=True)
class FunctionTask(Task):
    """r(q) (m by 1), with J = dr/dq (m by n)."""

    functions: tuple[Expr, ...]

    @property
    def base(self) -> tuple[Derivation, ...]:
        return ()

    def board(self, work: Work | None = None) -> Work:
        """A board with lines for the functions and their derivatives."""
        started = functions_given(work or Work(self.problem), self.functions)
        return started.line(J, value=self.J, rule="task", label="J")

    @property
    def velocities(self) -> tuple[Symbol, ...]:
        """Their rates, by the names an author gives their values."""
        return tuple(Symbol(f"r{i}_dot") for i in range(1, len(self.functions) + 1))

    @property
    def symbols(self) -> frozenset[str]:
        return self.problem.symbols.union(*map(free_symbols, self.functions))

    def numbers(self, at: Mapping[str, float]) -> Any:
        """J in numbers by differences of the functions (an array, m by n)."""
        import numpy as np

        def moved(name: str, by: float) -> Any:
            return arrays(column(self.functions), {**at, name: at[name] + by})[:, 0]

        ends = ((moved(q, STEP), moved(q, -STEP)) for q in self.found.variables)
        return np.array([(ahead - behind) / (2 * STEP) for ahead, behind in ends]).T


def functions_given(work: Work, functions: tuple[Expr, ...]) -> Work:
    """With a line for the functions r_1, ..., several of them as a column."""
    names = tuple(Symbol(f"r{i}") for i in range(1, len(functions) + 1))
    if len(names) == 1:
        return work.line(names[0], value=functions[0], rule="given", label="r")
    work = work.knowing(dict[Expr, Expr](zip(names, functions, strict=True)))
    return work.line(R, column(names), value=column(functions), rule="given", label="r")


def task_for(
    problem: Problem, rows: tuple[RowName, ...], point: PointOn | None, functions: tuple[Expr, ...]
) -> Task:
    """Rows of the Jacobian, or the functions in place of them. Raises NotDerivable for both, and for
    functions that no joint changes."""
    if not functions:
        return task_of(problem, rows, point)
    for key, given in (("rows", rows), ("point", point)):
        if given:
            raise NotDerivable(f"a task stands in place of {key}", key)
    found = chain_of(problem)
    for expr in functions:
        if not free_symbols(problem.final(expr)) & {*found.variables}:
            raise NotDerivable("a function of the task depends on no joint variable", "task")
    derivatives = [[normal(expr).diff(name) for name in found.variables] for expr in functions]
    names = tuple(f"r{i}" for i in range(1, len(functions) + 1))
    where = tracked(problem, found, None)
    return FunctionTask(problem, found, where, names, ScalarMatrix.of(derivatives), None, functions)
