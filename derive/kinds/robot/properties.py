"""Skew symmetry of dD/dt - 2C, positive definiteness of D, and linearity in the parameters."""

from __future__ import annotations

from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import Point, number_rows
from derive.derivation import Derivation, PageFacts, Phrase, Result, Said
from derive.expression import Expr, Matrix, Symbol, add, multiply, symbols
from derive.kinds.checks import route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._dynamics.arm import DOTS, Arm
from derive.kinds.robot._dynamics.definite import is_diagonal, is_positive, minors
from derive.kinds.robot._dynamics.drives import friction_sorts
from derive.kinds.robot._dynamics.index_laws import skew_law
from derive.kinds.robot._efforts import efforts
from derive.kinds.work import Work
from derive.mechanics.dynamics import time_derivative
from derive.mechanics.robot import Robot
from derive.mechanics.sampled import impossible, physical_points
from derive.names import entry_symbol, require_free

NEEDS = ("bodies",)
CLAIMS = ("skew-symmetric", "names", "power")
D_DOT, C, N = symbols("D_dot C N")
POINTS = 3
ROUNDING = 1e-9


class Facts(PageFacts):
    big: bool
    power: Phrase  # where that of the joints goes
    definite: Phrase  # or not, or not known


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
    printed, values = normal_matrix(work[N]), _minors(arm, D)
    work = by_index(work.law("skew-symmetric", printed == -printed.T), results)
    if values:
        work = work.claim(route("minors", (not _negative(each) for each in values)))
    else:
        work = work.claim(route("impossible", impossible(arm.rigid, problem.symbols, POINTS)))
    told = work if arm.long or not all(map(_positive, values)) else minors(work.knowing(_entries(D)), D)
    signs = [is_positive(step.result, arm.variables) for step in told.steps if step.rule == "minor"]
    shown = bool(signs) and all(signs)
    if shown:
        work = told.law("positive", signs)
    work = _power(work, arm, D)
    names = ("Y", "parameters", "Y_b", "base_parameters")
    return work.answer(
        "properties",
        {**results, **{name: linear.results[name] for name in names}},
        Facts(big=arm.long, power=_power_told(robot), definite=_definite(values, D if shown else None)),
        matrices=frozenset({"D_dot", "N", "Y", "Y_b"}),
    )


def _definite(values: list[list[float]], shown: Matrix | None) -> Phrase:
    """What is said of D, by its leading minors at points, or by minors that are `shown` of it."""
    if not values:
        return Phrase("not-all-possible")
    if shown is None:
        return Phrase("definite" if all(map(_positive, values)) else "semidefinite", {"D": Symbol("D")})
    return Phrase("diagonal" if is_diagonal(shown) else "by-minors", {"D": Symbol("D")})


def _power_told(robot: Robot) -> Phrase:
    """Whose power the rate of the kinetic energy is."""
    about: dict[str, Said] = {"efforts": efforts(robot)}
    return Phrase("power-of-forces-rubbing" if any(friction_sorts(robot)) else "power-of-forces", about)


def _power(work: Work, arm: Arm, D: Matrix) -> Work:
    """d/dt (qdot^T D qdot / 2) = qdot^T (tau - g), with tau by Newton and Euler and without friction."""
    import numpy as np

    g, rate = arm.problem.ask("dynamics").matrix("g"), work.matrix("D_dot")

    def gained(at: Point) -> Any:
        inertia, slope, load = (np.array(number_rows(each, at)) for each in (D, rate, g))
        speeds, rises = (np.array([[at[f"{name}_{dots}"]] for name in arm.variables]) for dots in DOTS)
        return speeds.T @ (inertia @ rises + slope @ speeds / 2 + load)

    def given(at: Point) -> Any:
        return np.dot([at[each.name] for each in arm.rates], arm.rigid.torques(at))

    return work.agrees("power", arm.moving, gained, given)


def _entries(D: Matrix) -> dict[Expr, Expr]:
    """Every entry of D by its name."""
    return {
        entry_symbol("d", min(i, j), max(i, j)): entry
        for i, row in enumerate(D.rows, 1)
        for j, entry in enumerate(row, 1)
    }


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
