"""The inertia of an arm of many joints that its end-effector shows: the linear equations that it solves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from derive.algebra.numbers.floats import Point
from derive.derivation import Claim, LinearSystem, Step, as_matrix
from derive.errors import NotDerivable
from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    Expr,
    Matrix,
    Product,
    Symbol,
    column,
    multiply,
    symbols,
    transpose,
)
from derive.kinds.checks import random_points
from derive.kinds.meanings import told
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._velocity.task import Task
from derive.kinds.work import Work
from derive.names import entry_symbol, free

NONE = 1e-9  # what the least singular value is of the largest, at most, where rows are dependent
NEAR = 1e-6
TRIES = 3
J, D, LAMBDA = symbols("J D Lambda")


def inertia_by_equations(task: Task, arm: Arm) -> tuple[LinearSystem, Work]:
    """D X = J^T and Lambda = (J X)^-1 (Khatib, 1987, eq. 51), and the board with them. Raises NotDerivable
    where the rows of J are dependent everywhere."""
    if not any(_is_of_full_rank(task.numbers(at)) for at in random_points(task.symbols, TRIES)):
        rows = ", ".join(task.rows)
        raise NotDerivable(
            f"the rows {rows} of J are dependent everywhere; choose others, as rows: [vx, vy]", "rows"
        )
    X = Symbol(free(task.problem.taken, "X", "Y"))
    turned = transpose(J)
    whole = LAMBDA, Product((J, X)) ** -1, Product((J, D**-1, turned)) ** -1
    lines = Step("X", (Product((D, X)), turned), "unsolved"), Step("Lambda", whole, "unsolved")
    work = task.board().resting_on(arm.inertia).knowing({D: arm.inertia.matrix("D")})
    held = _held(task, arm, X, *(line.chain for line in lines), (J, task.written))
    return _system(task, arm, X.name), work.step(*lines).claim(held)


def shown_as(task: Task, arm: Arm, formula: tuple[Expr, ...]) -> Claim:
    """That a formula for Lambda in J and D holds."""
    return _held(task, arm, Symbol("X"), formula)


def _held(task: Task, arm: Arm, X: Symbol, *lines: tuple[Expr, ...]) -> Claim:
    return told(
        lines,
        lambda at: _meanings(task, arm, X, at),
        task.symbols | {"g"},
        task.problem.where,
        key="equations-hold",
        tolerance=NEAR,
        moving=task.problem.moving,
    )


def _is_of_full_rank(jacobian: Any) -> bool:
    import numpy as np

    m, n = jacobian.shape
    sizes = np.linalg.svd(jacobian, compute_uv=False)
    return bool(m <= n and sizes[-1] > NONE * sizes[0])


def _meanings(task: Task, arm: Arm, X: Symbol, at: Point) -> Mapping[Expr, Any]:
    """J by differences of the poses, D by Newton and Euler, and Lambda by energies of unit velocities."""
    import numpy as np

    jacobian, inertia = task.numbers(at), arm.rigid.inertia_matrix(at)
    return {
        J: jacobian,
        D: inertia,
        X: np.linalg.solve(inertia, jacobian.T),
        LAMBDA: inertia_at(task, arm, at),
    }


def inertia_at(task: Task, arm: Arm, at: Point) -> Any:
    """Twice the least kinetic energy of joint rates that give the hand its velocity, as a quadratic form in
    this velocity (m by m)."""
    import numpy as np

    jacobian = task.numbers(at)
    halves = np.linalg.inv(np.linalg.cholesky(arm.rigid.inertia_matrix(at))).T
    rates = halves @ np.linalg.pinv(jacobian @ halves)  # n by m, of least energy
    return rates.T @ arm.rigid.inertia_matrix(at) @ rates


def _system(task: Task, arm: Arm, X: str) -> LinearSystem:
    """D X - J^T Lambda = 0 and J X = 1, column by column, in names of the entries that do not vanish."""
    m, n = task.J.shape
    jacobian = as_matrix(task.problem.final(task.written), "J")
    d, known = _named("d", as_matrix(arm.inertia.results["D"], "D"), symmetric=True)
    j, more = _named(free(task.problem.taken, "j", "jj", indices=["_11"]), jacobian)
    wanted = [entry_symbol("Lambda", i, k) for i in range(1, m + 1) for k in range(1, m + 1)]
    others = [entry_symbol(X, i, k) for i in range(1, n + 1) for k in range(1, m + 1)]
    left, right = [], []
    for k in range(m):
        for i in range(n):
            minus = [multiply(MINUS_ONE, row[i]) for row in j.rows]
            left.append((*_spread(minus, k, m), *_spread(d.rows[i], k, m)))
            right.append(ZERO)
        for i in range(m):
            left.append(((ZERO,) * (m * m)) + tuple(_spread(j.rows[i], k, m)))
            right.append(ONE if i == k else ZERO)
    unknowns = (*wanted, *others)
    return LinearSystem(unknowns, Matrix(tuple(left)), column(right), m * m, {**known, **more}, columns=m)


def _spread(entries: Any, k: int, m: int) -> Iterator[Expr]:
    """The coefficients of the column k of a matrix with m columns, whose entries stand row by row."""
    return (entry if column == k else ZERO for entry in entries for column in range(m))


def _named(letter: str, matrix: Matrix, symmetric: bool = False) -> tuple[Matrix, dict[str, Expr]]:
    """Names in place of the entries that do not vanish, and what they stand for."""
    rows, known = [], dict[str, Expr]()
    for i, row in enumerate(matrix.rows, 1):
        places = (sorted((i, k)) if symmetric else (i, k) for k, _ in enumerate(row, 1))
        names = [entry_symbol(letter, *place) for place in places]
        known |= {name.name: entry for name, entry in zip(names, row, strict=True) if entry != ZERO}
        rows.append(tuple(name if entry != ZERO else ZERO for name, entry in zip(names, row, strict=True)))
    return Matrix(tuple(rows)), known
