"""The rows of a Jacobian that a question is about, and what they rest on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

from derive.algebra.matrix import ScalarMatrix
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Matrix, Symbol, free_symbols
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._point import PointOn, Tracked, tracked
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.task import ROWS, rows_of, task_rows

J = Symbol("J")
DIFFERENCES = 1e-6
RowName = Literal["vx", "vy", "vz", "wx", "wy", "wz"]


@dataclass(frozen=True, slots=True)
class Task:
    """J (m by n): the rows asked for, or those the arm is built for, of the Jacobian of a point."""

    problem: Problem
    found: Chain
    point: Tracked
    rows: tuple[str, ...]
    J: ScalarMatrix
    asked: PointOn | None

    @property
    def base(self) -> tuple[Derivation, ...]:
        """The derivation of the whole Jacobian."""
        return (self.problem.ask("jacobian", point=self.asked),)

    @property
    def whole(self) -> ScalarMatrix:
        """All six rows."""
        return self.point.jacobian(self.found)

    @property
    def square(self) -> bool:
        return self.J.shape[0] == self.J.shape[1]

    @property
    def redundant(self) -> bool:
        """More joints than velocities to be commanded."""
        return self.J.shape[0] < self.J.shape[1]

    @property
    def written(self) -> Matrix:
        return self.problem.readable_matrix(self.J)

    def board(self, work: Work | None = None) -> Work:
        """A board of work that rests on the whole Jacobian, with a line for the rows asked for."""
        return replace(work or Work(self.problem), uses=self.base).line(J, value=self.J, rule="rows")

    def proved(self, work: Work) -> Work:
        """With the claim that these rows as they stand on the board agree with differences of the poses."""
        return work.agrees("rows-in-numbers", self.symbols, work[J], self.numbers, DIFFERENCES)

    @property
    def velocities(self) -> tuple[Symbol, ...]:
        """vx, vy, ..., wz of the rows, by the names an author gives their values."""
        return tuple(Symbol(row) for row in self.rows)

    @property
    def rates(self) -> tuple[Symbol, ...]:
        return tuple(Symbol(f"{name}_dot") for name in self.found.variables)

    @property
    def symbols(self) -> frozenset[str]:
        """Every name J depends on."""
        return self.problem.symbols | {n for part in self.point.offset for n in free_symbols(part)}

    def numbers(self, at: Mapping[str, float]) -> Any:
        """J in numbers by differences of the poses: the second route (an array, m by n)."""
        import numpy as np

        oracle = oracle_of(self.problem)
        whole = oracle.jacobian(oracle.at(at), self.point.frame, self.point.offset)
        return np.array([whole[ROWS.index(row)] for row in self.rows])


def task_of(problem: Problem, rows: tuple[str, ...], point: PointOn | None = None) -> Task:
    """The task of a question. Raises NotDerivable for an arm without joints, and for rows given twice."""
    found = chain_of(problem)
    if not found.variables:
        raise NotDerivable("the arm has no joint variable, so it has no Jacobian")
    if len(set(rows)) < len(rows):
        raise NotDerivable("a row is given twice", "rows")
    where = tracked(problem, found, point)
    J = where.jacobian(found)
    chosen = rows or task_rows(J)
    if not chosen:
        raise NotDerivable("no joint moves this point", "point")
    return Task(problem, found, where, chosen, rows_of(J, chosen), point)
