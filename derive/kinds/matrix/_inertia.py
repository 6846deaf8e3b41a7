"""A given matrix as the inertia matrix of an arm that is not described."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, completed
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable, NotReal, how_many
from derive.expression import Expr, Symbol
from derive.kinds.checks import random_points
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.christoffel_lines import shown
from derive.kinds.work import Work
from derive.mechanics.dynamics import Christoffel, christoffel
from derive.mechanics.matrices import GivenMatrix
from derive.names import entry_symbol, named

STEP = 1e-4  # of a difference
TRIES = 40
MOST_WRITTEN_OUT = 200  # operations of D; what follows from a longer one is not printed
MOST_LINES = 60


@dataclass(frozen=True)
class GivenInertia:
    """D (n by n) of n variables: its name, its value with the names of `where` kept."""

    problem: Problem
    given: GivenMatrix
    name: Symbol
    D: ScalarMatrix

    @property
    def variables(self) -> tuple[str, ...]:
        return self.given.variables

    @property
    def rates(self) -> tuple[Symbol, ...]:
        return tuple(Symbol(f"{name}_dot") for name in self.variables)

    @property
    def accelerations(self) -> tuple[Symbol, ...]:
        return tuple(Symbol(f"{name}_ddot") for name in self.variables)

    @property
    def symbols(self) -> frozenset[str]:
        """Every name that a point in motion needs."""
        moving = {f"{name}{dots}" for name in self.variables for dots in ("", "_dot", "_ddot")}
        return self.problem.symbols | moving

    @cached_property
    def christoffel(self) -> Christoffel:
        """Every c_ijk."""
        return christoffel(self.D, self.variables)

    @property
    def long(self) -> bool:
        """Whether what follows from D would fill pages."""
        return operations(self.given.value) > MOST_WRITTEN_OUT or len(shown(self.christoffel)) > MOST_LINES

    def board(self) -> Work:
        """With D as it is given, and its entries by name."""
        rows = enumerate(self.given.value.rows, 1)
        entries: dict[Expr, Expr] = {
            entry_symbol("d", min(i, j), max(i, j)): entry
            for i, row in rows
            for j, entry in enumerate(row, 1)
        }
        return Work(self.problem).given(self.name, self.given.value).knowing(entries)

    def final(self, value: Scalar) -> Expr:
        """As a person writes it, the names of `where` replaced."""
        return self.problem.final(self.problem.readable(value))

    # -- the second route: the matrix as it was typed, in numbers ----------------------------------

    def points(self, count: int) -> Iterator[Point]:
        """So many places in motion where the matrix is real, values of `where` added. Raises NotReal."""
        met = 0
        for at in random_points(self.symbols, TRIES + 4 * count, self.variables):
            with suppress(NotReal):
                self.slopes(at)
                yield completed(at, self.problem.where)
                met += 1
            if met == count:
                return
        if not met:
            raise NotReal("no values of the symbols were found for which this matrix is real")

    def numbers(self, at: Point) -> Any:
        """D (an array, n by n)."""
        return arrays(self.given.value, completed(at, self.problem.where))

    def slopes(self, at: Point) -> list[Any]:
        """dD/dq_i for each variable, by differences."""
        return [self._slope(at, name) for name in self.variables]

    def _slope(self, at: Point, name: str) -> Any:
        """Of the fifth order, by four places."""
        ahead, behind, far, far_behind = (
            self.numbers({**at, name: at[name] + k * STEP}) for k in (1, -1, 2, -2)
        )
        return (8 * (ahead - behind) - (far - far_behind)) / (12 * STEP)

    def torques(self, at: Point) -> Any:
        """d/dt of dK/dqdot less dK/dq, K = qdot^T D qdot / 2 (an array, n)."""
        import numpy as np

        speeds, rises = (
            np.array([at[f"{name}_{dots}"] for name in self.variables]) for dots in ("dot", "ddot")
        )
        slopes = self.slopes(at)
        turning = sum(speed * slope for speed, slope in zip(speeds, slopes, strict=True))
        return self.numbers(at) @ rises + turning @ speeds - [speeds @ slope @ speeds / 2 for slope in slopes]


def inertia_of(given: GivenMatrix, problem: Problem) -> GivenInertia:
    """The matrix as an inertia matrix. Raises NotDerivable where it is not square or not symmetric, or has
    not a variable for each row."""
    m, n = given.value.shape
    if m != n:
        raise NotDerivable(f"an inertia matrix is square, and this one is {m} by {n}")
    if len(given.variables) != n:
        raise NotDerivable(
            f"an inertia matrix of {how_many(n, 'row')} has {how_many(n, 'joint variable')}, and "
            f"{len(given.variables) or 'none'} {'is' if len(given.variables) == 1 else 'are'} listed: "
            "give all of them, in the order of the rows, under variables:",
            "variables",
        )
    D = normal_matrix(given.value)
    if beside := next(_differing(problem.exact(D)), None):
        one, other = (f"{i}, {j}" for i, j in (beside, beside[::-1]))
        raise NotDerivable(f"an inertia matrix is symmetric; here the entries {one} and {other} differ")
    return GivenInertia(problem, given, named("D", given.value, problem.taken), D)


def _differing(D: ScalarMatrix) -> Iterator[tuple[int, int]]:
    """Places, from 1, of entries that are not those beyond the diagonal."""
    n = range(D.shape[0])
    return ((i + 1, j + 1) for i in n for j in n if i < j and D[i, j] != D[j, i])
