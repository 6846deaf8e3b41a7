"""Skew symmetry of dD/dt - 2C of a given inertia matrix, whether it is positive, and its constants."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, completed
from derive.derivation import Derivation, PageFacts, Phrase, Result
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Matrix, Symbol, add, column, multiply, symbols
from derive.kinds.checks import route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.matrix._inertia import GivenInertia, inertia_of
from derive.kinds.matrix._minors import minors
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.index_laws import coriolis_law, skew_law, torque_law
from derive.kinds.robot._dynamics.matrix_laws import regressor_laws
from derive.kinds.work import Work
from derive.mechanics.dynamics import coriolis_matrix, rate_column, time_derivative
from derive.mechanics.matrices import GivenMatrix
from derive.mechanics.shares import Share, shares
from derive.names import entry_symbol, require_free

USES = frozenset({"variables"})
CLAIMS = ("skew-symmetric", "energy")
D_DOT, C, N, Y = symbols("D_dot C N Y")
DIFFERENCES, INDEPENDENT = 1e-7, 1e-8


class Facts(PageFacts):
    """The name of the matrix; `count` constants of a regressor, 0 where it has none."""

    D: Symbol
    definite: Phrase
    leading: bool  # the minors are those of the first rows
    count: int


def derive(given: GivenMatrix, options: Options, problem: Problem) -> Derivation:
    """N = dD/dt - 2C is skew-symmetric; D by its minors; D qddot + C qdot = Y Theta (Spong et al., section
    6.5).

    Raises NotDerivable for a matrix that can be no inertia matrix, and where it is too long to be printed.
    """
    found, symbols_of = inertia_of(given, problem), problem.ask("christoffel")
    require_free(problem.taken, "D_dot", "C", "N", "Y")
    if found.long:
        raise NotDerivable("what follows from this matrix would fill pages; ask for its Christoffel symbols")
    work = Work(problem).resting_on(symbols_of).showing(coriolis_law(problem.taken))
    rate = rate_column(found.variables)
    turning, value = time_derivative(found.D, found.variables), coriolis_matrix(found.christoffel, rate)
    work = work.line(C, _sums(work, found), value=_final(problem, value), rule="coriolis")
    work = work.line(D_DOT, value=_final(problem, turning), rule="matrix")
    work = work.showing(skew_law(problem.taken)).line(N, D_DOT - 2 * C, rule="matrix")
    printed = normal_matrix(work[N])
    work = work.law(
        "skew-symmetric", (printed == -printed.T, bool(work.value_matrix(C) == problem.exact(value)))
    )
    work = work.agrees(
        "energy", found.symbols, lambda at: _gained(work, found, at), found.torques, DIFFERENCES
    )
    work, definite, leading = minors(work, found)
    results: dict[str, Result] = {name.name: work[name] for name in (D_DOT, C, N)}
    parts = _constants(found)
    if parts:
        work, told = _regressor(work, found, parts)
        results |= told
    facts = Facts(D=found.name, definite=definite, leading=leading, count=len(parts))
    return work.answer("properties", results, facts, matrices=frozenset({"D_dot", "C", "N", "Y"}))


def _final(problem: Problem, value: ScalarMatrix) -> Expr:
    return problem.final(problem.readable_matrix(value))


def _sums(work: Work, found: GivenInertia) -> Matrix:
    """C_kj as sums of the symbols that do not vanish and rates."""
    n = range(1, len(found.rates) + 1)

    def symbol(*ijk: int) -> Expr:
        name = entry_symbol("c", *ijk)
        return name if work[name] != ZERO else ZERO

    def entry(k: int, j: int) -> Expr:
        return add(*(multiply(symbol(i, j, k), rate) for i, rate in enumerate(found.rates, 1)))

    return Matrix(tuple(tuple(entry(k, j) for j in n) for k in n))


def _gained(work: Work, found: GivenInertia, at: Point) -> Any:
    """D qddot + C qdot in numbers, with C as printed."""
    import numpy as np

    here = completed(at, found.problem.where)
    speeds, rises = (
        np.array([here[name.name] for name in names]) for names in (found.rates, found.accelerations)
    )
    return found.numbers(at) @ rises + arrays(work[C], here) @ speeds


# -- linear in constants --------------------------------------------------------------------------------


def _constants(found: GivenInertia) -> tuple[Share, ...]:
    """Those of D; none where it holds numbers alone, or has joint variables below a fraction."""
    try:
        parts = shares(normal_matrix(found.given.value, found.problem.names), found.variables)
    except NotDerivable:
        return ()
    return parts if any(part.value.constant is None for part in parts) else ()


def _regressor(work: Work, found: GivenInertia, parts: tuple[Share, ...]) -> tuple[Work, dict[str, Result]]:
    """Y and the constants, and that they make the same torques."""
    problem = work.problem
    names = [entry_symbol("Theta", k) for k, _ in enumerate(parts, 1)]
    for name, part in zip(names, parts, strict=True):
        work = work.line(name, value=problem.readable(part.value), rule="constant")
    work = work.showing(torque_law(found.name, problem.taken), *regressor_laws())
    columns = [problem.readable_matrix(part.column(found.variables)) for part in parts]
    for k, each in enumerate(columns, 1):
        work = work.line(entry_symbol("y", k), value=each, rule="column")
    whole = Matrix(tuple(zip(*(tuple(entry for (entry,) in each.rows) for each in columns), strict=True)))
    theta = column(work[name] for name in names)
    exact = normal_matrix(found.given.value, problem.names)
    sum_of = [part.D.scaled(part.value) for part in parts]
    work = work.law("shares", sum(sum_of[1:], start=sum_of[0]) == exact)
    work = work.agrees(
        "torques", found.symbols, lambda at: _product(whole, theta, at), found.torques, DIFFERENCES
    )
    work = work.claim(route("smallest", _independent(whole, found)))
    return work, {"Y": whole, "parameters": theta}


def _product(whole: Matrix, theta: Matrix, at: Point) -> Any:
    return (arrays(whole, at) @ arrays(theta, at))[:, 0]


def _independent(whole: Matrix, found: GivenInertia) -> Iterator[bool]:
    """Whether no column is a combination of the others: the rows of enough motions have full rank."""
    import numpy as np

    rows = np.vstack([arrays(whole, at) for at in found.points(2 * len(whole.rows[0]) + 2)])
    sizes = np.linalg.svd(rows / np.abs(rows).max(axis=0), compute_uv=False)
    yield bool(sizes[-1] > INDEPENDENT * sizes[0])
