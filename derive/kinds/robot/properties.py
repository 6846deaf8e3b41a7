"""Skew symmetry of dD/dt - 2C, positive definiteness of D, and linearity in the parameters."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import number_rows
from derive.derivation import Cell, Derivation, PageFacts, Phrase, Result, Table
from derive.expression import Approximate, Matrix, Symbol, add, multiply, symbols
from derive.kinds.checks import route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.index_laws import skew_law
from derive.kinds.work import Work
from derive.mechanics.dynamics import time_derivative
from derive.mechanics.robot import Robot
from derive.mechanics.sampled import physical_points
from derive.names import require_free

NEEDS = ("bodies",)
CLAIMS = ("skew-symmetric", "names")
D_DOT, C, N = symbols("D_dot C N")
POINTS = 3
ROUNDING = 1e-9


class Facts(PageFacts):
    big: bool
    definite: Phrase  # or not, or not known
    minors: Table | None  # None where the bodies are not all possible ones


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """N = dD/dt - 2C is skew-symmetric, D positive definite, tau linear in the parameters (Spong et al.,
    section 6.5)."""
    require_free(problem.symbols, "N")
    arm, coriolis, linear = Arm(problem), problem.ask("coriolis-matrix"), problem.ask("regressor")
    D = arm.inertia.matrix("D")
    rate = time_derivative(normal_matrix(D), arm.variables)
    value = rate - normal_matrix(coriolis.matrix("C")).scaled(2)
    work = Work(problem).resting_on(arm.inertia, coriolis, linear).showing(skew_law(problem.taken))
    if arm.long:
        work = work.knowing({N: _by_rates(arm, value), D_DOT: _by_rates(arm, rate)})
    else:
        work = work.line(D_DOT, value=rate, rule="matrix").line(N, D_DOT - 2 * C, rule="matrix")
    results: dict[str, Result] = {"D_dot": work[D_DOT], "N": work[N]}
    printed, minors = normal_matrix(work[N]), _minors(arm, D)
    work = by_index(work.law("skew-symmetric", printed == -printed.T), results)
    if minors:
        work = work.claim(route("minors", (not _negative(each) for each in minors)))
    names = ("Y", "parameters", "Y_b", "base_parameters")
    return work.answer(
        "properties",
        {**results, **{name: linear.results[name] for name in names}},
        Facts(big=arm.long, definite=_definite(minors), minors=_table(minors)),
        matrices=frozenset({"D_dot", "N", "Y", "Y_b"}),
    )


def _definite(minors: list[list[float]]) -> Phrase:
    """What the leading principal minors say of D."""
    if not minors:
        return Phrase("not-all-possible")
    return Phrase(
        "definite" if all(map(_positive, minors)) else "semidefinite",
        {"D": Symbol("D"), "minors": Symbol("Delta_k")},
    )


def _by_rates(arm: Arm, value: ScalarMatrix) -> Matrix:
    """Long entries as sums over the rates, in which they are linear."""
    slopes = [arm.problem.readable_matrix(value.diff(rate.name)) for rate in arm.rates]
    n = range(len(slopes))
    parts = {
        (i, j): [multiply(slope.rows[i][j], rate) for slope, rate in zip(slopes, arm.rates, strict=True)]
        for i in n
        for j in n
    }
    return Matrix(tuple(tuple(add(*parts[i, j]) for j in n) for i in n))


def _minors(arm: Arm, D: Matrix) -> list[list[float]]:
    """The leading minors of D at points where every body could exist; none where that is never so."""
    import numpy as np

    points = physical_points(arm.rigid, arm.problem.symbols, POINTS)
    values = (np.array(number_rows(D, arm.rigid.at(at))) for at in points)
    sizes = range(1, len(D.rows) + 1)
    return [[float(np.linalg.det(value[:k, :k])) for k in sizes] for value in values]


def _positive(minors: list[float]) -> bool:
    """Whether all at one point are, by more than rounding."""
    return all(minor > ROUNDING * max(map(abs, minors)) for minor in minors)


def _negative(minors: list[float]) -> bool:
    """Whether one at a point is, by more than rounding."""
    return any(minor < -ROUNDING * max(map(abs, minors)) for minor in minors)


def _table(minors: list[list[float]]) -> Table | None:
    """The minors point by point; None without any."""
    if not minors:
        return None
    names = (Symbol(f"Delta_{k}") for k, _ in enumerate(minors[0], 1))
    rows: list[tuple[Cell, ...]] = [(str(p), *map(Approximate, point)) for p, point in enumerate(minors, 1)]
    return Table((Phrase("point"), *names), tuple(rows))
