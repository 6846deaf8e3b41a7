"""Khatib's matrices C (centrifugal) and B (Coriolis) from the partial derivatives of the mass matrix."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.derivation import Claim, Derivation, PageFacts
from derive.expression import Expr, Matrix, Product, Sum, Symbol
from derive.kinds.checks import law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.naming import entry_symbol
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import moment_names
from derive.kinds.robot._dynamics.khatib import (
    Velocity,
    definitions_of,
    entry_steps,
    matrix_steps,
    symbol_steps,
    velocity_of,
)
from derive.kinds.robot._dynamics.rates import is_long, pairs, squares, velocity_agreement
from derive.mechanics.robot import Robot
from derive.names import require_free

RESULTS = {
    "C": "the centrifugal matrix; its entry i, j is b_ijj (n by n)",
    "B": "the Coriolis matrix of the 2 b_ijk with j < k (n by n(n-1)/2); an arm of one joint has none",
    "b_111, b_112, ...": "every b_ijk with j <= k; b_ikj is the same",
    "v": "C [qdot^2] + B [qdot qdot] (n); rates are written theta1_dot",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: Centrifugal and Coriolis matrices
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: {rod: a2, axis: x}}
  find: coriolis-matrices
"""


class Options(OptionsModel):
    """None."""


class Facts(PageFacts):
    big: bool
    one: bool  # joint
    vanish: int  # of those not shown


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """v = C [qdot^2] + B [qdot qdot] (Khatib, Introduction to Robotics, dynamics; Craig, eq. 6.63)."""
    require_free(problem.symbols, "C", "B", "v")
    inertia = problem.ask("inertia-matrix")
    D, big, n = inertia.definitions[Symbol("D")], is_long(problem), len(robot.variables)
    velocity = velocity_of(problem, big)
    worked = () if big else (*entry_steps(problem, D), *symbol_steps(velocity, n))
    steps = (*worked, *matrix_steps(velocity, robot.variables, big))
    definitions = {**inertia.definitions, **definitions_of(D, worked, velocity)}
    shown = {step.name for step in worked}
    claims = (
        *links(() if big else steps, {**problem.names, **definitions, **moment_names(inertia)}),
        *_laws(velocity, robot.variables),
        velocity_agreement(problem, "v", normal_matrix(velocity.v)),
    )
    return Derivation(
        "coriolis-matrices",
        steps,
        _results(velocity),
        claims,
        definitions,
        uses=(inertia,),
        facts=Facts(
            big=big,
            one=n == 1,
            vanish=sum(entry_symbol("b", i, j, k).name not in shown for i, j, k in velocity.symbols),
        ),
        matrices=frozenset({"C", "B"}),
    )


def _results(velocity: Velocity) -> dict[str, Expr]:
    B: dict[str, Expr] = {"B": velocity.B} if velocity.B else {}
    b = {entry_symbol("b", i, j, k).name: value for (i, j, k), value in sorted(velocity.values.items())}
    return {"C": velocity.C, **B, **b, "v": velocity.v}


def _laws(velocity: Velocity, variables: tuple[str, ...]) -> tuple[Claim, ...]:
    """The two products make v."""
    whole: Expr = Product((velocity.C, squares(variables)))
    others = pairs(variables)
    if velocity.B and others:
        whole = Sum((whole, Product((velocity.B, others))))
    made: ScalarMatrix = normal_matrix(Matrix(((whole,),)))
    return (law("makes-v", made == normal_matrix(velocity.v)),)
