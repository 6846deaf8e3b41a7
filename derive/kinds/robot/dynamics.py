"""The equations of motion of an arm after Euler and Lagrange."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import prod
from typing import Literal

from derive.algebra import numeric
from derive.algebra.normal import normal_matrix
from derive.algebra.operations import operations
from derive.derivation import Claim, Derivation, Step
from derive.expression import ZERO, Expr, Matrix, Number, Product, Symbol, add, multiply, number, squared
from derive.kinds.checks import agreement, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import matrix_of, moment_names, oracle_of, scalar_of
from derive.kinds.robot._drives import friction_column, friction_terms
from derive.kinds.robot._khatib_dynamics import khatib_dynamics
from derive.mechanics.robot import Robot

RESULTS = {
    "D": "the inertia matrix",
    "c_111, c_121, ...": "the Christoffel symbols",
    "P": "potential energy",
    "g": "its partial derivatives (n)",
    "tau": "the joint forces (n), with rates theta1_dot and accelerations theta1_ddot",
    "M, C, B, v, G": "with `notation: khatib`, in place of those above: M qddot + v + G = tau",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: Equations of motion
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: {rod: a2, axis: x}}
  find: dynamics
"""
LONGEST = 45  # operations; a longer equation stays in the names of its terms


class Options(OptionsModel):
    """`notation`: spong (D, c_ijk, g by Euler and Lagrange) or khatib (M, v, G)."""

    notation: Literal["spong", "khatib"] = "spong"


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """tau_k = sum d_kj qddot_j + sum c_ijk qdot_i qdot_j + g_k (Spong et al., eq. 6.39)."""
    if options.notation == "khatib":
        return khatib_dynamics(problem)
    inertia, speed, weight = (problem.ask(kind) for kind in ("inertia-matrix", "christoffel", "gravity"))
    names: dict[Expr, Expr] = {**inertia.definitions, **speed.definitions, **weight.definitions}
    rubbing = friction_terms(robot)
    terms = [
        [
            *_terms(inertia, speed, weight, robot.variables, k),
            *((term, problem.final(term)) for term in rubbing[k - 1]),
        ]
        for k in range(1, len(robot.variables) + 1)
    ]
    big = inertia.facts["big"]
    steps = () if big else tuple(_equation(k, pairs) for k, pairs in enumerate(terms, 1))
    tau = Matrix(tuple((add(*[value for _, value in pairs]),) for pairs in terms))
    results = {"D": inertia.results["D"], **speed.results, **weight.results, "tau": tau}
    known = {**problem.names, **names, **moment_names(inertia)}
    rigid = Matrix(
        tuple((add(*[value for _, value in pairs[: len(pairs) - len(rubbing[k])]]),) for k, pairs in enumerate(terms))
    )
    claims = (*links(steps, known), _second_route(problem, rigid))
    return Derivation(
        "dynamics",
        steps,
        results,
        claims,
        names,
        uses=(inertia, speed, weight),
        facts={"big": big, "friction": friction_column(robot) is not None, "notation": "spong"},
        matrices=frozenset({"D"}),
    )


def _equation(k: int, terms: list[tuple[Expr, Expr]]) -> Step:
    """In the names of its terms, and written out where that is short."""
    name, named, written = Symbol(f"tau_{k}"), add(*[n for n, _ in terms]), add(*[v for _, v in terms])
    chain = (name, named, written) if operations(written) <= LONGEST and written != named else (name, named)
    return Step(name.name, chain, "euler-lagrange", {"k": k})


def _terms(
    inertia: Derivation, speed: Derivation, weight: Derivation, variables: tuple[str, ...], k: int
) -> list[tuple[Expr, Expr]]:
    """(in names, written out) for every term of tau_k that does not vanish, accelerations first."""
    D, g = matrix_of(inertia, "D"), matrix_of(weight, "g")
    found: list[tuple[Expr, Expr, tuple[Expr, ...]]] = [
        (Symbol(f"d_{min(j, k)}{max(j, k)}"), D.rows[k - 1][j - 1], (Symbol(f"{name}_ddot"),))
        for j, name in enumerate(variables, 1)
    ]
    for (i, j), rates in _rates(variables).items():
        name = f"c_{i}{j}{k}"
        found.append((Symbol(name), scalar_of(speed, name), rates))
    found.append((Symbol(f"g_{k}"), g.rows[k - 1][0], ()))
    return [
        (_product(name, factors), _product(value, factors)) for name, value, factors in found if value != ZERO
    ]


def _rates(variables: tuple[str, ...]) -> dict[tuple[int, int], tuple[Expr, ...]]:
    """(i, j) -> qdot_i^2, or 2 qdot_i qdot_j for the two equal Christoffel symbols."""
    rate = [Symbol(f"{name}_dot") for name in variables]
    found: dict[tuple[int, int], tuple[Expr, ...]] = {}
    for i in range(len(rate)):
        for j in range(i, len(rate)):
            found[i + 1, j + 1] = (squared(rate[i]),) if i == j else (number(2), rate[i], rate[j])
    return found


def _product(value: Expr, factors: tuple[Expr, ...]) -> Expr:
    """Numbers gathered in front: 2 * (-1/2 m L) * x is -m L x."""
    parts = [
        part
        for expr in (value, *factors)
        for part in (expr.factors if isinstance(expr, Product) else (expr,))
    ]
    numbers = [part.value for part in parts if isinstance(part, Number)]
    rest = [part for part in parts if not isinstance(part, Number)]
    return multiply(Number(prod(numbers, start=Fraction(1))), *rest)


def _second_route(problem: Problem, rigid: Matrix) -> Claim:
    """Newton's and Euler's laws for each body, against tau without friction and with it."""
    oracle, names = oracle_of(problem), problem.subject.variables
    rates = {f"{name}{dots}" for name in names for dots in ("_dot", "_ddot")}
    torques, rubbing = normal_matrix(rigid), friction_column(problem.subject)

    def ours(at: Mapping[str, float]) -> list[float]:
        whole = oracle.at(at)
        found = [row[0] for row in numeric.matrix_numbers(torques, whole)]
        friction = numeric.numbers(rubbing, whole) if rubbing else [0.0] * len(found)
        return [a + b for a, b in zip(found, friction, strict=True)]

    return agreement(
        "tau agrees with the motion of each body (Newton-Euler)",
        problem.symbols | rates | {"g"},
        ours,
        lambda at: oracle.torques(at),
    )
