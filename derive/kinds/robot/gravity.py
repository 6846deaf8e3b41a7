"""The potential energy of an arm and the torques that hold it still."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim, Derivation, Step, named_results
from derive.expression import ZERO, Derivative, Expr, Matrix, Product, Symbol, add, column, negate, transpose
from derive.kinds.checks import agreement, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, closing, oracle_of
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.mechanics.dynamics import potential_energy
from derive.mechanics.robot import Robot, gravity_of

RESULTS = {"P": "potential energy", "g": "its partial derivatives (n)"}
NEEDS = ("bodies",)
EXAMPLE = """\
title: Gravity
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: {rod: a2, axis: x}}
  find: gravity
"""


class Options(OptionsModel):
    """None."""


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """P = - sum of m g^T o_c and g_k = dP/dq_k (Spong et al., eq. 6.33 and 6.40)."""
    base = problem.ask("inertia-matrix")
    bodies = weighted(problem, chain_of(problem))
    vector = column(gravity_of(robot))
    energies = tuple(_energy(problem, body, vector) for body in bodies)
    P = _total(problem, bodies, vector)
    torques = tuple(_torque(problem, P.result, name, k) for k, name in enumerate(robot.variables, 1))
    steps = (Step("g_0", (Symbol("g_0"), vector), "given"), *energies, P, *torques)
    g = Matrix(tuple((problem.final(step.result),) for step in torques))
    definitions = {**base.definitions, **named_results(steps)}
    claims = (*links(steps, {**problem.names, **definitions}), _second_route(problem, g))
    return Derivation(
        "gravity", steps, {"P": problem.final(P.result), "g": g}, claims, definitions, uses=(base,)
    )


def _energy(problem: Problem, body: Weighted, gravity: Matrix) -> Step:
    """P_i = -m g^T o_ci."""
    name, g, o = Symbol(f"P_{body.i}"), Symbol("g_0"), Symbol(f"o_c{body.i}")
    if body.body.mass == ZERO:
        return Step(name.name, (name, ZERO), "potential-energy")
    value = problem.readable(potential_energy([body.motion], normal_matrix(gravity)))
    return Step(
        name.name, (name, negate(Product((body.body.mass, transpose(g), o))), value), "potential-energy"
    )


def _total(problem: Problem, bodies: tuple[Weighted, ...], gravity: Matrix) -> Step:
    """P, the names of `where` replaced."""
    names = add(*(Symbol(f"P_{body.i}") for body in bodies))
    motions = [body.motion for body in bodies]
    value = problem.readable(potential_energy(motions, normal_matrix(gravity)))
    return closing(Step("P", (Symbol("P"), names, value), "sum"), problem.final(value))


def _torque(problem: Problem, P: Expr, variable: str, k: int) -> Step:
    name = Symbol(f"g_{k}")
    value = problem.readable(normal(P).diff(variable))
    return Step(name.name, (name, Derivative(Symbol("P"), Symbol(variable)), value), "gradient")


def _second_route(problem: Problem, g: Matrix) -> Claim:
    """The torques at rest by the equilibrium of each body."""
    oracle, names = oracle_of(problem), problem.subject.variables
    still = {f"{name}_dot": 0.0 for name in names} | {f"{name}_ddot": 0.0 for name in names}
    torques: ScalarMatrix = normal_matrix(g)
    return agreement(
        "g agrees with the torques at rest (Newton-Euler)",
        problem.symbols | {"g"},
        lambda at: numeric.matrix_numbers(torques, oracle.at(at)),
        lambda at: oracle.torques({**at, **still}),
    )
