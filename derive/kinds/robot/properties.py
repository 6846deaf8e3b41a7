"""Skew symmetry of dD/dt - 2C, positive definiteness of D, and linearity in the parameters."""

from __future__ import annotations

from collections.abc import Mapping

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Cell, Claim, Derivation, PageFacts, Phrase, Step, Table
from derive.expression import (
    ZERO,
    Approximate,
    Expr,
    Matrix,
    Product,
    Symbol,
    add,
    multiply,
    number,
    subtract,
)
from derive.kinds.checks import SECOND_ROUTE, law, links
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import matrix_of, moment_names
from derive.kinds.robot._dynamics.rates import is_long, oracle, rate_column
from derive.mechanics.robot import Robot
from derive.mechanics.sampled import physical_points
from derive.names import require_free

RESULTS = {
    "D_dot": "dD/dt (n by n); rates are written theta1_dot",
    "N": "dD/dt - 2C (n by n), skew-symmetric",
    "Y, Y_b": "the regressor of all parameters that act, and that of the smallest set",
    "parameters, base_parameters": "the values of those parameters: tau = Y parameters = Y_b base_parameters",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: Properties of the equations of motion
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: {rod: a2, axis: x}}
  find: properties
"""
RATE, MATRIX, SKEW = Symbol("D_dot"), Symbol("C"), Symbol("N")
POINTS = 3


class Facts(PageFacts):
    big: bool
    minors: Table | None  # None where the bodies are not all possible ones
    definite: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """N = dD/dt - 2C is skew-symmetric, D positive definite, tau linear in the parameters (Spong et al.,
    section 6.5)."""
    require_free(problem.symbols, "N")
    inertia, coriolis, linear = (
        problem.ask(kind) for kind in ("inertia-matrix", "coriolis-matrix", "regressor")
    )
    D, C = matrix_of(inertia, "D"), matrix_of(coriolis, "C")
    rate = _rate(normal_matrix(D), robot.variables)
    big = is_long(problem)
    written, N = _written(problem, rate, normal_matrix(C), robot.variables, big)
    steps = () if big else (_step(RATE, (), written), _step(SKEW, (subtract(RATE, _twice(MATRIX)),), N))
    definitions = {**coriolis.definitions, RATE: written, SKEW: N, **moment_names(inertia)}
    minors = _minors(problem, D)
    skew = rate - normal_matrix(C).scaled(2)
    claims = (
        *links(steps, {**problem.names, **definitions}),
        law("skew-symmetric", skew == -skew.T),
        *_definite(minors),
    )
    regressor = {name: linear.results[name] for name in ("Y", "parameters", "Y_b", "base_parameters")}
    return Derivation(
        "properties",
        steps,
        {"D_dot": written, "N": N, **regressor},
        claims,
        definitions,
        uses=(inertia, coriolis, linear),
        facts=Facts(big=big, minors=_table(minors), definite=_is_definite(minors)),
        matrices=frozenset({"D_dot", "N", "Y", "Y_b"}),
    )


def _rate(D: ScalarMatrix, variables: tuple[str, ...]) -> ScalarMatrix:
    """dD/dt by the chain rule."""
    total = ScalarMatrix.zeros(*D.shape)
    for name, rate in zip(variables, rate_column(variables).entries, strict=True):
        total = total + D.diff(name).scaled(rate)
    return total


def _written(
    problem: Problem, rate: ScalarMatrix, C: ScalarMatrix, names: tuple[str, ...], big: bool
) -> tuple[Matrix, Matrix]:
    """dD/dt and N; N only above its diagonal, for it is skew-symmetric."""
    N, n = rate - C.scaled(2), range(rate.shape[0])

    def entry(value: Scalar) -> Expr:
        return _by_rates(problem, value, names) if big else problem.readable(value)

    upper = {(i, j): entry(N[i, j]) for i in n for j in n if i < j}
    lower = {(j, i): entry(-N[i, j]) for i, j in upper}
    half = {(i, j): entry(rate[i, j]) for i in n for j in n if i <= j}
    symmetric = {(i, j): half[min(i, j), max(i, j)] for i in n for j in n}
    return _matrix(symmetric, len(n)), _matrix({**upper, **lower, **{(i, i): ZERO for i in n}}, len(n))


def _by_rates(problem: Problem, value: Scalar, names: tuple[str, ...]) -> Expr:
    """A long entry as a sum over the rates, in which it is linear."""
    rates = [f"{name}_dot" for name in names]
    return add(*(multiply(problem.readable(value.diff(rate)), Symbol(rate)) for rate in rates))


def _matrix(entries: Mapping[tuple[int, int], Expr], n: int) -> Matrix:
    return Matrix(tuple(tuple(entries[i, j] for j in range(n)) for i in range(n)))


def _step(name: Symbol, route: tuple[Expr, ...], value: Matrix) -> Step:
    return Step(name.name, (name, *route, value), "matrix")


def _twice(matrix: Symbol) -> Expr:
    return Product((number(2), matrix))


def _minors(problem: Problem, D: Matrix) -> list[list[float]]:
    """The leading minors of D at points where every body could exist; none where that is never so."""
    import numpy as np

    arm = oracle(problem)
    points = physical_points(arm, problem.symbols, POINTS)
    count = len(D.rows)
    values = [np.array(numbers(D, arm.at(at))).reshape(count, count) for at in points]  # flat for one joint
    sizes = range(1, count + 1)
    return [[float(np.linalg.det(value[:k, :k])) for k in sizes] for value in values]


def _definite(minors: list[list[float]]) -> tuple[Claim, ...]:
    """No leading minor of a real arm is negative, but for rounding."""
    if not minors:
        return ()
    holds = all(minor >= -1e-9 * max(map(abs, point)) for point in minors for minor in point)
    return (Claim("minors", SECOND_ROUTE, holds),)


def _table(minors: list[list[float]]) -> Table | None:
    if not minors:
        return None
    headings: tuple[Cell, ...] = (
        Phrase("point"),
        *(Symbol(f"Delta_{k}") for k in range(1, len(minors[0]) + 1)),
    )
    rows = [_row(p, point) for p, point in enumerate(minors, 1)]
    return Table(headings, tuple(rows))


def _is_definite(minors: list[list[float]]) -> bool:
    """Whether every minor is positive at every point."""
    return all(minor > 1e-9 * max(map(abs, point)) for point in minors for minor in point)


def _row(label: int, values: list[float]) -> tuple[Expr | str, ...]:
    return (str(label), *map(Approximate, values))
