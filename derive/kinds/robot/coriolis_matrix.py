"""The matrix C of Coriolis and centrifugal terms from the Christoffel symbols."""

from __future__ import annotations

from collections.abc import Callable

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Step
from derive.expression import ZERO, Expr, Matrix, Symbol, add, multiply
from derive.kinds.checks import law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.naming import entry_symbol
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import moment_names, scalar_of
from derive.kinds.robot._dynamics.rates import (
    Christoffel,
    is_long,
    rate_column,
    rates,
    symbols_of,
    velocity_agreement,
    velocity_terms,
)
from derive.mechanics.robot import Robot
from derive.names import require_free

RESULTS = {"C": "the matrix with c_kj = sum of c_ijk qdot_i (n by n); rates are written theta1_dot"}
NEEDS = ("bodies",)
EXAMPLE = """\
title: The Coriolis matrix of a planar arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: {rod: a2, axis: x}}
  find: coriolis-matrix
"""


class Options(OptionsModel):
    """None."""


class Facts(PageFacts):
    big: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """c_kj = sum of c_ijk qdot_i (Spong et al., eq. 6.42; Siciliano et al., eq. 7.45)."""
    require_free(problem.symbols, "C")
    inertia, speed = problem.ask("inertia-matrix"), problem.ask("christoffel")
    names, named = robot.variables, moment_names(inertia)
    symbols = symbols_of(problem)
    C = coriolis_matrix(symbols, names)
    big = is_long(problem)
    result: Expr = _entries(names, lambda name: scalar_of(speed, name))
    steps: tuple[Step, ...] = ()
    if not big:
        written = problem.readable_matrix(C)
        result = problem.final(written, named)
        summed = _entries(names, lambda name: Symbol(name) if scalar_of(speed, name) != ZERO else ZERO)
        steps = (Step("C", (Symbol("C"), summed, result), "coriolis"),)
    definitions: dict[Expr, Expr] = {**speed.definitions, Symbol("C"): result}
    rate = rate_column(names)
    claims = (
        *links(steps, {**problem.names, **definitions, **named}),
        law("makes-the-terms", C @ rate == velocity_terms(symbols, names)),
        velocity_agreement(problem, "C qdot", normal_matrix(result) @ rate),
    )
    return Derivation(
        "coriolis-matrix",
        steps,
        {"C": result},
        claims,
        definitions,
        uses=(inertia, speed),
        facts=Facts(big=big),
        matrices=frozenset({"C"}),
    )


def coriolis_matrix(symbols: Christoffel, variables: tuple[str, ...]) -> ScalarMatrix:
    """C (n by n) with its rates as symbols."""
    n, rate = range(1, len(variables) + 1), rate_column(variables).entries
    return ScalarMatrix.of(
        [sum((symbols[i, j, k] * rate[i - 1] for i in n), Scalar.of(0)) for j in n] for k in n
    )


def _entries(variables: tuple[str, ...], symbol: Callable[[str], Expr]) -> Matrix:
    """c_kj as sums of symbols and rates; `symbol` gives c_ijk by its name."""
    n, rate = range(1, len(variables) + 1), rates(variables)
    return Matrix(
        tuple(
            tuple(
                add(*(multiply(symbol(entry_symbol("c", i, j, k).name), rate[i - 1]) for i in n)) for j in n
            )
            for k in n
        )
    )
