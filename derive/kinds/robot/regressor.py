"""The torques as a linear function of masses, moments and frictions: the regressor and its parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from derive.algebra import numeric
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.operations import operations
from derive.derivation import Claim, Derivation, Step, Table, named_results
from derive.expression import Expr, Indexed, Matrix, Product, Sum, Symbol, add, children, column, multiply
from derive.kinds.checks import agreement, law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import matrix_of, moment_names, oracle_of
from derive.kinds.robot._rates import rated
from derive.kinds.robot._regressor import Base, Standard, base_parameters, dependent, standard_parameters
from derive.mechanics.robot import Robot

RESULTS = {
    "Y": "the regressor of all parameters that act (n by p): tau = Y parameters",
    "parameters": "their values (p): of each link ZZ, XX, XY, XZ, YZ, MX, MY, YY, MZ, M, then IA, FV, FS",
    "Y_b": "the regressor of the smallest set (n by b): tau = Y_b base_parameters",
    "base_parameters": "the values of the smallest set (b)",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: The regressor of a planar arm
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: l1, alpha: 0, mass: m1, com: [l_c1 - l1, 0, 0], inertia: [0, 0, I1]}
    - {theta: theta2*, d: 0, a: l2, alpha: 0, mass: m2, com: [l_c2 - l2, 0, 0], inertia: [0, 0, I2]}
  find: regressor
"""
LONGEST_COLUMN = 24  # operations of a column of Y that is still shown


class Options(OptionsModel):
    """None."""


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """tau = Y(q, qdot, qddot) Theta (Spong et al., section 6.5.3; Khalil and Dombre, section 9.4)."""
    motion = problem.ask("dynamics")
    named = moment_names(problem.ask("inertia-matrix"))
    parameters = standard_parameters(problem)
    made_of = dependent(problem, parameters)
    base = base_parameters(parameters, made_of)
    values = {part.name: _value(problem, part.value, named) for part in parameters}
    gathered = tuple(_gathered(problem, each, named) for each in base)
    lost = tuple(_lost(problem, parameters, j, weights) for j, weights in made_of.items())
    shown = _columns(problem, base)
    results: dict[str, Expr] = {
        "Y": _beside(problem, [part.column for part in parameters], named),
        "parameters": column(values.values()),
        "Y_b": _beside(problem, [each.column for each in base], named),
        "base_parameters": column(step.result for step in gathered),
    }
    steps = (*lost, *gathered, *shown)
    definitions: dict[Expr, Expr] = {**values, **named_results(gathered)}
    definitions |= {_y(part.name): problem.readable_matrix(part.column) for part in parameters} if shown else {}
    claims = (
        *links(steps if shown else gathered, {**problem.names, **definitions, **named}),
        *(_laws(motion, results) if shown else ()),
        *_second_route(problem, results),
    )
    return Derivation(
        "regressor",
        steps,
        results,
        claims,
        definitions,
        uses=(motion,),
        facts={
            "table": Table(("parameter", "value"), tuple(values.items())) if len(values) <= 20 else None,
            "all": len(parameters),
            "smallest": len(base),
            "shown": bool(shown),
        },
        matrices=frozenset({"Y", "Y_b"}),
    )


def _value(problem: Problem, value: object, named: Mapping[Expr, Expr]) -> Expr:
    raise NotImplementedError
