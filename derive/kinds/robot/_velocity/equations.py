"""Joint rates where a formula for them would fill pages: the linear equations that they solve."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.derivation import LinearSystem, Step, as_matrix
from derive.errors import NotDerivable
from derive.expression import MINUS_ONE, ONE, ZERO, Expr, Matrix, Product, Symbol, column, multiply, transpose
from derive.kinds.checks import random_points
from derive.kinds.meanings import as_told, column_of
from derive.kinds.robot._velocity.solving import RATES, A, J, V
from derive.kinds.robot._velocity.task import Task
from derive.kinds.work import Work
from derive.mechanics.task import ROWS
from derive.names import free

NONE = 1e-9  # what the least singular value is of the largest, at most, where there is no full rank
TRIES = 3


def equations_for(task: Task) -> tuple[LinearSystem, Work]:
    """They and the board with them: J qdot = v; J J^T lambda = v and qdot = J^T lambda, the least rates; or
    J^T J qdot = J^T v, the least error. Raises NotDerivable where the rows are dependent everywhere."""
    if not any(_of_full_rank(task.numbers(at)) for at in random_points(task.symbols, TRIES)):
        raise NotDerivable(
            f"the Jacobian of {', '.join(task.rows)} is singular in every configuration", "rows"
        )
    whole = task.rows == ROWS and task.base  # then J stands on the page already
    work = Work(task.problem).resting_on(*task.base) if whole else task.board()
    work, turned = work.knowing({V: column(task.velocities)}), transpose(J)
    letter = free(task.problem.taken, "lambda" if task.redundant else "e", "mu")
    if task.square:
        work = work.step(_line("equations", Product((J, RATES)), column(task.velocities)))
    elif task.redundant:
        work = work.step(
            _line("A", A, Product((J, turned))),
            _line("equations", Product((A, Symbol(letter))), column(task.velocities)),
            _line("rates", RATES, Product((turned, Symbol(letter)))),
        )
    else:
        work = work.step(
            _line("A", A, Product((turned, J))),
            _line("equations", Product((A, RATES)), Product((turned, V))),
        )
    work = as_told(
        work,
        lambda at: _meanings(task, letter, at),
        tolerance=1e-5,
        symbols=task.symbols.union(name.name for name in task.velocities),
    )
    return _system(task, letter), work


def _line(name: str, *chain: Expr) -> Step:
    return Step(name, chain, "unsolved")


def _of_full_rank(J: Any) -> bool:
    import numpy as np

    sizes = np.linalg.svd(J, compute_uv=False)
    return bool(sizes[-1] > NONE * sizes[0])


def _meanings(task: Task, letter: str, at: Mapping[str, float]) -> Mapping[Expr, Any]:
    """The names of the lines, with a Jacobian by differences and NumPy's pseudo-inverse of it."""
    import numpy as np

    now = task.numbers(at)
    v = column_of([at[name.name] for name in task.velocities])
    gram = now @ now.T if task.redundant else now.T @ now
    found: dict[Expr, Any] = {J: now, V: v, A: gram, RATES: np.linalg.pinv(now) @ v}
    if task.redundant:
        found[Symbol(letter)] = np.linalg.pinv(gram) @ v
    return found


def _system(task: Task, letter: str) -> LinearSystem:
    """Row by row, nothing multiplied out: with more joints than rows qdot - J^T lambda = 0 and J qdot = v;
    with fewer J qdot + e = v and J^T e = 0."""
    m, n = task.J.shape
    J_now = as_matrix(task.problem.final(task.written), "J")
    v: list[Expr] = [*task.velocities]
    nothing: list[Expr] = [ZERO] * n
    if task.square:
        return LinearSystem(task.rates, J_now, column(v), n)
    unknowns = (*task.rates, *(Symbol(f"{letter}_{i}") for i in range(1, m + 1)))
    if task.redundant:
        minus_turned = _scaled(J_now.T)
        left = (*_beside(_one(n), minus_turned), *_beside(J_now, _zeros(m, m)))
        return LinearSystem(unknowns, Matrix(left), column(nothing + v), n)
    left = (*_beside(J_now, _one(m)), *_beside(_zeros(n, n), J_now.T))
    return LinearSystem(unknowns, Matrix(left), column(v + nothing), n)


def _beside(left: Matrix, right: Matrix) -> tuple[tuple[Expr, ...], ...]:
    return tuple((*a, *b) for a, b in zip(left.rows, right.rows, strict=True))


def _scaled(matrix: Matrix) -> Matrix:
    return Matrix(tuple(tuple(multiply(MINUS_ONE, entry) for entry in row) for row in matrix.rows))


def _one(n: int) -> Matrix:
    return Matrix(tuple(tuple(ONE if i == j else ZERO for j in range(n)) for i in range(n)))


def _zeros(m: int, n: int) -> Matrix:
    return Matrix(((ZERO,) * n,) * m)
